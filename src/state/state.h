/// What changes during a run: exactly what is needed to continue it bit for bit. Everything else is `work` and can be
/// thrown away at any moment between two steps.
///
/// Hot data. One 64-byte row a body (`scree_row`) holds what the contact kernels read, so that a contact touches one
/// cache line a body; the integer force sums are a second, 32-byte row. Cold data lies in separate arrays. Rows are
/// re-sorted along a space-filling curve when neighbour lists are rebuilt; `id` never changes and `row_of_id` finds a
/// body.
#ifndef SCREE_STATE_STATE_H
#define SCREE_STATE_STATE_H

#include "base/memory.h"
#include "base/vectors.h"
#include "model/model.h"
#include "module/module.h"

#include <math.h>
#include <stdbool.h>

/// Velocities are those of the scheme: position_verlet keeps v(n - 1/2), velocity_verlet v(n). `scree_body_velocity` in
/// integrate.h gives the physical velocity at n.
///
/// A row serves both dimensions. In 2D the material lies in the slot of z and the spin in the slot of vz; in 3D both
/// lie in `scree_turn_row`. Outside the kernels use scree_body_place, scree_body_motion, scree_body_material.
typedef struct scree_row {
    double x, y; ///< m
    union {
        double material; ///< 2D: index as a double, since rows are moved as vectors of doubles
        double z;        ///< 3D: m
    };
    double radius; ///< m
    double vx, vy; ///< m/s
    union {
        double spin; ///< 2D: rad/s, counter-clockwise
        double vz;   ///< 3D: m/s
    };
    double mass; ///< kg
} scree_row;

/// 3D only: angular velocity and material.
typedef struct scree_turn_row {
    double wx, wy, wz; ///< rad/s
    double material;   ///< index as a double
} scree_turn_row;

/// Sum of the contact and boundary forces on a body at step n, in quanta (base/fixed.h).
typedef struct scree_sum_row {
    int64_t fx, fy; ///< force quanta
    union {
        int64_t torque; ///< 2D: torque quanta
        int64_t fz;     ///< 3D: force quanta
    };
    int64_t contacts; ///< number of touching neighbours and walls
} scree_sum_row;

/// What the next step will do to a body if its forces stay as they are, for laws that look ahead (contact/laws.h): the
/// increments of its velocity and spin, and the number of its contacts. Derived; valid from the drift to the forces.
typedef struct scree_foreseen {
    double vx, vy; ///< m/s
    union {
        double spin; ///< 2D: rad/s
        double vz;   ///< 3D: m/s
    };
    double contacts;
    double wx, wy, wz; ///< 3D: rad/s
    double unused;     ///< zero
} scree_foreseen;

/// 3D only: sum of the torques, in torque quanta.
typedef struct scree_torque_row {
    int64_t x, y, z;
    int64_t unused; ///< zero; keeps the row at 32 bytes, which kernels move at once
} scree_torque_row;

/// In the place of a species: a body of a membrane.
#define SCREE_NO_SPECIES UINT8_MAX

/// A vector of cold data; z is zero in 2D.
typedef double scree_vector[3];

/// Memory of one contact between the bodies (or body and wall) with ids first < second. Signs are those of the contact
/// seen from `first` (n from second to first); a wall is always `second`, with id SCREE_WALL_ID + wall index; an
/// element of the walls of a case (shape/container.h) with id SCREE_ELEMENT_ID + its number.
#define SCREE_WALL_ID    UINT32_C(0xfffffff0)
#define SCREE_ELEMENT_ID UINT32_C(0x80000000)
#define SCREE_ELEMENTS   (SCREE_WALL_ID - SCREE_ELEMENT_ID) /* most elements */
#define SCREE_HISTORY    4
typedef struct scree_history {
    double value[SCREE_HISTORY]; ///< meaning depends on the law: see the head of its file in src/contact/
} scree_history;

/// hertz_mindlin in 3D, for the ledger: damping forces at n - 1 that the ledger needs again. Single precision is
/// enough: each enters a mean with the present force, and the rounding errors have no preferred sign.
typedef struct scree_booking {
    float value[4]; ///< N: normal, tangential x, y, z
} scree_booking;

/// Memory of rolling and twisting resistance (only with materials that have it), and its booking.
typedef struct scree_rolling {
    double value[4]; ///< 2D: rolling stretch; 3D: rolling stretch x, y, z [m], twist [rad]
    float booked[4]; ///< dashpots at n - 1, in the same order
} scree_rolling;

