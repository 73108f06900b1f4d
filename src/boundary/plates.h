/// Rigid plates: prescribed velocity, or servo to a normal stress.
#ifndef SCREE_BOUNDARY_PLATES_H
#define SCREE_BOUNDARY_PLATES_H

#include "state/plates.h"
#include "state/work.h"

/// Longitudinal modulus [Pa] of a packing of the model's grains under `pressure` [Pa], estimated as above.
double scree_confined_modulus(const scree_model *model, double pressure);

/// The servo of wall `index` that suits the present sample at `pressure` [Pa].
scree_servo scree_servo_for(const scree_model *model, const scree_state *state, int index, double pressure);

/// Time [s] that a longitudinal wave needs through the longer side of the sample at `pressure`.
double scree_sample_wave_time(const scree_model *model, const scree_state *state, double pressure);

/// Advances the velocity of wall `index` by one step, so that its normal stress goes to `pressure` [Pa, compression
/// positive], within the velocity limit of the case.
void scree_plate_servo(const scree_model *model, scree_state *state, int index, scree_servo servo, double pressure);

/// Normal stress on a wall [Pa, compression positive] = force / area.
double scree_plate_stress(const scree_model *model, const scree_state *state, int index);

/// Area of the sample along the wall [m2]; in 2D a length times the thickness. Between the side plates when they are
/// active, else what the outline (measure/outline.h) or the hull (measure/hull.h) of the sample covers of the plate.
/// Under the pressure p on the sides, forces p x this area on both plates hold the sample in equilibrium, also when it
/// is wider at one end than at the other; any other forces would drive it away as a whole. Without a boundary, or when
/// it covers nothing of the plate: the mean section.
double scree_plate_area(const scree_model *model, const scree_state *state, int index);

#endif
