/// What integrators share, and others ask of them. One file a scheme; their face is in module/integrator.h.
#ifndef SCREE_INTEGRATE_INTEGRATE_H
#define SCREE_INTEGRATE_INTEGRATE_H

#include "module/integrator.h"
#include "state/work.h"

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

/// What is known of them while forces at n are still being found: the predicted ones where the scheme predicts (lead of
/// the state), else as above, with the forces that are there.
void scree_body_velocity_so_far(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                                scree_vector spin);

/// Kinetic energies [J] of the balance: with v(n - 1/2) . v(n + 1/2), or of a scheme with velocities of its own at n
/// (module/integrator.h) with these (measure/energy.c).
void scree_body_kinetic(const scree_model *model, const scree_state *state, size_t row, double *translation,
                        double *rotation);

/// Velocity v(n - 1/2) and spin with which the contact forces at n were evaluated.
void scree_body_half_velocity(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                              scree_vector spin);

/// Wakes all bodies between two steps, with what rests on them (integrate/sleep.c). Of a whole state.
void scree_sleep_wake_all(const struct scree_context *c);

/// Whether bodies may sleep in one of these stages of a case (integrate/sleep.c).
bool scree_some_may_sleep(const scree_config_stage *stage, int64_t count);

#endif
