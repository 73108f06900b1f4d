/// What changes during a run: exactly what is needed to continue it bit for bit. Everything else is `work` and can be
/// thrown away at any moment between two steps.
///
/// Hot data. One 64-byte row a body (`scree_row`) holds what the contact kernels read, so that a contact touches one
/// cache line a body; the integer force sums are a second, 32-byte row. Cold data lies in separate arrays. Rows are
/// re-sorted along a space-filling curve when neighbour lists are rebuilt; `id` never changes, and scree_state_row_of
/// finds a body. Bodies come and go in mid-run. An id is never given again, so ids have holes: what needs an order of
/// bodies goes through them with scree_next_by_id, all else through rows. State: scree_row and the other arrays with
/// one element a body are declared in fields.c, those of modules in their own files (store.h).
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
/// lie in `scree_turn_row`. Outside the kernels use the functions of state/body.h.
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

/// What a body is there for. Which components of its motion are prescribed is said by `held` of the state.
typedef enum scree_mark {
    SCREE_MARK_GRAIN,    ///< of the assembly
    SCREE_MARK_MEMBRANE, ///< of a membrane around it
    SCREE_MARKS
} scree_mark;

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
typedef struct scree_predicted {
    double vx, vy; ///< m/s
    union {
        double spin; ///< 2D: rad/s
        double vz;   ///< 3D: m/s
    };
    double contacts;
    double wx, wy, wz; ///< 3D: rad/s
    double unused;     ///< zero
} scree_predicted;

/// Numbers of a row of state->moment: the tensor by rows, in 3D filled up to 96 bytes, which kernels move in three.
enum { SCREE_MOMENTS_2D = 4, SCREE_MOMENTS_3D = 12 };

/// Numbers of a row of state->stretch [m], which kernels move whole: radius times strain, 2D xx, yy, xy and the reach;
/// 3D xx, yy, zz, the reach, yz, xz, xy and zero. The reach: no point of the surface has moved out by more. Behind
/// them, as many, the changes in the last step.
enum { SCREE_STRETCHES_2D = 8, SCREE_STRETCHES_3D = 16, SCREE_STRETCH_REACH = 3 };

/// 3D only: sum of the torques, in torque quanta.
typedef struct scree_torque_row {
    int64_t x, y, z;
    int64_t unused; ///< zero; keeps the row at 32 bytes, which kernels move at once
} scree_torque_row;

/// In the place of a species: a body of a membrane.
#define SCREE_NO_SPECIES UINT8_MAX

/// Sizes of a body that is not round, in 2D: its row has the bounding radius.
typedef struct scree_form {
    double radius;  ///< m, of the disc of equal area
    double turning; ///< m, of the disc of equal mass and equal moment of inertia
} scree_form;

/// A vector of cold data; z is zero in 2D.
typedef double scree_vector[3];

/// Memory of one contact between the bodies (or body and wall) with ids first < second. Signs are those of the contact
/// seen from `first` (n from second to first); a wall is always `second`, with id SCREE_WALL_ID + wall index; an
/// element of the walls of a case (shape/wall_set.h) with id SCREE_PRIMITIVE_ID + its number.
#define SCREE_WALL_ID      UINT32_C(0xfffffff0)
#define SCREE_PRIMITIVE_ID UINT32_C(0x80000000)
#define SCREE_PRIMITIVES   (SCREE_WALL_ID - SCREE_PRIMITIVE_ID) /* most elements */
#define SCREE_HISTORY      4
typedef struct scree_history {
    double value[SCREE_HISTORY]; ///< meanings: the fields that the law declares
} scree_history;

/// hertz_mindlin in 3D, for the ledger: damping forces at n - 1 that the ledger needs again. Single precision is
/// enough: each enters a mean with the present force, and the rounding errors have no preferred sign.
typedef struct scree_last_force {
    float value[4]; ///< N: normal, tangential x, y, z
} scree_last_force;

/// More rows where the law wants them: for rolling and twisting resistance, and its last_force.
typedef struct scree_rolling {
    double value[4]; ///< 2D: rolling displacement; 3D: rolling displacement x, y, z [m], twist [rad]
    float last[4];   ///< dashpots at n - 1, in the same order
} scree_rolling;

