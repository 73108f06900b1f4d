/// The one loop that all schemes are made of: v += h a, optionally x += dt v and angle += dt spin. h: s.
/// Mass and inertia of a disc: m, m R^2 / 2. Cost: two divisions and about 30 flops a body; streams one row and one
/// sum.
#ifndef SCREE_INTEGRATE_KICK_H
#define SCREE_INTEGRATE_KICK_H

#include "base/fixed.h"
#include "integrate/integrate.h"

#include <math.h>
#include <omp.h>

/// Largest of |v| + R |w| (all) and of |v| (moving), over the bodies; NaN speeds count as infinite.
typedef struct scree_speeds {
    double surface, centre;
} scree_speeds;

static inline scree_speeds scree_kick(const scree_model *model, scree_state *state, double h, bool drift, int threads)
{
    const double dt = state->step_size;
    const double force_quantum = state->force_quantum * h, torque_quantum = state->torque_quantum * h;
    const double gx = model->gravity[0] * h, gy = model->gravity[1] * h;
    const double whole = dt / h; // the part of a kick before a drift, to all of it
    double surface = 0, centre = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : surface, centre) if (threads > 1)
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        const scree_sum_row *sum = &state->sum[i];
        double inverse_mass = 1.0 / row->mass;
        double vx = (double)sum->fx * force_quantum * inverse_mass + gx;
        double vy = (double)sum->fy * force_quantum * inverse_mass + gy;
        double spin = (double)sum->torque * torque_quantum * 2.0 * inverse_mass / (row->radius * row->radius);
        row->vx += vx;
        row->vy += vy;
        row->spin += spin;
        if (!drift) continue;
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
