/// A simulation in memory, without files: step it, look at it, change it, push it, measure it, save it.
///
/// One thread at a time uses a simulation; different simulations are used by different threads at will. Arrays and
/// texts that a function hands out belong to the simulation and are valid until its next advance, change, restore or
/// end. In 2D vectors of three components have z = 0, and torques and spins are about z. Builds with assertions catch a
/// handle that was freed.
#ifndef SCREE_SIMULATION_H
#define SCREE_SIMULATION_H

#include <scree/case.h>
#include <scree/keeper.h>
#include <scree/view.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_simulation scree_simulation;

/// The case must outlive the simulation. No stage has begun yet, so there are no bodies. `threads` 0: as many as pay.
/// Errors: SCREE_ERROR_INPUT, memory.
SCREE_API scree_status scree_simulation_create(const scree_case *c, int threads, scree_simulation **out,
                                               scree_error *error);
SCREE_API void scree_simulation_free(scree_simulation *s);

// ---- time --------------------------------------------------------------------------------------------------------

/// At most `steps` steps (force evaluations), through all stages; *done tells whether the case has ended. 0 steps do
/// nothing; to place the bodies is no step, 1 places them and takes the first one. Errors: SCREE_ERROR_GUARD and others
/// stop the simulation: it can be looked at, and every further advance fails in the same way until it is restored.
SCREE_API scree_status scree_simulation_advance(scree_simulation *s, uint64_t steps, bool *done, scree_error *error);

/// Until the present stage has ended, which stays the present one; after its end, the next stage. The first call
/// prepares the bodies. Errors: as above.
SCREE_API scree_status scree_simulation_advance_stage(scree_simulation *s, bool *done, scree_error *error);

/// At most `steps` steps, and not beyond the end of the present stage; *ended tells whether it has ended. It stays the
/// present one; after its end, the next. Errors: as above.
SCREE_API scree_status scree_simulation_advance_within_stage(scree_simulation *s, uint64_t steps, bool *ended,
                                                             scree_error *error);

SCREE_API int scree_simulation_dimension(const scree_simulation *s);  ///< 2 or 3
SCREE_API double scree_simulation_time(const scree_simulation *s);    ///< s
SCREE_API uint64_t scree_simulation_steps(const scree_simulation *s); ///< taken since the begin
SCREE_API double
scree_simulation_step_size(const scree_simulation *s); ///< s, of the last step; the first one, before it
SCREE_API size_t scree_simulation_bodies(const scree_simulation *s);
/// Index of the present stage in the case and its name there (its kind, numbered where there are several); the number
/// of stages and NULL when the case has ended. `name` may be NULL.
SCREE_API int64_t scree_simulation_stage(const scree_simulation *s, const char **name);
/// Strain that the present loading stage has imposed so far [1], compression positive; NAN in others.
SCREE_API double scree_simulation_loading_strain(const scree_simulation *s);

/// What the state is, in one number (docs/architecture.md). 0 without memory.
SCREE_API uint64_t scree_simulation_checksum(scree_simulation *s);

// ---- views -------------------------------------------------------------------------------------------------------

/// Any field that docs/output.md lists: "position", "radius", "scheme_velocity", "walls/position", "membrane/rest",
/// "periodic/lattice", "ledger/outside", "contacts/first". Nothing is copied; what contacts remember is gathered first.
/// Rows of bodies change places when neighbours are searched: "id" says which is which. Errors: SCREE_ERROR_INPUT for a
/// name that is none (`accepted` holds the nearest), or a field of the other dimension; memory.
SCREE_API scree_status scree_simulation_view(scree_simulation *s, const char *name, scree_view *view,
                                             scree_error *error);

/// As scree_simulation_view, for programs that cannot know how long somebody looks at a view, as bindings of other
/// languages: *keeper (NULL for a view without elements) keeps its memory from being freed until scree_keeper_free,
/// also when the simulation is freed before. What is seen is the present until arrays move to grow, and stays as it was
/// from then on; data and count of a new view tell. Errors: as above.
SCREE_API scree_status scree_simulation_keep_view(scree_simulation *s, const char *name, scree_view *view,
                                                  scree_keeper **keeper, scree_error *error);