typedef struct scree_contact_memory {
    uint32_t first, second; ///< ids
    scree_history history;
} scree_contact_memory;

/// Numbers of its own that a pair of the persistent list has (state/persistent.h). What they are is the affair of its
/// law, but for these: the overlap at which the pair is at rest [m], and the strengths of its bond.
enum {
    SCREE_MEMBER_REST = 0,
    SCREE_MEMBER_TENSION = 1, ///< N; infinite: the bond does not break so; negative: it is broken
    SCREE_MEMBER_SHEAR = 2,   ///< N, without normal force; infinite in the same way
    SCREE_MEMBER_SLOPE = 3,   ///< 1, what a compressive normal force adds to the strength in shear
    SCREE_MEMBER_CONSTANTS = 4
};
#define SCREE_MEMBER_BROKEN (-1.0) ///< in place of the strength in tension
typedef struct scree_member_row {
    double value[SCREE_MEMBER_CONSTANTS];
} scree_member_row;

/// Lists of contacts whose memory is told apart, as laws differ.
typedef enum scree_list { SCREE_LIST_CONTACTS, SCREE_LIST_PERSISTENT, SCREE_LISTS } scree_list;

/// Whose memory the contacts of a list have: the law and its option say which fields there are
/// (state/memory_fields.h).
typedef struct scree_remembered_law {
    const scree_module *law; ///< NULL: none yet
    unsigned option;
} scree_remembered_law;

