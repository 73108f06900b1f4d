/// The servo of a wall of the case.
#ifndef SCREE_STATE_WALL_SERVO_H
#define SCREE_STATE_WALL_SERVO_H

#include "state/state.h"

/// Area that a wall under servo presses with [m2]; in 2D its length times the thickness of the sample.
double scree_wall_servo_area(const scree_model *model, const scree_config_wall *wall);

/// Speed of the wall in the step that begins [m/s], from its speed in the last one and the force that it exerts on the
/// bodies along its direction at n [N]. time: of the walls.
double scree_wall_servo_speed(const scree_model *model, const scree_state *state, const scree_config_wall *wall,
                              double speed, double force, double time);

#endif
