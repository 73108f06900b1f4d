/// Critical time step of an assembly before its contacts are known: what the head of critical_step.c derives.
#ifndef SCREE_MODEL_CRITICAL_STEP_H
#define SCREE_MODEL_CRITICAL_STEP_H

#include "model/model.h"

/// Tangent of a law at the static normal force `force` [N] between bodies of the effective radius [m] and
/// mass [kg].
scree_contact_tangent scree_contact_linearise(const scree_law_use *law, const scree_pair_constants *pair,
                                              double effective_radius, double effective_mass, double force);

/// Largest stable step [s] of a hexagonal lattice of discs, in 3D a face-centred cubic one of spheres, of `mass` [kg]
/// with such contacts, of a scheme with this limit (module/integrator.h; NULL: a leapfrog). INFINITY without stiffness.
double scree_critical_step_lattice(int dimension, const scree_contact_tangent *tangent, double mass,
                                   double (*limit)(double ratio));

/// Estimate for the loads of the model's case (confining pressure, gravity, velocities). Reads everything of the model
/// but the step.
double scree_critical_step_estimate(const scree_model *model);

/// What else helps where a step is too large: less damping, where dashpots make the estimate much smaller. Else empty.
const char *scree_critical_step_advice(const scree_model *model, char text[96]);

/// What a case says of its sample before there is one: solid fraction of a packing, height [m] along the last axis of
/// the sample at the solid fraction `phi`, size of gravity [m/s2].
double scree_expected_solid_fraction(const scree_model *model);
double scree_expected_height(const scree_model *model, double phi);
double scree_model_gravity(const scree_model *model);

/// Speed [m/s] of fast bodies, of those whose velocity components are `velocity` [m/s], root-mean-square, or that the
/// fastest loading drives past each other.
double scree_expected_fast_speed(const scree_model *model, double velocity);

#endif
