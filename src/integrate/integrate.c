/// Table of schemes, and the velocities and forces that others ask for.
#include "integrate/schemes.h"

#include "base/fixed.h"

const scree_integrator *scree_integrator_get(scree_scheme scheme)
{
    static const scree_integrator *const table[] = {
        [SCREE_SCHEME_POSITION_VERLET] = &scree_position_verlet,
        [SCREE_SCHEME_VELOCITY_VERLET] = &scree_velocity_verlet,
        [SCREE_SCHEME_TWO_TIMESCALES] = &scree_two_timescales,
    };
    return table[scheme];
}

uint64_t scree_integrator_choose_step(const scree_integrator *integrator, const scree_model *model, scree_state *state,
                                      bool loading)
{
    uint64_t ticks = loading && integrator->ticks ? integrator->ticks(model, state) : model->largest_step;
    double next = (double)ticks * state->tick;
    state->kick_size = 0.5 * (state->step_size + next);
    state->step_size = next;
    return ticks;
}

void scree_body_force(const scree_model *model, const scree_state *state, size_t row, double force[3])
{
    const scree_sum_row *sum = &state->sum[row];
    double mass = state->row[row].mass;
    force[0] = scree_fixed_to(sum->fx, state->force_quantum) + mass * model->gravity[0];
    force[1] = scree_fixed_to(sum->fy, state->force_quantum) + mass * model->gravity[1];
    force[2] = scree_fixed_to(sum->torque, state->torque_quantum);
}

/// Stored velocity + shift * dt * acceleration.
static void shifted_velocity(const scree_model *model, const scree_state *state, size_t index, double shift,
                             double velocity[3])
{
    const scree_row *row = &state->row[index];
    double force[3];
    scree_body_force(model, state, index, force);
    double inertia = 0.5 * row->mass * row->radius * row->radius;
    velocity[0] = row->vx + shift * state->step_size * force[0] / row->mass;
    velocity[1] = row->vy + shift * state->step_size * force[1] / row->mass;
    velocity[2] = row->spin + shift * state->step_size * force[2] / inertia;
}

void scree_body_velocity(const scree_model *model, const scree_state *state, size_t row, double velocity[3])
{
    shifted_velocity(model, state, row, 0.5 - scree_integrator_get(model->scheme)->velocity_lead, velocity);
}

void scree_body_half_velocity(const scree_model *model, const scree_state *state, size_t row, double velocity[3])
{
    shifted_velocity(model, state, row, -scree_integrator_get(model->scheme)->velocity_lead, velocity);
}
