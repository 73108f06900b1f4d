/// Rigid plates.
///
/// Servo. A plate under servo has the mass M of one layer of grains and a dashpot with the sample's own wave impedance
/// Z:
///     M dv/dt = p L t - F - Z v.
/// A wave that reaches it is absorbed instead of reflected, so it cannot ring whatever the stiffness of the sample; the
/// mass keeps the contact dampers (whose sum exceeds Z) out of the feedback within one step. The dashpot is taken
/// implicitly. Z = S sqrt(M m / V), S the area of the plate, m / V the mass of the assembly per volume, and M its
/// longitudinal stiffness, estimated by the Hertz stiffness of a contact at the mean contact force f = p 2R t (in 3D
/// p (2R)^2): k = 1.5 K^(2/3) f^(1/3), M = k / t (k / 2R). (A triangular net of springs k has 1.3 k, a loose one about
/// half of it; the gain of the case scales the estimate.) Limits: quasistatic servo; the stress is the one of the last
/// force evaluation. Cost: O(boundary) a step.
#include "boundary/plates.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "measure/hull.h"
#include "measure/measure.h"
#include "measure/outline.h"
#include "state/periodic.h"

#include <math.h>

/// Distance between a pair of opposite walls.
static double distance(const scree_state *state, int one, int other)
{
    // Opposite normals: positions along them add up to minus the distance.
    return -(scree_plates(state)[one].position + scree_plates(state)[other].position);
}

/// Area of the bottom or top plate that the boundary of the sample covers; 0 without a boundary.
static double covered_area(const scree_model *model, const scree_state *state, int index)
{
    if (state->dimension == 3) return scree_hull_of(state)->node_count > 0 ? scree_hull_plate_area(state, index) : 0;
    return scree_loop_of(state)->count > 0 ? model->thickness * scree_outline_plate_length(state, index) : 0;
}

double scree_plate_area(const scree_model *model, const scree_state *state, int index)
{
    double height = distance(state, SCREE_WALL_BOTTOM, SCREE_WALL_TOP);
    double width = distance(state, SCREE_WALL_LEFT, SCREE_WALL_RIGHT);
    double depth = state->dimension == 3 ? distance(state, SCREE_WALL_FRONT, SCREE_WALL_BACK) : model->thickness;
    if (index == SCREE_WALL_LEFT || index == SCREE_WALL_RIGHT) return height * depth;
    if (index == SCREE_WALL_FRONT || index == SCREE_WALL_BACK) return height * width;
    if (scree_cell(state)->directions) return scree_sample_volume(model, state) / height;
    if (scree_plates(state)[SCREE_WALL_LEFT].active && scree_plates(state)[SCREE_WALL_RIGHT].active)
        return width * depth;
    double area = covered_area(model, state, index);
    return area > 0 ? area : scree_sample_volume(model, state) / height;
}

double scree_plate_stress(const scree_model *model, const scree_state *state, int index)
{
    return scree_plates(state)[index].force / scree_plate_area(model, state, index);
}

static double sample_mass(const scree_state *state)
{
    scree_integer_sum mass = {0};
    while (scree_comm_sum_next(state, &mass, 1))
        for (size_t row = 0; row < state->count; row++)
            if (scree_body_is_grain(state, row)) scree_integer_sum_add(&mass, state->row[row].mass);
    return scree_integer_sum_total(&mass);
}

double scree_confined_modulus(const scree_model *model, double pressure)
{
    double diameter = 2 * model->mean_radius, depth = model->dimension == 3 ? diameter : model->thickness;
    return scree_model_stiffness(model, pressure, diameter, depth) / depth;
}

scree_servo scree_servo_for(const scree_model *model, const scree_state *state, int index, double pressure)
{
    double area = scree_plate_area(model, state, index),
           density = sample_mass(state) / scree_sample_volume(model, state);
    double diameter = 2 * model->mean_radius, stiffness = scree_confined_modulus(model, pressure);
    return (scree_servo){.impedance = area * sqrt(stiffness * density) / model->servo.gain,
                         .mass = density * area * diameter};
}

double scree_sample_wave_time(const scree_model *model, const scree_state *state, double pressure)
{
    double height = distance(state, SCREE_WALL_BOTTOM, SCREE_WALL_TOP);
    double area = scree_plate_area(model, state, SCREE_WALL_TOP);
    double length = state->dimension == 3 ? sqrt(area) : area / model->thickness;
    double impedance = scree_servo_for(model, state, SCREE_WALL_TOP, pressure).impedance * model->servo.gain;
    return sample_mass(state) / impedance * (height > length ? 1 : length / height);
}

void scree_plate_servo(const scree_model *model, scree_state *state, int index, scree_servo servo, double pressure)
{
    scree_wall *wall = &scree_plates(state)[index];
    double target = pressure * scree_plate_area(model, state, index), kick = state->kick_size;
    double velocity =
        (wall->velocity + kick / servo.mass * (target - wall->force)) / (1 + kick / servo.mass * servo.impedance);
    double limit = fmin(model->servo.velocity, model->servo.travel / state->step_size);
    wall->velocity = fmax(-limit, fmin(limit, velocity));
}
