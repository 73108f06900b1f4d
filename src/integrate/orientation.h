/// Orientation of bodies in 3D as unit quaternions (orientation.c), where the case asks for it.
#ifndef SCREE_INTEGRATE_ORIENTATION_H
#define SCREE_INTEGRATE_ORIENTATION_H

#include "state/state.h"

/// Cosine of half the angle, then the sine of it times the axis: what lies at p in the body, from its centre, lies at
/// q (0, p) q* in space.
typedef double scree_quaternion[4];

/// Turns q by the spin w [rad/s] about axes in space for a time h [s]: q <- exp(h w / 2) q, of length 1. Zeros stand
/// for no rotation.
void scree_quaternion_turn(scree_quaternion q, const double w[3], double h);

/// Those of all bodies, zeros of one that has come since the last step; NULL: none are kept.
const scree_quaternion *scree_orientations(const scree_state *state);

/// Rotations count from here. Nothing where none is kept.
void scree_orientation_forget(scree_state *state);

#endif
