/// How a wall of the case moves, beside the constant spin that it may have: one row of a table a kind. Pure functions
/// of the time that the walls have been moving for, but for a servo, whose travel along its direction is state
/// (state/case_walls.h).
#ifndef SCREE_CASE_WALL_MOTION_H
#define SCREE_CASE_WALL_MOTION_H

#include "case/config.h"

typedef struct scree_wall_motion {
    bool servo; ///< it follows a force
    /// Where its centre has come to, from where the case puts it [m]. travel [m]: of a servo.
    void (*shift)(const scree_config_wall *wall, double travel, double time, double shift[3]);
    /// A bound of each component of its velocity at all times [m/s]. NULL: not known (servo).
    void (*largest)(const scree_config_wall *wall, double largest[3]);
    /// What is wrong with its keys, and under which; NULL: nothing. NULL: never anything.
    const char *(*wrong)(const scree_config_wall *wall, int dimension, const char **key);
} scree_wall_motion;

/// Values of the choice walls.motion: a row of the table each.
typedef enum scree_wall_motion_kind {
    SCREE_WALL_VELOCITY,
    SCREE_WALL_DISPLACEMENT,
    SCREE_WALL_VIBRATION,
    SCREE_WALL_SERVO,
    SCREE_WALL_MOTIONS
} scree_wall_motion_kind;

extern const scree_wall_motion scree_wall_motions[SCREE_WALL_MOTIONS];
extern const scree_choice scree_wall_motion_choices[SCREE_WALL_MOTIONS + 1];

/// Where its centre has come to [m].
void scree_wall_shift(const scree_config_wall *wall, double travel, double time, double shift[3]);

/// Its velocity [m/s] in the step of `step` [s] that ends at `time`: what it has gone over what that took, so that the
/// rates that contacts see are those of the gaps. speed [m/s]: of a servo along its direction.
void scree_wall_velocity(const scree_config_wall *wall, double speed, double time, double step, double velocity[3]);

/// Whether its velocity is the same at all times.
bool scree_wall_is_steady(const scree_config_wall *wall);

/// Whether it never moves.
bool scree_wall_stands(const scree_config_wall *wall);

/// A bound of its speed at all times, without its spin [m/s]; a servo's own limit, NAN: auto.
double scree_wall_largest_speed(const scree_config_wall *wall);

/// What is wrong with its motion, and under which key; NULL: nothing.
const char *scree_wall_motion_wrong(const scree_config_wall *wall, int dimension, const char **key);

#endif
