/// The choice of the next step, and the velocities and forces that others ask for.
#include "integrate/integrate.h"

#include "base/fixed.h"
#include "state/sleep.h"

static uint64_t next_ticks(const scree_integrator *integrator, const scree_model *model, const scree_state *state,
                           bool loading)
{
    return loading && integrator->ticks ? integrator->ticks(model, state) : model->largest_step;
}

double scree_integrator_next_kick(const scree_integrator *integrator, const scree_model *model,
                                  const scree_state *state, bool loading)
{
    return 0.5 * (state->step_size + (double)next_ticks(integrator, model, state, loading) * state->tick);
}

uint64_t scree_integrator_choose_step(const scree_integrator *integrator, const scree_model *model, scree_state *state,
                                      bool loading)
{
    uint64_t ticks = next_ticks(integrator, model, state, loading);
    state->kick_size = scree_integrator_next_kick(integrator, model, state, loading);
    state->step_size = (double)ticks * state->tick;
    return ticks;
}

/// What others that sleep exert on a body that does.
static void add_resting(const scree_state *state, size_t row, scree_vector force, scree_vector torque)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    for (int k = 0; k < 3; k++) {
        force[k] += (double)sleep->resting[row].force[k] * sleep->force_unit;
        torque[k] += (double)sleep->resting[row].torque[k] * sleep->torque_unit;
    }
}

void scree_body_force(const scree_model *model, const scree_state *state, size_t row, scree_vector force,
                      scree_vector torque)
{
    const scree_sum_row *sum = &state->sum[row];
    const scree_torque_row *turning = state->dimension == 3 ? &state->torque[row] : NULL;
    double mass = state->row[row].mass;
    force[0] = scree_fixed_to(sum->fx, state->force_quantum) + mass * model->gravity[0];
    force[1] = scree_fixed_to(sum->fy, state->force_quantum) + mass * model->gravity[1];
    force[2] = turning ? scree_fixed_to(sum->fz, state->force_quantum) + mass * model->gravity[2] : 0;
    torque[0] = turning ? scree_fixed_to(turning->x, state->torque_quantum) : 0;
    torque[1] = turning ? scree_fixed_to(turning->y, state->torque_quantum) : 0;
    torque[2] = scree_fixed_to(turning ? turning->z : sum->torque, state->torque_quantum);
    if (scree_body_sleeps(state, row)) add_resting(state, row, force, torque);
}

/// Stored velocity + shift * dt * acceleration.
static void shifted_velocity(const scree_model *model, const scree_state *state, size_t row, double shift,
                             scree_vector velocity, scree_vector spin)
{
    scree_vector force, torque;
    scree_body_motion(state, row, velocity, spin);
    if (scree_body_sleeps(state, row)) return; // nothing moves it, whatever acts on it
    scree_body_force(model, state, row, force, torque);
    double mass = state->row[row].mass, inertia = scree_body_inertia(state, row);
    for (int k = 0; k < 3; k++) {
        velocity[k] += shift * state->step_size * force[k] / mass;
        spin[k] += shift * state->step_size * torque[k] / inertia;
    }
}

void scree_body_velocity(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                         scree_vector spin)
{
    const scree_integrator *integrator = scree_integrator_get(model->scheme);
    if (integrator->velocity && !scree_body_sleeps(state, row)) {
        integrator->velocity(model, state, row, velocity, spin);
        return;
    }
    double shift = 0.5 - integrator->velocity_lead;
    shifted_velocity(model, state, row, shift, velocity, spin);
}

void scree_body_velocity_so_far(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                                scree_vector spin)
{
    if (!state->lead || scree_body_sleeps(state, row)) {
        scree_body_velocity(model, state, row, velocity, spin);
        return;
    }
    const scree_predicted *lead = &state->lead[row];
    const bool in_3d = state->dimension == 3;
    scree_body_motion(state, row, velocity, spin);
    velocity[0] += lead->vx;
    velocity[1] += lead->vy;
    velocity[2] += in_3d ? lead->vz : 0;
    spin[0] += lead->wx;
    spin[1] += lead->wy;
    spin[2] += in_3d ? lead->wz : lead->spin;
}

void scree_body_half_velocity(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                              scree_vector spin)
{
    shifted_velocity(model, state, row, -scree_integrator_get(model->scheme)->velocity_lead, velocity, spin);
}

void scree_body_kinetic(const scree_model *model, const scree_state *state, size_t row, double *translation,
                        double *rotation)
{
    const double mass = state->row[row].mass, inertia = scree_body_inertia(state, row), dt = state->step_size;
    scree_vector velocity, spin, force, torque;
    *translation = *rotation = 0;
    if (scree_integrator_get(model->scheme)->velocity) {
        scree_body_velocity(model, state, row, velocity, spin);
        *translation = 0.5 * scree_body_mass(state, row) * scree_dot(velocity, velocity);
        *rotation = 0.5 * inertia * scree_dot(spin, spin);
        return;
    }
    scree_body_half_velocity(model, state, row, velocity, spin);
    scree_body_force(model, state, row, force, torque);
    for (int k = 0; k < 3; k++) {
        *translation += 0.5 * mass * velocity[k] * (velocity[k] + dt * force[k] / mass);
        *rotation += 0.5 * inertia * spin[k] * (spin[k] + dt * torque[k] / inertia);
    }
}