typedef struct scree_contact_memory {
    uint32_t first, second; ///< ids
    scree_history history;
} scree_contact_memory;

/// Energy ledger, J. Work is done ON the bodies; dissipation is positive. Residual of the balance:
/// kinetic + elastic - initial - (plates + pressure + boundary + periodic + gravity) + damping + friction - stiffness -
/// scheme: measure/energy.c.
typedef struct scree_ledger {
    double damping;   ///< dissipated by contact damping, normal and tangential
    double friction;  ///< dissipated by sliding
    double stiffness; ///< put into tangential springs by the change of their stiffness with indentation (hertz_mindlin)
    double plates;    ///< work of the walls
    double pressure;  ///< work of the pressure on the Delaunay boundary or the membrane
    double boundary;  ///< work of the other forces of the boundary: imposed rates, springs and ends of a membrane
    double periodic;  ///< work of the deforming periodic cell
    double forced;    ///< work of the torque that keeps a body at a prescribed spin
    double gravity;   ///< sum of m g . x when the ledger was opened
    double initial;   ///< kinetic + elastic energy when the ledger was opened
    double scheme;    ///< put into the kinetic energy of the scheme by changes of its step (measure/energy.c)
    double turnover;  ///< sum of |work| increments, the scale of the residual
} scree_ledger;

typedef struct scree_stage_state {
    int64_t index;              ///< which stage of the case
    uint64_t first_step;        ///< step at which it began
    double first_time;          ///< s
    uint64_t first_evaluations; ///< state.evaluations when it began
    int64_t samples;            ///< rows written in this stage
    int64_t snapshots;
    int64_t counter; ///< stage-specific
} scree_stage_state;

/// Time spent so far, all processes of the run together. Kept in checkpoints beside the state: nothing depends on it.
typedef struct scree_time_spent {
    double run, stage; ///< s, on the wall, of the run and of its present or last stage
    double processor;  ///< s, of the stage, all threads together
} scree_time_spent;

struct scree_state {
    int dimension; ///< 2 or 3
    size_t count;
    size_t grains;            ///< bodies with ids below it are the assembly, those from it on belong to a membrane
    uint64_t step;            ///< time of the run in ticks; time = stage.first_time + (step - stage.first_step) * tick
    uint64_t evaluations;     ///< steps taken since the start of the run, one force evaluation each
    double tick;              ///< s, the small step of two_timescales, the step of all other schemes
    double step_size;         ///< s, the last step, from n - 1 to n
    double kick_size;         ///< s, what leapfrog velocities were advanced by in it: the mean of it and the one before
    size_t row_capacity;      ///< of row, turn, sum, torque, id, foreseen: room for the images of a periodic cell
                              ///< (state/work.h)
    scree_row *row;           ///< count
    scree_turn_row *turn;     ///< 3D: count; NULL in 2D
    scree_sum_row *sum;       ///< count, forces at `step`
    scree_torque_row *torque; ///< 3D: count; NULL in 2D
    double force_quantum;     ///< N
    double torque_quantum;    ///< N m
    double largest_overlap;   ///< m, over all contacts at `step`
    double largest_speed;     ///< m/s, bound of |v| + radius |spin| over all bodies
    // cold
    uint32_t *id;                   ///< count
    uint8_t *species;               ///< count; SCREE_NO_SPECIES: no particle
    double *angle;                  ///< 2D: rad, orientation; NULL in 3D
    scree_vector *reference;        ///< m, positions at the start of the loading stage
    scree_vector *sampled_velocity; ///< m/s, at `sampled_step`: the mean unbalanced force is from them
    uint64_t sampled_step;          ///< step of the last sample
    scree_vector *rebuild;          ///< m, positions at the last neighbour rebuild (derived, kept sorted with rows)
    uint32_t *row_of_id;            ///< derived
    scree_foreseen *foreseen;       ///< derived, sorted with rows; NULL unless the law looks ahead
    // contacts: filled from `work` by scree_contacts_save, consumed by scree_contacts_load (contact/contact.h)
    scree_contact_memory *contact;
    scree_booking *booking; ///< beside `contact` where the law has booking rows; else NULL
    scree_rolling *rolling; ///< beside `contact` with rolling resistance; else NULL
    size_t contact_count, contact_capacity;
    void *own[SCREE_MODULE_COUNT]; ///< the struct of each module that has one (module/module.h), by slot
    scree_ledger ledger;
    scree_stage_state stage;
    scree_time_spent spent;
};

