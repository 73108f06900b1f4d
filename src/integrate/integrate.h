/// Integrators: one file a scheme, one descriptor each. A step is first(), forces at the new positions, second().
#ifndef SCREE_INTEGRATE_INTEGRATE_H
#define SCREE_INTEGRATE_INTEGRATE_H

#include "state/work.h"

typedef struct scree_integrator {
    const char *name;
    const char *meaning; ///< one line for the manual
    /// Ticks of the next step of a loading stage. NULL: always the largest step of the model.
    uint64_t (*ticks)(const scree_model *model, const scree_state *state);
    /// Advances rows (and angles, largest_speed, work->budget) to positions n+1 from the sums at n.
    void (*first)(const scree_model *model, scree_state *state, scree_work *work);
    /// Finishes velocities with the sums at n+1. May be NULL.
    void (*second)(const scree_model *model, scree_state *state, scree_work *work);
    double velocity_lead; ///< stored velocity = v(n - 1/2) + velocity_lead * dt * a(n): 0 position, 1/2 velocity Verlet
} scree_integrator;

/// Descriptor of a scheme.
const scree_integrator *scree_integrator_get(scree_scheme scheme);

/// Chooses the next step: sets step_size and kick_size of the state. Returns its ticks. The state must stand between
/// two steps; state->step is the caller's to advance.
uint64_t scree_integrator_choose_step(const scree_integrator *integrator, const scree_model *model, scree_state *state,
                                      bool loading);

/// The kick [s] that the next step will begin with, in which the forces at the present step act: all of it, of which
/// velocity_verlet gives half right away.
double scree_integrator_next_kick(const scree_integrator *integrator, const scree_model *model,
                                  const scree_state *state, bool loading);

/// Force [N] and torque [N m] on the body in `row` at the present step: sums, gravity.
void scree_body_force(const scree_model *model, const scree_state *state, size_t row, scree_vector force,
                      scree_vector torque);

/// Physical velocity [m/s] and spin [rad/s] at step n.
void scree_body_velocity(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                         scree_vector spin);

/// Velocity v(n - 1/2) and spin with which the contact forces at n were evaluated.
void scree_body_half_velocity(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                              scree_vector spin);

#endif