/// Energy ledger, J. Work is done ON the bodies; dissipation is positive. Residual of the balance:
/// kinetic + elastic - initial - (plates + pressure + boundary + periodic + forced + outside + gravity) + damping +
/// friction - stiffness - scheme + removed: measure/energy.c.
typedef struct scree_ledger {
    double damping;   ///< dissipated by contact damping, normal and tangential
    double friction;  ///< dissipated by sliding
    double stiffness; ///< put into tangential springs by the change of their stiffness with overlap (hertz_mindlin)
    double plates;    ///< work of the walls
    double pressure;  ///< work of the pressure on the Delaunay boundary or the membrane
    double boundary;  ///< work of the other forces of the boundary: imposed rates, springs and ends of a membrane
    double periodic;  ///< work of the deforming periodic cell
    double forced;    ///< work of the torque that keeps a body at a prescribed spin
    double gravity;   ///< sum of m g . x when the ledger was opened
    double initial;   ///< kinetic + elastic energy when the ledger was opened
    double scheme;    ///< put into the kinetic energy by the scheme: changes of its step, errors (measure/energy.c)
    double turnover;  ///< sum of |work| increments, the scale of the residual
    double outside;   ///< work from outside of the program: own forces, changes of bodies (include/scree/simulation.h)
    double removed;   ///< energy that left with bodies that were taken out (measure/removal.c)
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
    int dimension;              ///< 2 or 3
    bool part;                  ///< the others of `total` bodies are with other processes (comm/parts.h) (derived)
    size_t count;               ///< bodies that are here
    size_t next_id;             ///< ids that were ever given: 0 .. next_id - 1
    size_t id_count;            ///< ids from it on are of no body that is here (derived)
    size_t marked[SCREE_MARKS]; ///< bodies with each mark (derived)
    uint64_t changes;           ///< appends and removals in this process: lists of rows made before are void (derived)
    size_t total;               ///< of a part: bodies of all processes (derived)
    uint64_t step;            ///< time of the run in ticks; time = stage.first_time + (step - stage.first_step) * tick
    uint64_t evaluations;     ///< steps taken since the start of the run, one force evaluation each
    double tick;              ///< s, the small step of two_timescales, the step of all other schemes
    double step_size;         ///< s, the last step, from n - 1 to n
    double kick_size;         ///< s, what leapfrog velocities were advanced by in it: the mean of it and the one before
    size_t body_capacity;     ///< of the arrays with one element a body
    size_t row_capacity;      ///< of those that have room for the ghosts of a periodic cell, too (state/work.h)
    size_t id_capacity;       ///< of row_of_id
    scree_row *row;           ///< count
    scree_turn_row *turn;     ///< 3D: count; NULL in 2D
    scree_sum_row *sum;       ///< count, forces at `step`
    scree_torque_row *torque; ///< 3D: count; NULL in 2D
    int64_t *moment;          ///< of a row: scree_moment_size, of scree_moment_unit; NULL unless a module asks for them
    double *stretch;          ///< of a row: scree_stretch_size numbers; NULL unless bodies deform
    scree_form *form;         ///< of a row; NULL: all bodies are round
    double force_quantum;     ///< N
    double torque_quantum;    ///< N m
    double largest_overlap;   ///< m, over all contacts at `step`
    double largest_speed;     ///< m/s, bound of |v| + radius |spin| over all bodies
    // cold
    uint32_t *id;                   ///< count
    uint8_t *mark;                  ///< count, scree_mark
    uint8_t *species;               ///< count; SCREE_NO_SPECIES: no particle
    uint8_t *held;                  ///< count, bits of components of motion that are prescribed; NULL: none is
    double *angle;                  ///< 2D: rad, orientation; NULL in 3D
    double turned_since;            ///< s, time from which angles of round bodies, and orientations in 3D, count
    scree_vector *reference;        ///< m, positions at the start of the loading stage
    double *reference_angle;        ///< 2D: rad, orientations then; NULL: all bodies are round
    scree_vector *sampled_velocity; ///< m/s, at `sampled_step`: the mean unbalanced force is from them
    uint64_t sampled_step;          ///< step of the last sample
    scree_vector *rebuild;          ///< m, positions at the last neighbour rebuild (derived, kept sorted with rows)
    uint32_t *row_of_id;            ///< id_count (derived); SCREE_NO_ROW: taken out; NULL in a part
    struct scree_row_table *rows;   ///< of a part, in its place (state/row_table.h, derived); else NULL
    scree_predicted *predicted;     ///< derived, sorted with rows; NULL unless the law looks ahead
    scree_predicted *lead; ///< what velocities and spins at n are more than those of the rows, for dashpots and
                           ///< forces from outside; NULL: the scheme does not know them (integrate/gear.c)
    // contacts: filled from `work` by scree_contacts_save, consumed by scree_contacts_load (contact/contact.h)
    scree_contact_memory *contact;
    scree_last_force *last_force; ///< beside `contact` where the law has last_force rows; else NULL
    scree_rolling *rolling;       ///< beside `contact` with rolling resistance; else NULL
    uint8_t *contact_law;         ///< beside `contact` where they follow several laws: the number of each; else NULL
    size_t contact_count, contact_capacity;
    scree_remembered_law law[SCREE_LISTS]; ///< of the model (derived; checkpoints say it of their contacts)
    scree_remembered_law pair_law[SCREE_MOST_PAIR_LAWS]; ///< of contacts, behind the first; in the same way
    int pair_laws;                                       ///< so many
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

/// Grows the arrays of bodies that ghosts have rows of, too, to hold `count` rows. Errors: memory.
scree_status scree_state_reserve_rows(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

/// Not the row of a body.
#define SCREE_NO_ROW UINT32_MAX

/// The same of a part.
uint32_t scree_row_table_find(const struct scree_row_table *table, size_t id);

/// Row of the body with this id; SCREE_NO_ROW when there is none here, or none any more.
static inline uint32_t scree_state_row_of(const scree_state *state, size_t id)
{
    if (state->rows) return scree_row_table_find(state->rows, id);
    return id < state->id_count ? state->row_of_id[id] : SCREE_NO_ROW;
}

/// Bodies in the order of their ids: row of the first one from *id on, and puts *id behind it; SCREE_NO_ROW when there
/// is none any more. Begin with *id = 0.
static inline uint32_t scree_next_by_id(const scree_state *state, size_t *id)
{
    while (*id < state->id_count) {
        const uint32_t row = scree_state_row_of(state, (*id)++);
        if (row != SCREE_NO_ROW) return row;
    }
    return SCREE_NO_ROW;
}

/// Bodies of all processes.
static inline size_t scree_state_total(const scree_state *state)
{
    return state->part ? state->total : state->count;
}

/// Number of grains: bodies of the assembly.
static inline size_t scree_grain_count(const scree_state *state)
{
    return state->marked[SCREE_MARK_GRAIN];
}

/// Rows of the grains in the order of their ids, scree_grain_count of them; to be released. Errors: memory.
scree_status scree_grains_by_id(const scree_state *state, uint32_t **rows, scree_error *error) SCREE_MUST_USE;

/// Makes the array of an optional field of bodies, all zero, if there is none yet. Errors: memory.
scree_status scree_state_begin_field(scree_state *state, const scree_field *field, scree_error *error) SCREE_MUST_USE;

/// Makes room for the sizes of bodies that are not round, if there is none yet; all zero. Errors: memory.
scree_status scree_state_begin_form(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Makes room for what laws that look ahead need, if there is none yet.
scree_status scree_state_predict(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Adds `more` bodies with a mark behind those that there are, with ids that were never given, all else zero. What
/// refers to bodies by id stays valid, what refers to rows does not reach the new ones; the neighbour list is made anew
/// at its next refresh, with the contacts that are in the state: save them before (scree_contacts_save). Errors:
/// memory, the state is unchanged then. Cost: amortised constant a body.
scree_status scree_state_append(scree_state *state, scree_mark mark, size_t more, scree_error *error) SCREE_MUST_USE;

/// Takes the bodies with these ids out; the last rows move into theirs. What the contact memory and the modules say of
/// them is forgotten. The neighbour list is made anew at its next refresh: save the contacts before. Forces that gone
/// bodies exerted are still in the sums of the others, and their energy in the balance: scree_bodies_remove
/// (measure/removal.h) sees to both. Errors: SCREE_ERROR_INPUT: no such body, one twice, or one that a module keeps;
/// the state is unchanged then. Cost: amortised constant a body, and a pass over the saved contacts.
scree_status scree_state_remove(scree_state *state, const uint32_t *ids, size_t count,
                                scree_error *error) SCREE_MUST_USE;
/// The errors of scree_state_remove alone.
scree_status scree_state_check_removal(scree_state *state, const uint32_t *ids, size_t count,
                                       scree_error *error) SCREE_MUST_USE;

/// Finds the row of each id, and counts the marks, after id, mark and next_id were set from outside. Errors: memory;
/// SCREE_ERROR_INPUT with the row of an id that is there twice or was never given.
scree_status scree_state_find_rows(scree_state *state, scree_error *error) SCREE_MUST_USE;

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

/// Grows the contact memory to hold `count`, and the last_force and rolling rows beside it where there are any.
scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

/// Frees the contact memory and what lies beside it.
void scree_state_release_contacts(scree_state *state);

/// From now on contacts, and pairs that are held, remember what the laws of the model say. Those that are there must be
/// of these laws already.
void scree_state_set_laws(scree_state *state, const scree_model *model);

/// Integers that a row of state->moment has in this dimension.
static inline size_t scree_moment_size(int dimension)
{
    return dimension == 3 ? SCREE_MOMENTS_3D : SCREE_MOMENTS_2D;
}

/// From the next evaluation on the moments of contact forces are summed, or no longer. Errors: memory.
scree_status scree_state_ask_for_moments(scree_state *state, bool wanted, scree_error *error) SCREE_MUST_USE;

/// Numbers that a row of state->stretch has in this dimension.
static inline size_t scree_stretch_size(int dimension)
{
    return dimension == 3 ? SCREE_STRETCHES_3D : SCREE_STRETCHES_2D;
}

/// Row of state->stretch, of a ghost too; NULL where bodies are rigid.
static inline double *scree_stretch_row(const scree_state *state, size_t row)
{
    return state->stretch ? state->stretch + row * scree_stretch_size(state->dimension) : NULL;
}

/// From now on bodies deform; as yet they are not strained. Nothing happens where they do already. Errors: memory.
scree_status scree_state_ask_for_stretches(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Puts last_force rows, rolling rows, and numbers of laws beside the contact memory; nothing happens where there are
/// some.
scree_status scree_state_add_contact_law(scree_state *state, scree_error *error) SCREE_MUST_USE;
scree_status scree_state_add_last_force(scree_state *state, scree_error *error) SCREE_MUST_USE;
scree_status scree_state_add_rolling(scree_state *state, scree_error *error) SCREE_MUST_USE;

#endif
