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
#include "model/model.h"

/// Velocities are those of the scheme: position_verlet keeps v(n - 1/2), velocity_verlet v(n). `state_velocity` in
/// integrate.h gives the physical velocity at n.
typedef struct scree_row {
    double x, y;     ///< m
    double material; ///< index as a double: rows are moved as vectors of doubles
    double radius;   ///< m
    double vx, vy;   ///< m/s
    double spin;     ///< rad/s, counter-clockwise
    double mass;     ///< kg
} scree_row;

/// Sum of the contact and boundary forces on a body at step n, in quanta (base/fixed.h).
typedef struct scree_sum_row {
    int64_t fx, fy;   ///< force quanta
    int64_t torque;   ///< torque quanta
    int64_t contacts; ///< number of touching neighbours and walls
} scree_sum_row;

/// What the next step will do to a body if its forces stay as they are, for laws that look ahead (contact/laws.h): the
/// increments of its velocity and spin, and the number of its contacts. Derived; valid from the drift to the forces.
typedef struct scree_foreseen {
    double vx, vy; ///< m/s
    double spin;   ///< rad/s
    double contacts;
} scree_foreseen;

/// Memory of one contact between the bodies (or body and wall) with ids first < second. Signs are those of the contact
/// seen from `first` (n from second to first); a wall is always `second`, with id SCREE_WALL_ID + wall index.
#define SCREE_WALL_ID UINT32_C(0xfffffff0)
#define SCREE_HISTORY 4
typedef struct scree_history {
    double value[SCREE_HISTORY]; ///< meaning depends on the law: see the head of its file in src/contact/
} scree_history;

typedef struct scree_contact_memory {
    uint32_t first, second; ///< ids
    scree_history history;
} scree_contact_memory;

/// A rigid plane wall: all bodies lie on the side that its unit normal points to. Plates move along their normal.
typedef struct scree_wall {
    double position;            ///< m, along the normal: points x with normal . x = position
    double normal[2];           ///< 1
    double velocity;            ///< m/s along the normal, v(n - 1/2): position(n) = position(n-1) + velocity dt
    double force;               ///< N, normal force by the bodies on the wall at n, compression positive
    double shear;               ///< N, tangential force by the bodies on the wall at n
    double tangential_velocity; ///< m/s along (-normal y, normal x)
    int32_t active;             ///< 0: does not exist in this stage
    int32_t material;           ///< material index of the plate
} scree_wall;

enum { SCREE_WALL_BOTTOM, SCREE_WALL_TOP, SCREE_WALL_LEFT, SCREE_WALL_RIGHT, SCREE_WALL_COUNT };

/// Energy ledger, J. Work is done ON the bodies; dissipation is positive. Residual of the balance:
/// kinetic + elastic - initial - (plates + pressure + gravity) + damping + friction - stiffness - scheme:
/// measure/energy.c.
typedef struct scree_ledger {
    double damping;   ///< dissipated by contact damping, normal and tangential
    double friction;  ///< dissipated by sliding
    double stiffness; ///< put into tangential springs by the change of their stiffness with indentation (hertz_mindlin)
    double plates;    ///< work of the walls
    double pressure;  ///< work of the pressure on the Delaunay boundary
    double gravity;   ///< sum of m g . x when the ledger was opened
    double initial;   ///< kinetic + elastic energy when the ledger was opened
    double scheme;    ///< put into the kinetic energy of the scheme by changes of its step (measure/energy.c)
    double turnover;  ///< sum of |work| increments, the scale of the residual
} scree_ledger;

/// Closed loop of bodies on the outer Delaunay boundary, counter-clockwise, by id; empty when there is none.
typedef struct scree_loop {
    uint32_t *id;
    uint8_t *loaded; ///< 1: the edge from id[k] to id[k+1] carries the lateral pressure
    double *x, *y;   ///< m, positions at `updated`; the strain increment since then is measured from them
    double *fx,
        *fy; ///< N, pressure force on each body of the loop at the present step (first half of the next work increment)
    size_t count, capacity;
    uint64_t updated; ///< step of the last update
} scree_loop;

/// Strain accumulated from the Delaunay boundary (Bagi), see measure/strain.h; compression is NEGATIVE here (tensor).
typedef struct scree_strain {
    double gradient[4]; ///< accumulated displacement gradient: xx, xy, yx, yy (d u_row / d x_column)
} scree_strain;

typedef struct scree_stage_state {
    int64_t index;       ///< which stage of the case
    uint64_t first_step; ///< step at which it began
    double first_time;   ///< s
    double reference[8]; ///< stage-specific numbers (height at start, pressure at start, ...): see the stage's file
    int64_t samples;     ///< rows written in this stage
    int64_t snapshots;
    int64_t counter; ///< stage-specific
} scree_stage_state;

typedef struct scree_state {
    size_t count;
    uint64_t step;          ///< time of the run in ticks; time = stage.first_time + (step - stage.first_step) * tick
    uint64_t evaluations;   ///< steps taken since the start of the run, one force evaluation each
    double tick;            ///< s, the small step of two_timescales, the step of all other schemes
    double step_size;       ///< s, the last step, from n - 1 to n
    double kick_size;       ///< s, what leapfrog velocities were advanced by in it: the mean of it and the one before
    scree_row *row;         ///< count
    scree_sum_row *sum;     ///< count, forces at `step`
    double force_quantum;   ///< N
    double torque_quantum;  ///< N m
    double largest_overlap; ///< m, over all contacts at `step`
    double largest_speed;   ///< m/s, bound of |v| + radius |spin| over all bodies
    // cold
    uint32_t *id;                      ///< count
    double *angle;                     ///< rad, orientation
    double *reference_x, *reference_y; ///< m, positions at the start of the loading stage
    double *sampled_vx, *sampled_vy;   ///< m/s, velocities at `sampled_step`: the mean unbalanced force is from them
    uint64_t sampled_step;             ///< step of the last sample
    double *rebuild_x, *rebuild_y;     ///< m, positions at the last neighbour rebuild (derived, kept sorted with rows)
    uint32_t *row_of_id;               ///< derived
    scree_foreseen *foreseen;          ///< derived, sorted with rows; NULL unless the law looks ahead
    // contacts: filled from `work` by scree_contacts_save, consumed by scree_contacts_load (contact/contact.h)
    scree_contact_memory *contact;
    size_t contact_count, contact_capacity;
    scree_wall wall[SCREE_WALL_COUNT];
    double pressure; ///< Pa, lateral pressure applied now
    scree_loop loop;
    scree_strain strain;
    scree_ledger ledger;
    scree_stage_state stage;
} scree_state;

/// Allocates arrays for `count` bodies, ids 0 .. count-1, everything else zero.
scree_status scree_state_create(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;
void scree_state_destroy(scree_state *state);

/// Makes room for what laws that look ahead need, if there is none yet.
scree_status scree_state_foresee(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// s; never accumulated.
double scree_state_time(const scree_state *state);

/// Moves every body array to the order row k <- row order[k], and renews row_of_id. `scratch` is grown when needed.
scree_status scree_state_permute(scree_state *state, const uint32_t *order, scree_error *error) SCREE_MUST_USE;

/// 64-bit checksum over every state field in id order (bits, not values), contacts, walls, loop, strain and ledger.
/// Contacts must have been saved. Equal states in different row orders give the same number.
uint64_t scree_state_checksum(const scree_state *state);

/// Grows the contact memory to hold `count`.
scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

#endif