/// Names of all fields that this simulation has, by index; NULL behind the last.
SCREE_API const char *scree_simulation_view_name(const scree_simulation *s, size_t index);

/// Positions [m], and velocities [m/s] and spins [rad/s] at the present time, copied in the order of ids. out: bodies x
/// dimension; of spins bodies in 2D, bodies x 3 in 3D. Each may be NULL. In a periodic cell that deforms velocities are
/// relative to it.
SCREE_API void scree_simulation_copy(const scree_simulation *s, double *position, double *velocity, double *spin);

// ---- contacts and measures ---------------------------------------------------------------------------------------

typedef enum scree_partner {
    SCREE_PARTNER_BODY,
    SCREE_PARTNER_WALL, ///< an element of a wall of the case: a plane, a triangle
    SCREE_PARTNER_PLATE ///< bottom, top, left, right, front, back
} scree_partner;

/// A touching contact.
typedef struct scree_contact_point {
    uint32_t first;  ///< id of a body
    uint32_t second; ///< id of a body, or number of the element or plate
    scree_partner partner;
    int sliding;           ///< 1: at the Coulomb limit
    double normal[3];      ///< unit vector from the second to the first
    double point[3];       ///< m
    double branch[3];      ///< m, centre of the first less that of the second; at a wall less `point`
    double force[3];       ///< N, on the first
    double overlap;        ///< m
    double normal_force;   ///< N, along `normal`, pressing positive
    double slip;           ///< m/s, of the surfaces on each other
    double elastic_energy; ///< J, normal and tangential
} scree_contact_point;

/// All touching contacts, by id of the first, then of the second, bodies before walls. Errors: memory.
SCREE_API scree_status scree_simulation_contacts(scree_simulation *s, const scree_contact_point **contact,
                                                 size_t *count, scree_error *error);

/// Average stress [Pa], 3 x 3 by rows, tension positive: from the forces of the contacts and the volume of the sample
/// (Christoffersen, Mehrabadi and Nemat-Nasser 1981), and from what the boundary applies. Errors: memory.
SCREE_API scree_status scree_simulation_stress(scree_simulation *s, double stress[9], scree_error *error);
SCREE_API scree_status scree_simulation_boundary_stress(scree_simulation *s, double stress[9], scree_error *error);

/// Displacement gradient of the Delaunay boundary or of the periodic cell since the begin, 3 x 3 by rows, extension
/// positive.
SCREE_API void scree_simulation_strain(const scree_simulation *s, double gradient[9]);

/// Volume of the sample inside of its boundary [m3].
SCREE_API double scree_simulation_volume(const scree_simulation *s);

typedef struct scree_structure {
    size_t contacts;                      ///< touching
    double coordination;                  ///< contacts a body
    double coordination_without_rattlers; ///< the same among bodies that bear load
    double rattler_fraction;              ///< bodies that bear none
    double solid_fraction;                ///< NAN without a Delaunay boundary or a periodic cell
    double fabric[9];                     ///< mean of normal (x) normal over contacts, trace 1; NAN without any
    double sliding_fraction;              ///< of the contacts of bodies
    double mean_slip;                     ///< m/s, of the same
    double unbalanced_ratio;              ///< mean resultant force over mean contact force; NAN without forces
} scree_structure;
/// Errors: memory.
SCREE_API scree_status scree_simulation_structure(scree_simulation *s, scree_structure *structure, scree_error *error);

/// Energies [J] now, and the balance of all work since the bodies were placed. The single works are the fields
/// "ledger/...".
typedef struct scree_energies {
    double kinetic, kinetic_rotation;
    double elastic_normal, elastic_tangential;
    double gravity;           ///< work of gravity
    double outside;           ///< work from outside: own forces, and changes of bodies
    double residual;          ///< of the balance
    double relative_residual; ///< over all energy that there is and was
} scree_energies;
/// Errors: memory.
SCREE_API scree_status scree_simulation_energies(scree_simulation *s, scree_energies *energies, scree_error *error);

