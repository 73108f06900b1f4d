/// Rigid plates.
///
/// Servo. A plate under servo has the mass M of one layer of grains and a dashpot with the sample's own wave impedance
/// Z:
///     M dv/dt = p L t - F - Z v.
/// A wave that reaches it is absorbed instead of reflected, so it cannot ring whatever the stiffness of the sample; the
/// mass keeps the contact dampers (whose sum exceeds Z) out of the feedback within one step. The dashpot is taken
/// implicitly. Z = L sqrt(k m / A), m / A the mass of the assembly per area, and k = M t its longitudinal stiffness,
/// estimated by the Hertz stiffness at the mean contact force f = p 2R t: k = 1.5 K^(2/3) f^(1/3) (a triangular net of
/// springs k has 1.3 k, a loose one about half of it; the gain of the case scales the estimate). Limits: quasistatic
/// servo; the stress is the one of the last force evaluation. Cost: O(boundary) a step.
#include "boundary/plates.h"

#include "measure/measure.h"
#include "measure/outline.h"
#include "state/cell.h"

#include <math.h>

void scree_plates_move(scree_state *state)
{
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        if (state->wall[w].active) state->wall[w].position += state->wall[w].velocity * state->step_size;
}

/// Distance between a pair of opposite walls.
static double distance(const scree_state *state, int one, int other)
{
    // Opposite normals: positions along them add up to minus the distance.
    return -(state->wall[one].position + state->wall[other].position);
}

double scree_plate_length(const scree_state *state, int index)
{
    bool horizontal = index == SCREE_WALL_BOTTOM || index == SCREE_WALL_TOP;
    double height = distance(state, SCREE_WALL_BOTTOM, SCREE_WALL_TOP);
    if (!horizontal) return height;
    if (scree_cell_repeats(&state->cell, 0)) return state->cell.lattice[0];
    if (state->wall[SCREE_WALL_LEFT].active && state->wall[SCREE_WALL_RIGHT].active)
        return distance(state, SCREE_WALL_LEFT, SCREE_WALL_RIGHT);
    return state->loop.count > 0 ? scree_outline_plate_length(state, index) : scree_sample_area(state) / height;
}

double scree_plate_stress(const scree_model *model, const scree_state *state, int index)
{
    return state->wall[index].force / (scree_plate_length(state, index) * model->thickness);
}

static double sample_mass(const scree_state *state)
{
    double mass = 0;
    for (size_t id = 0; id < state->grains; id++) mass += state->row[state->row_of_id[id]].mass;
    return mass;
}

scree_servo scree_servo_for(const scree_model *model, const scree_state *state, int index, double pressure)
{
    double length = scree_plate_length(state, index), area = scree_sample_area(state), mass = sample_mass(state);
    double contact_force = pressure * 2 * model->mean_radius * model->thickness;
    double k = model->pairs[0][0].normal_stiffness * sqrt(0.5 * model->mean_radius);
    double stiffness = 1.5 * cbrt(k * k * contact_force);
    return (scree_servo){.impedance = length * sqrt(stiffness * mass / area) / model->config->boundary.servo_gain,
                         .mass = mass / area * length * 2 * model->mean_radius};
}

double scree_sample_wave_time(const scree_model *model, const scree_state *state, double pressure)
{
    double height = distance(state, SCREE_WALL_BOTTOM, SCREE_WALL_TOP);
    double length = scree_plate_length(state, SCREE_WALL_TOP);
    double impedance =
        scree_servo_for(model, state, SCREE_WALL_TOP, pressure).impedance * model->config->boundary.servo_gain;
    return sample_mass(state) / impedance * (height > length ? 1 : length / height);
}

void scree_plate_servo(const scree_model *model, scree_state *state, int index, scree_servo servo, double pressure)
{
    scree_wall *wall = &state->wall[index];
    double target = pressure * scree_plate_length(state, index) * model->thickness, dt = state->step_size;
    double velocity =
        (wall->velocity + dt / servo.mass * (target - wall->force)) / (1 + dt / servo.mass * servo.impedance);
    double limit = model->config->boundary.servo_velocity;
    // Auto: a plate may not cross a hundredth of the smallest radius in a step.
    if (isnan(limit)) limit = 0.01 * model->radius_min / dt;
    wall->velocity = fmax(-limit, fmin(limit, velocity));
}
