/// Motions of walls: see wall_motion.h. With the time t of the walls, from the pose that the case gives at t = 0:
///     velocity      s(t) = integral of v from 0 to t       v constant or a table
///     displacement  s(t) as a table gives it
///     vibration     s(t) = a sin(2 pi f t + phase)
///     servo         s(t) = e d(t), d the travel along the unit direction e
#include "case/wall_motion.h"

#include "base/vectors.h"

#include <string.h>

#define FASTEST 1000.0 /* m/s, as the limits of keys */

static const char *const no_z = "there is no z in two dimensions";

static bool has_z(const scree_schedule vector[3])
{
    return scree_schedule_largest(&vector[2]) > 0;
}

// ---- velocity, displacement --------------------------------------------------------------------------------------

static void velocity_shift(const scree_config_wall *wall, double travel, double time, double shift[3])
{
    (void)travel;
    for (int k = 0; k < 3; k++) shift[k] = scree_schedule_integral(&wall->velocity[k], time);
}

static void velocity_largest(const scree_config_wall *wall, double largest[3])
{
    for (int k = 0; k < 3; k++) largest[k] = scree_schedule_largest(&wall->velocity[k]);
}

static const char *velocity_wrong(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "velocity";
    return dimension == 2 && has_z(wall->velocity) ? no_z : NULL;
}

static void displacement_shift(const scree_config_wall *wall, double travel, double time, double shift[3])
{
    (void)travel;
    for (int k = 0; k < 3; k++) shift[k] = scree_schedule_at(&wall->displacement[k], time);
}

static void displacement_largest(const scree_config_wall *wall, double largest[3])
{
    for (int k = 0; k < 3; k++) largest[k] = scree_schedule_largest_rate(&wall->displacement[k]);
}

static const char *displacement_wrong(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "displacement";
    if (dimension == 2 && has_z(wall->displacement)) return no_z;
    return scree_wall_largest_speed(wall) > FASTEST ? "the table would move the wall faster than 1000 m/s" : NULL;
}

// ---- vibration ---------------------------------------------------------------------------------------------------

static double vibration_rate(const scree_config_wall *wall)
{
    return 2 * M_PI * wall->frequency;
}

static void vibration_shift(const scree_config_wall *wall, double travel, double time, double shift[3])
{
    double phase = sin(vibration_rate(wall) * time + wall->phase);
    (void)travel;
    for (int k = 0; k < 3; k++) shift[k] = wall->amplitude[k] * phase;
}

static void vibration_largest(const scree_config_wall *wall, double largest[3])
{
    for (int k = 0; k < 3; k++) largest[k] = fabs(wall->amplitude[k]) * vibration_rate(wall);
}

static const char *vibration_wrong(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "amplitude";
    if (dimension == 2 && wall->amplitude[2] != 0) return no_z;
    if (!(scree_length(wall->amplitude) > 0)) return "a vibration needs an amplitude";
    return scree_wall_largest_speed(wall) > FASTEST ? "the wall would move faster than 1000 m/s" : NULL;
}

// ---- servo -------------------------------------------------------------------------------------------------------

static void servo_shift(const scree_config_wall *wall, double travel, double time, double shift[3])
{
    double direction[3] = {wall->direction[0], wall->direction[1], wall->direction[2]};
    (void)time;
    (void)scree_normalise(direction);
    for (int k = 0; k < 3; k++) shift[k] = travel * direction[k];
}

static const char *servo_wrong(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "direction";
    if (dimension == 2 && wall->direction[2] != 0) return no_z;
    if (!(scree_length(wall->direction) > 0)) return "a servo needs a direction, in which it presses";
    return NULL;
}

// ---- all ---------------------------------------------------------------------------------------------------------

const scree_wall_motion scree_wall_motions[SCREE_WALL_MOTIONS] = {
    [SCREE_WALL_VELOCITY] = {.shift = velocity_shift, .largest = velocity_largest, .wrong = velocity_wrong},
    [SCREE_WALL_DISPLACEMENT] = {.shift = displacement_shift,
                                 .largest = displacement_largest,
                                 .wrong = displacement_wrong},
    [SCREE_WALL_VIBRATION] = {.shift = vibration_shift, .largest = vibration_largest, .wrong = vibration_wrong},
    [SCREE_WALL_SERVO] = {.servo = true, .shift = servo_shift, .wrong = servo_wrong},
};

const scree_choice scree_wall_motion_choices[SCREE_WALL_MOTIONS + 1] = {
    {"velocity", SCREE_WALL_VELOCITY, "with `velocity`, constant or by a table; it stands where that is 0"},
    {"displacement", SCREE_WALL_DISPLACEMENT, "it is where the table `displacement` says"},
    {"vibration", SCREE_WALL_VIBRATION, "to and fro, with `amplitude` and `frequency`"},
    {"servo", SCREE_WALL_SERVO, "a servo along `direction` holds `force`"},
    {0},
};

void scree_wall_shift(const scree_config_wall *wall, double travel, double time, double shift[3])
{
    scree_wall_motions[wall->motion].shift(wall, travel, time, shift);
}

bool scree_wall_is_steady(const scree_config_wall *wall)
{
    bool steady = wall->motion == SCREE_WALL_VELOCITY;
    for (int k = 0; k < 3; k++) steady = steady && wall->velocity[k].form == SCREE_SCHEDULE_CONSTANT;
    return steady;
}

bool scree_wall_stands(const scree_config_wall *wall)
{
    bool stands = scree_wall_is_steady(wall);
    for (int k = 0; k < 3; k++) stands = stands && wall->velocity[k].value == 0 && wall->spin[k] == 0;
    return stands;
}

void scree_wall_velocity(const scree_config_wall *wall, double speed, double time, double step, double velocity[3])
{
    double before[3];
    if (scree_wall_is_steady(wall)) {
        for (int k = 0; k < 3; k++) velocity[k] = wall->velocity[k].value;
        return;
    }
    if (scree_wall_motions[wall->motion].servo) {
        servo_shift(wall, speed, 0, velocity);
        return;
    }
    scree_wall_shift(wall, 0, time, velocity);
    scree_wall_shift(wall, 0, time - step, before);
    for (int k = 0; k < 3; k++) velocity[k] = step > 0 ? (velocity[k] - before[k]) / step : 0;
}

double scree_wall_largest_speed(const scree_config_wall *wall)
{
    double largest[3];
    if (scree_wall_motions[wall->motion].servo) return wall->servo_velocity;
    scree_wall_motions[wall->motion].largest(wall, largest);
    return scree_length(largest);
}

const char *scree_wall_motion_wrong(const scree_config_wall *wall, int dimension, const char **key)
{
    return scree_wall_motions[wall->motion].wrong(wall, dimension, key);
}