/// A column of series.csv by name, in the last sample that was taken (docs/output.md). Errors: SCREE_ERROR_INPUT for a
/// name that is none (`accepted` holds the nearest), or before the first sample.
SCREE_API scree_status scree_simulation_sample(const scree_simulation *s, const char *name, double *value,
                                               scree_error *error);

// ---- own forces --------------------------------------------------------------------------------------------------

typedef struct scree_loads scree_loads; ///< where a callback puts its forces

/// Called once a step, after the contact forces: positions are those at the end of the step, "scheme_velocity" that of
/// its middle. It may use views and the functions about time, and scree_loads_add; nothing else of this simulation.
/// What it returns, unless 0, stops the simulation.
typedef int scree_own_force_function(void *user, scree_simulation *s, scree_loads *loads);

typedef struct scree_own_force {
    const char *name; ///< for messages and to remove it
    scree_own_force_function *function;
    void *user;
    double largest_force;  ///< N, bound of the magnitude of each force that it adds; forces are rounded to 1e-15 of it
    double largest_torque; ///< N m, the same of torques; 0: none
} scree_own_force;

/// From the next step on. Their order does not matter, not even to the last bit. The work is in "ledger/outside". The
/// step of the case must be small enough for what these forces do: no critical step knows of them. Errors:
/// SCREE_ERROR_INPUT (a name twice, a bound that is none), memory.
SCREE_API scree_status scree_simulation_add_force(scree_simulation *s, const scree_own_force *force,
                                                  scree_error *error);
/// From the next step on. Errors: SCREE_ERROR_INPUT: there is none of that name.
SCREE_API scree_status scree_simulation_remove_force(scree_simulation *s, const char *name, scree_error *error);

/// Adds a force [N] and a torque [N m] (NULL: none) to the body with this id. A value beyond the bound or not finite,
/// or an id that no body has, stops the simulation behind this step with a message.
SCREE_API void scree_loads_add(scree_loads *loads, uint32_t id, const double force[3], const double torque[3]);
/// The same for many bodies. force: count x 3 [N]; torque: count x 3 [N m]; each may be NULL.
SCREE_API void scree_loads_add_many(scree_loads *loads, size_t count, const uint32_t *id, const double *force,
                                    const double *torque);

// ---- changes -----------------------------------------------------------------------------------------------------

/// New values of some bodies, in SI units; NULL: they stay.
typedef struct scree_body_values {
    size_t count;
    const uint32_t *id;     ///< count, each once
    const double *position; ///< count x dimension
    const double *velocity; ///< count x dimension, at the present time
    const double *spin;     ///< count in 2D, count x 3 in 3D
    const double *radius;   ///< count, at most the largest of the case; masses follow
} scree_body_values;

/// Changes bodies between two steps. Neighbours are searched and forces evaluated anew, without a step: contacts keep
/// what they remember. What the energy changes by is work from outside ("ledger/outside"), so the balance stays closed.
/// Errors: SCREE_ERROR_INPUT when there are no such bodies or values, or where the boundary imposes motions, a membrane
/// stands or a periodic cell deforms: nothing is changed then. SCREE_ERROR_GUARD when bodies overlap beyond the limit:
/// they are where they were put, and the simulation is stopped. Memory.
SCREE_API scree_status scree_simulation_set(scree_simulation *s, const scree_body_values *values, scree_error *error);

// ---- save and restore --------------------------------------------------------------------------------------------

/// The whole state, bit for bit, into a file (HDF5, replaced as a whole). Errors: SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_simulation_save(scree_simulation *s, const char *path, scree_error *error);

/// Goes back, or on, to what was saved by a simulation of the same case; own forces must be registered as they were,
/// and hold what they remember by themselves. On failure the simulation is as it was. Errors: SCREE_ERROR_INPUT
/// (another case, other own forces), SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_simulation_restore(scree_simulation *s, const char *path, scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
