/// Motion of a whole sample as a rigid body.
#ifndef SCREE_BOUNDARY_RIGID_MOTION_H
#define SCREE_BOUNDARY_RIGID_MOTION_H

#include "model/model.h"
#include "state/state.h"

/// Velocity of the centre of mass [m/s] and angular velocity [rad/s] of the rigid body with the momentum and the
/// angular momentum that the bodies have by the velocities that the scheme keeps; of all processes. The angular
/// velocity is zero where the bodies have no inertia about some axis.
void scree_rigid_motion_measure(const scree_state *state, scree_vector centre, scree_vector velocity,
                                scree_vector spin);

/// Takes that motion from all bodies, whose momentum and angular momentum are zero then; nothing where some body's
/// motion is prescribed. Returns the kinetic energy that went with it [J]. For a leapfrog.
double scree_rigid_motion_stop(const scree_model *model, scree_state *state);

#endif
