/// Rigid plates: prescribed velocity, or servo to a normal stress.
#ifndef SCREE_BOUNDARY_PLATES_H
#define SCREE_BOUNDARY_PLATES_H

#include "state/work.h"

/// Moves every active wall by velocity * dt.
void scree_plates_move(scree_state *state);

/// A plate under servo: its dashpot and its mass, see plates.c.
typedef struct scree_servo {
    double impedance; ///< N s/m
    double mass;      ///< kg
} scree_servo;

/// The servo of wall `index` that suits the present sample at `pressure` [Pa].
scree_servo scree_servo_for(const scree_model *model, const scree_state *state, int index, double pressure);

/// Time [s] that a longitudinal wave needs through the longer side of the sample at `pressure`.
double scree_sample_wave_time(const scree_model *model, const scree_state *state, double pressure);

/// Advances the velocity of wall `index` by one step, so that its normal stress goes to `pressure` [Pa, compression
/// positive], within the velocity limit of the case.
void scree_plate_servo(const scree_model *model, scree_state *state, int index, scree_servo servo, double pressure);

/// Normal stress on a wall [Pa, compression positive] = force / (length * thickness).
double scree_plate_stress(const scree_model *model, const scree_state *state, int index);

/// Extent of the sample along the wall [m]: between the side plates when they are active, else between the corners of
/// the plate on the outline of the sample (measure/outline.h). Under the pressure p on the sides, forces p x this
/// length x thickness on both plates hold the sample in equilibrium, also when it is wider at one end than at the
/// other; any other forces would drive it away as a whole. Without a loop: the mean width.
double scree_plate_length(const scree_state *state, int index);

#endif