/// A state without bodies: the structs of all modules, zero. Errors: memory.
scree_status scree_state_open(scree_state *state, int dimension, scree_error *error) SCREE_MUST_USE;

/// A state with `count` bodies of dimension 2 or 3, ids 0 .. count-1, everything else zero.
scree_status scree_state_create(scree_state *state, int dimension, size_t count, scree_error *error) SCREE_MUST_USE;
/// The same for a state that is open and has no bodies yet; on failure it is destroyed.
scree_status scree_state_make_bodies(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;
void scree_state_destroy(scree_state *state);

/// Grows the arrays that contacts read and write (row, turn, sum, torque, id, foreseen) to hold `count` rows. Errors:
/// memory.
scree_status scree_state_reserve_rows(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

/// Position of the body in `row` [m]; z = 0 in 2D.
static inline void scree_body_place(const scree_state *state, size_t row, scree_vector place)
{
    const scree_row *body = &state->row[row];
    place[0] = body->x;
    place[1] = body->y;
    place[2] = state->dimension == 3 ? body->z : 0;
}

/// Velocity [m/s] and spin [rad/s] that the scheme keeps; in 2D vz = 0 and the spin is about z.
static inline void scree_body_motion(const scree_state *state, size_t row, scree_vector velocity, scree_vector spin)
{
    const scree_row *body = &state->row[row];
    bool solid = state->dimension == 3;
    velocity[0] = body->vx;
    velocity[1] = body->vy;
    velocity[2] = solid ? body->vz : 0;
    spin[0] = solid ? state->turn[row].wx : 0;
    spin[1] = solid ? state->turn[row].wy : 0;
    spin[2] = solid ? state->turn[row].wz : body->spin;
}

/// Index of the material of the body in `row`.
static inline int scree_body_material(const scree_state *state, size_t row)
{
    return (int)(state->dimension == 3 ? state->turn[row].material : state->row[row].material);
}

/// Moment of inertia [kg m2] of the body in `row`: m R^2 / 2 of a disc (a cylinder), 2 m R^2 / 5 of a sphere.
static inline double scree_body_inertia(const scree_state *state, size_t row)
{
    const scree_row *body = &state->row[row];
    return (state->dimension == 3 ? 0.4 : 0.5) * body->mass * body->radius * body->radius;
}

/// Makes room for what laws that look ahead need, if there is none yet.
scree_status scree_state_foresee(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// The body in `row` is of the assembly, not of a membrane.
static inline bool scree_body_is_grain(const scree_state *state, size_t row)
{
    return state->id[row] < state->grains;
}

/// Adds `more` bodies behind those that there are, with the ids that follow, all zero. Everything that refers to rows
/// stays valid, neighbour lists excepted: save the contacts before. Errors: memory, the state is unchanged then.
scree_status scree_state_append(scree_state *state, size_t more, scree_error *error) SCREE_MUST_USE;

/// s; never accumulated.
double scree_state_time(const scree_state *state);

/// Bytes of the widest of the elements that bodies have in the arrays that move with the rows.
size_t scree_state_widest(const scree_state *state);

/// Moves every body array to the order row k <- row order[k], and renews row_of_id. Errors: memory; nothing has moved
/// then.
scree_status scree_state_permute(scree_state *state, const uint32_t *order, scree_error *error) SCREE_MUST_USE;

/// Checksum of what the state is physically, by the definition in docs/architecture.md, which does not depend on how
/// the structs are laid out. Contacts must have been saved. Equal for any order of rows, any number of threads and any
/// bookkeeping of stages, boundaries, samples and quanta. Cost: some 50 ns a body and 20 ns a contact.
uint64_t scree_state_checksum(const scree_model *model, const scree_state *state);

/// Grows the contact memory to hold `count`, and the booking and rolling rows beside it where there are any.
scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

/// Frees the contact memory and what lies beside it.
void scree_state_release_contacts(scree_state *state);

/// Puts booking rows, and rolling rows, beside the contact memory; nothing happens where there are some.
scree_status scree_state_add_booking(scree_state *state, scree_error *error) SCREE_MUST_USE;
scree_status scree_state_add_rolling(scree_state *state, scree_error *error) SCREE_MUST_USE;

#endif
