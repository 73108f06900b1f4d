/// Rigid plates: prescribed velocity, or servo to a normal stress.
#ifndef SCREE_BOUNDARY_PLATES_H
#define SCREE_BOUNDARY_PLATES_H

#include "state/work.h"

/// Moves every active wall by velocity * dt.
void scree_plates_move(scree_state *state);

/// Sets the velocity of wall `index` so that its normal stress goes to `pressure` [Pa, compression positive], with the
/// gain and velocity limit of the case. Damped so that it does not ring: see plates.c.
void scree_plate_servo(const scree_model *model, scree_state *state, int index, double pressure);

/// Normal stress on a wall [Pa, compression positive] = force / (length * thickness); length of the wall is the extent of
/// the sample along it.
double scree_plate_stress(const scree_model *model, const scree_state *state, int index);

/// Extent of the sample along the wall [m]: between the side plates when they are active, else the mean width of the
/// Delaunay boundary (area / height).
double scree_plate_length(const scree_model *model, const scree_state *state, int index);

#endif
