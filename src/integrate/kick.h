/// The one loop that both schemes are made of: v += h dt a, optionally x += dt v and, in 2D, angle += dt spin.
/// Mass and inertia: m, m R^2 / 2 of a disc, 2 m R^2 / 5 of a sphere. Cost: two divisions and about 30 flops a body (50
/// in 3D); streams one row and one sum, in 3D a row of spins and one of torques more.
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

/// What one step adds: h times the quanta and gravity.
typedef struct scree_kick_scale {
    double force, torque;
    double gravity[3];
} scree_kick_scale;

#define KICK_INLINE static inline __attribute__((always_inline))

KICK_INLINE void scree_kick_velocity(int dimension, scree_state *state, size_t i, const scree_kick_scale *scale)
{
    scree_row *row = &state->row[i];
    const scree_sum_row *sum = &state->sum[i];
    double inverse_mass = 1.0 / row->mass;
    row->vx += (double)sum->fx * scale->force * inverse_mass + scale->gravity[0];
    row->vy += (double)sum->fy * scale->force * inverse_mass + scale->gravity[1];
    if (dimension == 2) {
        row->spin += (double)sum->torque * scale->torque * 2.0 * inverse_mass / (row->radius * row->radius);
        return;
    }
    scree_turn_row *turn = &state->turn[i];
    const scree_torque_row *torque = &state->torque[i];
    double inverse_inertia = scale->torque * 2.5 * inverse_mass / (row->radius * row->radius);
    row->vz += (double)sum->fz * scale->force * inverse_mass + scale->gravity[2];
    turn->wx += (double)torque->x * inverse_inertia;
    turn->wy += (double)torque->y * inverse_inertia;
    turn->wz += (double)torque->z * inverse_inertia;
}

/// Moves a body; returns |v|^2, and R |w| in 2D, its square in 3D.
KICK_INLINE scree_speeds scree_drift(int dimension, scree_state *state, size_t i, double dt)
{
    scree_row *row = &state->row[i];
    row->x += dt * row->vx;
    row->y += dt * row->vy;
    double speed2 = row->vx * row->vx + row->vy * row->vy;
    if (dimension == 2) {
        state->angle[i] += dt * row->spin;
        return (scree_speeds){.surface = row->radius * fabs(row->spin), .centre = speed2};
    }
    row->z += dt * row->vz;
    const scree_turn_row *turn = &state->turn[i];
    double spin2 = turn->wx * turn->wx + turn->wy * turn->wy + turn->wz * turn->wz;
    return (scree_speeds){.surface = row->radius * row->radius * spin2, .centre = speed2 + row->vz * row->vz};
}

KICK_INLINE scree_speeds scree_kick_loop(int dimension, scree_state *state, const scree_kick_scale *scale, bool drift,
                                         int threads)
{
    const double dt = state->step_size;
    double surface = 0, centre = 0;
#pragma omp parallel for num_threads(threads) schedule(static) reduction(max : surface, centre) if (threads > 1)
    for (size_t i = 0; i < state->count; i++) {
        scree_kick_velocity(dimension, state, i, scale);
        if (!drift) continue;
        scree_speeds moved = scree_drift(dimension, state, i, dt);
        centre = moved.centre > centre ? moved.centre : centre;
        surface = moved.surface > surface ? moved.surface : surface;
        // A speed that is not a number would be lost by the comparisons above.
        if (!(moved.centre + moved.surface < (double)INFINITY)) centre = (double)INFINITY;
    }
    centre = sqrt(centre);
    return (scree_speeds){.surface = centre + (dimension == 2 ? surface : sqrt(surface)), .centre = centre};
}

static inline scree_speeds scree_kick(const scree_model *model, scree_state *state, double kick, bool drift,
                                      int threads)
{
    const double h = kick * state->step_size, *gravity = model->gravity;
    const scree_kick_scale scale = {
        state->force_quantum * h, state->torque_quantum * h, {gravity[0] * h, gravity[1] * h, gravity[2] * h}};
    return state->dimension == 3 ? scree_kick_loop(3, state, &scale, drift, threads)
                                 : scree_kick_loop(2, state, &scale, drift, threads);
}

/// Books the speeds of a drift: bound for the quanta, budget of the neighbour list, NaN flag.
static inline void scree_kick_book(scree_state *state, scree_work *work, scree_speeds speeds)
{
    state->largest_speed = speeds.surface;
    work->budget -= state->step_size * speeds.centre;
    if (!isfinite(speeds.surface)) work->flags |= SCREE_FLAG_NAN;
}

#endif
