/// The one loop that all schemes are made of: v += h a, h in s, optionally x += dt v and, in 2D, angle += dt spin.
/// Mass and inertia: m, m R^2 / 2 of a disc, 2 m R^2 / 5 of a sphere, R the turning radius of state/body.h. Cost: one
/// division and about 30 flops a body (50 in 3D); streams one row and one sum, in 3D a row of spins and one of torques
/// more. A kick before a drift is the last to read the sums: it leaves them clear for the forces at the new positions,
/// while they are in the cache. Rows that sleep are no part of it.
#ifndef SCREE_INTEGRATE_KICK_H
#define SCREE_INTEGRATE_KICK_H

#include "base/fixed.h"
#include "integrate/integrate.h"
#include "search/moved.h"
#include "state/sleep.h"

#include <math.h>

/// What one step adds: h times the quanta and gravity. whole: of the part of a kick before a drift, all of it.
typedef struct scree_kick_scale {
    double force, torque;
    double gravity[3];
    double whole;
} scree_kick_scale;

/// The arrays of the state, in registers while a loop runs.
typedef struct scree_kick_rows {
    scree_row *row;
    scree_turn_row *turn;
    scree_sum_row *sum;
    scree_torque_row *torque;
    double *angle;
    scree_predicted *predicted;
    const scree_form *form; ///< NULL: all are round
} scree_kick_rows;

#define KICK_INLINE static inline __attribute__((always_inline))

/// Adds to velocity and spin; returns what it has added, and the number of contacts.
KICK_INLINE scree_predicted scree_kick_velocity(int dimension, const scree_kick_rows *rows, size_t i,
                                                const scree_kick_scale *scale)
{
    scree_row *row = &rows->row[i];
    const scree_sum_row *sum = &rows->sum[i];
    // One division for mass and inertia.
    const double radius = rows->form ? rows->form[i].turning : row->radius;
    double square = radius * radius, inverse = 1.0 / (row->mass * square), inverse_mass = inverse * square;
    scree_predicted added = {.vx = (double)sum->fx * scale->force * inverse_mass + scale->gravity[0],
                             .vy = (double)sum->fy * scale->force * inverse_mass + scale->gravity[1],
                             .contacts = (double)sum->contacts};
    row->vx += added.vx;
    row->vy += added.vy;
    if (dimension == 2) {
        added.spin = (double)sum->torque * (scale->torque * 2.0) * inverse;
        row->spin += added.spin;
        return added;
    }
    scree_turn_row *turn = &rows->turn[i];
    const scree_torque_row *torque = &rows->torque[i];
    double inverse_inertia = scale->torque * 2.5 * inverse;
    added.vz = (double)sum->fz * scale->force * inverse_mass + scale->gravity[2];
    added.wx = (double)torque->x * inverse_inertia;
    added.wy = (double)torque->y * inverse_inertia;
    added.wz = (double)torque->z * inverse_inertia;
    row->vz += added.vz;
    turn->wx += added.wx;
    turn->wy += added.wy;
    turn->wz += added.wz;
    return added;
}

/// Keeps what a kick has added for the laws that look ahead.
KICK_INLINE void scree_kick_predict(int dimension, scree_predicted *row, scree_predicted added, double whole)
{
    row->vx = added.vx * whole;
    row->vy = added.vy * whole;
    row->spin = added.spin * whole;
    row->contacts = added.contacts;
    if (dimension == 2) return;
    row->wx = added.wx * whole;
    row->wy = added.wy * whole;
    row->wz = added.wz * whole;
}

/// Moves a body; returns |v|^2, and R |w| in 2D, its square in 3D.
KICK_INLINE scree_speeds scree_drift(int dimension, const scree_kick_rows *rows, size_t i, double dt)
{
    scree_row *row = &rows->row[i];
    row->x += dt * row->vx;
    row->y += dt * row->vy;
    double speed2 = row->vx * row->vx + row->vy * row->vy;
    if (dimension == 2) {
        rows->angle[i] += dt * row->spin;
        return (scree_speeds){.spin = row->radius * fabs(row->spin), .centre = speed2};
    }
    row->z += dt * row->vz;
    const scree_turn_row *turn = &rows->turn[i];
    double spin2 = turn->wx * turn->wx + turn->wy * turn->wy + turn->wz * turn->wz;
    return (scree_speeds){.spin = row->radius * row->radius * spin2, .centre = speed2 + row->vz * row->vz};
}

