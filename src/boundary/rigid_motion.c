/// What a sample has of a rigid motion when nothing holds it any more.
///
/// A sample between plates leans to and fro a little when it is confined. The instant that its plates go it has some
/// momentum P and angular momentum L about its centre of mass X,
///     P = sum m v,    L = sum m (x - X) x (v - P/M) + J w.
/// A pressure on a closed boundary and a symmetric stress on it (minimal.c) have no resultant and no moment, and
/// neither have contacts: both stay for ever. The sample turns through the whole test at omega = I^-1 L, I its tensor
/// of inertia, under an axis that stands still, however small its strain rate is: 150 polygons confined between smooth
/// plates until they counted as at rest turned by 61 degrees in 4 s (docs/theory.md). So the plates take this motion
/// with them:
///     v -> v - P/M - omega x (x - X),    w -> w - omega.
/// No contact that sticks is strained by it, and no slip changes but that along plates that are gone.
/// Energy: the difference of the discrete kinetic energies (measure/energy.c), with the same forces before and after.
/// Sums are in integers: the same bits for any number of threads and processes. Cost: O(bodies), once a stage.
#include "boundary/rigid_motion.h"

#include "base/integer_sum.h"
#include "base/matrix.h"
#include "comm/comm.h"
#include "integrate/integrate.h"
#include "state/body.h"

#include <string.h>

/// Mass, centre of mass and its velocity.
static double find_centre(const scree_state *state, scree_vector centre, scree_vector velocity)
{
    enum { MASS = 6 };
    scree_integer_sum sum[7] = {0};
    scree_vector position, motion, spin;
    while (scree_comm_sum_next(state, sum, 7))
        for (size_t row = 0; row < state->count; row++) {
            const double mass = scree_body_mass(state, row);
            scree_body_position(state, row, position);
            scree_body_motion(state, row, motion, spin);
            scree_integer_sum_add(&sum[MASS], mass);
            for (int i = 0; i < 3; i++) {
                scree_integer_sum_add(&sum[i], mass * position[i]);
                scree_integer_sum_add(&sum[3 + i], mass * motion[i]);
            }
        }
    const double mass = scree_integer_sum_total(&sum[MASS]);
    for (int i = 0; i < 3; i++) {
        centre[i] = mass > 0 ? scree_integer_sum_total(&sum[i]) / mass : 0;
        velocity[i] = mass > 0 ? scree_integer_sum_total(&sum[3 + i]) / mass : 0;
    }
    return mass;
}

/// Adds L, and the upper half of I, of one body. In 2D about z alone.
static void add_turning(const scree_state *state, size_t row, const scree_vector centre, const scree_vector velocity,
                        scree_integer_sum angular[3], scree_integer_sum inertia[9])
{
    const double mass = scree_body_mass(state, row), own = scree_body_inertia(state, row);
    scree_vector arm, motion, spin, moment;
    scree_body_position(state, row, arm);
    scree_body_motion(state, row, motion, spin);
    scree_subtract(arm, centre, arm);
    scree_subtract(motion, velocity, motion);
    scree_cross(arm, motion, moment);
    for (int i = 0; i < 3; i++) {
        scree_integer_sum_add(&angular[i], mass * moment[i] + own * spin[i]);
        scree_integer_sum_add(&inertia[4 * i], mass * (scree_dot(arm, arm) - arm[i] * arm[i]) + own);
        for (int j = i + 1; j < 3; j++) scree_integer_sum_add(&inertia[3 * i + j], -mass * arm[i] * arm[j]);
    }
}

void scree_rigid_motion_measure(const scree_state *state, scree_vector centre, scree_vector velocity, scree_vector spin)
{
    scree_integer_sum sum[12] = {0};
    double angular[3], inertia[9], inverse[9];
    memset(spin, 0, sizeof(scree_vector));
    if (!(find_centre(state, centre, velocity) > 0)) return;
    while (scree_comm_sum_next(state, sum, 12))
        for (size_t row = 0; row < state->count; row++) add_turning(state, row, centre, velocity, sum, sum + 3);
    for (int i = 0; i < 3; i++) angular[i] = scree_integer_sum_total(&sum[i]);
    for (int c = 0; c < 9; c++) {
        const int upper = c / 3 <= c % 3 ? c : 3 * (c % 3) + c / 3;
        inertia[c] = scree_integer_sum_total(&sum[3 + upper]);
    }
    if (state->dimension == 2) {
        spin[2] = inertia[8] > 0 ? angular[2] / inertia[8] : 0;
        return;
    }
    if (!(scree_matrix_determinant(inertia) > 0)) return;
    scree_matrix_invert(inertia, inverse);
    scree_matrix_apply(inverse, angular, spin);
}

static double kinetic_energy(const scree_model *model, const scree_state *state)
{
    scree_integer_sum energy = {0};
    double translation, rotation;
    while (scree_comm_sum_next(state, &energy, 1))
        for (size_t row = 0; row < state->count; row++) {
            scree_body_kinetic(model, state, row, &translation, &rotation);
            scree_integer_sum_add(&energy, translation + rotation);
        }
    return scree_integer_sum_total(&energy);
}

static bool any_is_held(const scree_state *state)
{
    scree_integer_sum held = {0};
    while (scree_comm_sum_next(state, &held, 1))
        for (size_t row = 0; row < state->count; row++)
            scree_integer_sum_add(&held, scree_body_held(state, row) ? 1 : 0);
    return scree_integer_sum_total(&held) > 0;
}

static void take_motion(scree_state *state, size_t row, const scree_vector centre, const scree_vector velocity,
                        const scree_vector spin)
{
    scree_row *body = &state->row[row];
    scree_vector arm, turning;
    scree_body_position(state, row, arm);
    scree_subtract(arm, centre, arm);
    scree_cross(spin, arm, turning);
    body->vx -= velocity[0] + turning[0];
    body->vy -= velocity[1] + turning[1];
    if (state->dimension == 2) {
        body->spin -= spin[2];
        return;
    }
    body->vz -= velocity[2] + turning[2];
    state->turn[row].wx -= spin[0];
    state->turn[row].wy -= spin[1];
    state->turn[row].wz -= spin[2];
}

double scree_rigid_motion_stop(const scree_model *model, scree_state *state)
{
    scree_vector centre, velocity, spin;
    if (any_is_held(state)) return 0;
    scree_rigid_motion_measure(state, centre, velocity, spin);
    const double before = kinetic_energy(model, state);
    for (size_t row = 0; row < state->count; row++) take_motion(state, row, centre, velocity, spin);
    return before - kinetic_energy(model, state);
}
