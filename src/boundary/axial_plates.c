/// Boundaries with a bottom and a top plate: under pressure the bottom plate stands, the top plate and the sides are
/// under servo (with two plates under servo the sample would drift: the pressure on sloping sides has a vertical
/// resultant that only a standing plate can bear); in compression the two approach each other.
///
/// A sample whose friction depends on velocity creeps on, and its plate with it: so the tolerance of 5 % of the stress.
#include "boundary/axial_plates.h"

#include "boundary/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

double scree_axial_wave_time(const scree_context *c, double pressure)
{
    return scree_sample_wave_time(c->model, c->state, pressure);
}

double scree_axial_height(const scree_context *c)
{
    const scree_wall *wall = scree_plates(c->state);
    return -(wall[SCREE_WALL_BOTTOM].position + wall[SCREE_WALL_TOP].position);
}

void scree_axial_fit(const scree_context *c, double pressure)
{
    scree_plate_set *plates = scree_plate_set_of(c->state);
    plates->axial = scree_servo_for(c->model, c->state, SCREE_WALL_TOP, pressure);
    plates->sides = scree_servo_for(c->model, c->state, SCREE_WALL_LEFT, pressure);
}

void scree_axial_rest(const scree_context *c)
{
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        scree_wall *wall = &scree_plates(c->state)[w];
        wall->velocity = 0;
        memset(wall->tangential_velocity, 0, sizeof wall->tangential_velocity);
    }
}

static void press_sides(const scree_context *c, double pressure)
{
    const scree_plate_set *plates = scree_plate_set_of(c->state);
    for (int w = SCREE_WALL_LEFT; w < SCREE_WALL_COUNT; w++)
        if (plates->wall[w].active) scree_plate_servo(c->model, c->state, w, plates->sides, pressure);
}

void scree_axial_hold(const scree_context *c, double pressure)
{
    scree_plate_set *plates = scree_plate_set_of(c->state);
    plates->wall[SCREE_WALL_BOTTOM].velocity = 0;
    scree_plate_servo(c->model, c->state, SCREE_WALL_TOP, plates->axial, pressure);
    press_sides(c, pressure);
}

void scree_axial_compress(const scree_context *c, const scree_compression *compression)
{
    scree_wall *wall = scree_plates(c->state);
    double rate = compression->rate * compression->rise, velocity = 0.5 * rate * compression->height;
    wall[SCREE_WALL_BOTTOM].velocity = wall[SCREE_WALL_TOP].velocity = velocity;
    press_sides(c, scree_pressure_now(c->state));
}

double scree_axial_stress_error(const scree_context *c, double pressure, const char **what)
{
    *what = "the stress of the top plate";
    return fabs(scree_plate_stress(c->model, c->state, SCREE_WALL_TOP) / pressure - 1);
}
