/// The periodic cell in motion: any velocity gradient, each component prescribed or left to a stress.
#ifndef SCREE_BOUNDARY_PERIODIC_H
#define SCREE_BOUNDARY_PERIODIC_H

#include "state/work.h"

/// Of every component of the velocity gradient either a rate or a stress.
typedef struct scree_periodic_demand {
    double rate[9];   ///< 1/s; counts where no stress is held
    double stress[9]; ///< Pa, tension positive; NAN where a rate is prescribed
} scree_periodic_demand;

/// Sets inertia, damping and limit of the servo as they suit the present sample at `pressure` [Pa], see periodic.c.
void scree_periodic_fit(const scree_model *model, scree_state *state, double pressure);

/// Time [s] that a longitudinal wave needs through the longest side of the cell at `pressure`.
double scree_periodic_wave_time(const scree_model *model, const scree_state *state, double pressure);

/// Decides the velocity gradient of the coming step: prescribed rates times `rise`, the others by one step of their
/// servo from the stress at n.
void scree_periodic_control(const scree_model *model, scree_state *state, const scree_periodic_demand *wanted,
                            double rise);

/// Right after the integrator's `first`: moves lattice and bodies with the gradient, puts bodies back that have left
/// the cell, and gives rows whole velocities for the evaluation of contacts. Accumulates the first half of the work.
/// Errors: memory. Nothing without a periodic cell.
scree_status scree_periodic_move(const scree_model *model, scree_state *state, scree_work *work,
                                 scree_error *error) SCREE_MUST_USE;

/// Right after scree_contact_forces: rows get back the velocities relative to the affine field, and the second half of
/// the work is accumulated.
void scree_periodic_settle(scree_state *state, scree_work *work);

#endif