/// What the members of a thread pool share.
typedef struct scree_kick_task {
    scree_state *state;
    scree_kick_scale scale;
    bool drift;
    const uint32_t *moving; ///< rows; NULL: the first `count`
    size_t count;
    scree_speeds speeds[SCREE_THREAD_POOL_MOST]; ///< as of scree_drift
} scree_kick_task;

/// Dimension, drift and (NULL) form and moving are constants here, and what is added is a copy, so that rows do not
/// overlap it.
KICK_INLINE scree_speeds scree_kick_loop(int dimension, bool drift, const scree_form *form, const uint32_t *moving,
                                         const scree_kick_task *task, size_t begin, size_t end)
{
    const scree_state *state = task->state;
    const scree_kick_rows rows = {state->row,   state->turn,      state->sum, state->torque,
                                  state->angle, state->predicted, form};
    const scree_kick_scale scale = task->scale;
    const double dt = state->step_size;
    double spin = 0, centre = 0;
    for (size_t k = begin; k < end; k++) {
        const size_t i = moving ? moving[k] : k;
        scree_predicted added = scree_kick_velocity(dimension, &rows, i, &scale);
        if (!drift) continue;
        rows.sum[i] = (scree_sum_row){0};
        if (dimension == 3) rows.torque[i] = (scree_torque_row){0};
        if (rows.predicted) scree_kick_predict(dimension, &rows.predicted[i], added, scale.whole);
        scree_speeds moved = scree_drift(dimension, &rows, i, dt);
        centre = moved.centre > centre ? moved.centre : centre;
        spin = moved.spin > spin ? moved.spin : spin;
        // A speed that is not a number would be lost by the comparisons above.
        if (!(moved.centre + moved.spin < (double)INFINITY)) centre = (double)INFINITY;
    }
    return (scree_speeds){.spin = spin, .centre = centre};
}

KICK_INLINE scree_speeds scree_kick_of(int dimension, const scree_form *form, const uint32_t *moving,
                                       const scree_kick_task *task, size_t begin, size_t end)
{
    return task->drift ? scree_kick_loop(dimension, true, form, moving, task, begin, end)
                       : scree_kick_loop(dimension, false, form, moving, task, begin, end);
}

/// NULL is a constant in the loops of round bodies that are all awake.
static void scree_kick_share(void *argument, int index, int count)
{
    scree_kick_task *task = argument;
    const size_t begin = task->count * (size_t)index / (size_t)count;
    const size_t end = task->count * (size_t)(index + 1) / (size_t)count;
    const scree_form *form = task->state->form;
    const uint32_t *moving = task->moving;
    scree_speeds speeds;
    if (task->state->dimension == 3)
        speeds =
            moving ? scree_kick_of(3, NULL, moving, task, begin, end) : scree_kick_of(3, NULL, NULL, task, begin, end);
    else if (form)
        speeds =
            moving ? scree_kick_of(2, form, moving, task, begin, end) : scree_kick_of(2, form, NULL, task, begin, end);
    else
        speeds =
            moving ? scree_kick_of(2, NULL, moving, task, begin, end) : scree_kick_of(2, NULL, NULL, task, begin, end);
    if (task->drift) task->speeds[index] = speeds;
}

static inline scree_speeds scree_kick(const scree_model *model, scree_state *state, scree_work *work, double h,
                                      bool drift)
{
    const double *gravity = model->gravity;
    scree_kick_task task = {.state = state,
                            .scale = {.force = state->force_quantum * h,
                                      .torque = state->torque_quantum * h,
                                      .gravity = {gravity[0] * h, gravity[1] * h, gravity[2] * h},
                                      .whole = state->step_size / h},
                            .drift = drift};
    task.moving = scree_moving_rows(state, &task.count);
    int count = scree_work_shares(work);
    scree_thread_pool_run(&work->pool, count, scree_kick_share, &task);
    if (drift) {
        scree_sleep_clear_sums(state);
        work->clear_rows = scree_row_count(state, work);
    }
    double spin = 0, centre = 0;
    for (int k = 0; k < count; k++) {
        spin = fmax(spin, task.speeds[k].spin);
        centre = fmax(centre, task.speeds[k].centre);
    }
    return (scree_speeds){.centre = sqrt(centre), .spin = state->dimension == 2 ? spin : sqrt(spin)};
}

/// A kick and a drift, whose speeds are told.
static inline void scree_kick_and_drift(const scree_model *model, scree_state *state, scree_work *work, double h)
{
    const scree_speeds speeds = scree_kick(model, state, work, h, true);
    scree_moved_tell(state, work, &speeds);
}

#endif
