/// A wall that presses on the bodies with a force, as the plates do (boundary/plates.c). It has the mass M of a layer
/// of grains as wide as its area A and a dashpot with the impedance Z of the grains behind it,
///     M dv/dt = F*(t) - F - Z v,     M = rho phi A d,     Z = A sqrt(m rho phi) / gain,
/// d the mean diameter, m the confined modulus that Hertz's contacts have at the pressure max F* / A, phi the expected
/// solid fraction. A wave that reaches it is absorbed, so it does not ring; the dashpot is taken implicitly. Where A is
/// less than a grain the mass is that of the largest grain, so that one contact cannot shake it. Limits: one direction;
/// F is that of the last evaluation. Its weight is nothing: F* is all that presses.
#include "state/wall_servo.h"

#include "case/wall_motion.h"
#include "model/critical_step.h"

#include <math.h>

#define CREEP 0.01 /* of the smallest radius in a step, where no limit of its velocity is given */

double scree_wall_servo_area(const scree_model *model, const scree_config_wall *wall)
{
    if (!isnan(wall->area)) return wall->area;
    return model->dimension == 3 ? wall->face : wall->face * model->thickness;
}

double scree_wall_servo_speed(const scree_model *model, const scree_state *state, const scree_config_wall *wall,
                              double speed, double force, double time)
{
    double diameter = 2 * model->mean_radius, depth = model->dimension == 3 ? diameter : model->thickness;
    double area = scree_wall_servo_area(model, wall), pressure = scree_schedule_largest(&wall->force) / area;
    double density = scree_model_mean_density(model) * scree_expected_solid_fraction(model);
    double modulus = scree_model_stiffness(model, pressure, diameter, depth) / depth, heaviest = 0;
    for (int k = 0; k < model->material_count; k++)
        heaviest = fmax(heaviest, scree_model_mass(model, k, scree_model_largest_radius(model)));
    double mass = fmax(density * area * diameter, heaviest);
    double impedance = area * sqrt(modulus * density) / wall->servo_gain, kick = state->kick_size / mass;
    double target = scree_schedule_at(&wall->force, time);
    double limit = isnan(wall->servo_velocity) ? CREEP * model->radius_min / state->step_size : wall->servo_velocity;
    double next = (speed + kick * (target - force)) / (1 + kick * impedance);
    return fmax(-limit, fmin(limit, next));
}
