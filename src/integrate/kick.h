/// The one loop that all schemes are made of: v += h a, optionally x += dt v and angle += dt spin. h: s.
/// Mass and inertia of a disc: m, m R^2 / 2. Cost: two divisions and about 30 flops a body; streams one row and one
/// sum.
#ifndef SCREE_INTEGRATE_KICK_H
#define SCREE_INTEGRATE_KICK_H

#include "base/fixed.h"
#include "integrate/integrate.h"

#include <math.h>

/// Largest of |v| + R |w| (all) and of |v| (moving), over the bodies; NaN speeds count as infinite.
typedef struct scree_speeds {
    double surface, centre;
} scree_speeds;

/// What the members of a team share.
typedef struct scree_kick_task {
    const scree_model *model;
    scree_state *state;
    double h;
    bool drift;
    scree_speeds speeds[SCREE_TEAM_MOST]; ///< squares of centre speeds
} scree_kick_task;

static void scree_kick_share(void *argument, int index, int count)
{
    scree_kick_task *task = argument;
    const scree_model *model = task->model;
    scree_state *state = task->state;
    const double dt = state->step_size, h = task->h;
    const double force_quantum = state->force_quantum * h, torque_quantum = state->torque_quantum * h;
    const double gx = model->gravity[0] * h, gy = model->gravity[1] * h;
    const double whole = dt / h; // the part of a kick before a drift, to all of it
    const size_t end = state->count * (size_t)(index + 1) / (size_t)count;
    double surface = 0, centre = 0;
    for (size_t i = state->count * (size_t)index / (size_t)count; i < end; i++) {
        scree_row *row = &state->row[i];
        const scree_sum_row *sum = &state->sum[i];
        // One division for mass and inertia.
        double square = row->radius * row->radius, inverse = 1.0 / (row->mass * square),
               inverse_mass = inverse * square;
        double vx = (double)sum->fx * force_quantum * inverse_mass + gx;
        double vy = (double)sum->fy * force_quantum * inverse_mass + gy;
        double spin = (double)sum->torque * (torque_quantum * 2.0) * inverse;
        row->vx += vx;
        row->vy += vy;
        row->spin += spin;
        if (!task->drift) continue;
        if (state->foreseen)
            state->foreseen[i] = (scree_foreseen){vx * whole, vy * whole, spin * whole, (double)sum->contacts};
        row->x += dt * row->vx;
        row->y += dt * row->vy;
        state->angle[i] += dt * row->spin;
        double speed2 = row->vx * row->vx + row->vy * row->vy;
        double turning = row->radius * fabs(row->spin);
        centre = speed2 > centre ? speed2 : centre;
        surface = turning > surface ? turning : surface;
        // A speed that is not a number would be lost by the comparisons above.
        if (!(speed2 + turning < (double)INFINITY)) centre = (double)INFINITY;
    }
    task->speeds[index] = (scree_speeds){.surface = surface, .centre = centre};
}

static inline scree_speeds scree_kick(const scree_model *model, scree_state *state, scree_work *work, double h,
                                      bool drift)
{
    scree_kick_task task = {.model = model, .state = state, .h = h, .drift = drift};
    int count = scree_work_shares(work);
    scree_team_run(&work->team, count, scree_kick_share, &task);
    double surface = 0, centre = 0;
    for (int k = 0; k < count; k++) {
        surface = fmax(surface, task.speeds[k].surface);
        centre = fmax(centre, task.speeds[k].centre);
    }
    centre = sqrt(centre);
    return (scree_speeds){.surface = centre + surface, .centre = centre};
}

/// Books the speeds of a drift: bound for the quanta, budget of the neighbour list, NaN flag.
static inline void scree_kick_book(scree_state *state, scree_work *work, scree_speeds speeds)
{
    state->largest_speed = speeds.surface;
    work->budget -= state->step_size * speeds.centre;
    if (!isfinite(speeds.surface)) work->flags |= SCREE_FLAG_NAN;
}

#endif
