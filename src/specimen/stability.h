/// What an explicit run of a specimen stands: the largest steps, and of deformable particles the largest stiffness of
/// their contacts. stability.c has the method, docs/theory/ddem.md the derivations.
#ifndef SCREE_SPECIMEN_STABILITY_H
#define SCREE_SPECIMEN_STABILITY_H

#include "specimen/specimen.h"

/// How the strain follows the forces from step to step.
typedef struct scree_strain_scheme {
    double share;  ///< with which a mode that changes sign in every step is answered: 1 explicit, theta / (2 - theta)
                   ///< relaxed, -1 implicit, 0 without deformation
    double radius; ///< spectral radius of B
} scree_strain_scheme;

static inline scree_strain_scheme scree_strain_rigid(void)
{
    return (scree_strain_scheme){0, 0};
}

static inline scree_strain_scheme scree_strain_explicit(double radius)
{
    return (scree_strain_scheme){1, radius};
}

static inline scree_strain_scheme scree_strain_relaxed(double theta, double radius)
{
    return (scree_strain_scheme){theta / (2 - theta), radius};
}

static inline scree_strain_scheme scree_strain_implicit(double radius)
{
    return (scree_strain_scheme){-1, radius};
}

/// Spectral radius of B. force: contact forces of its mode, or NULL. Errors: memory; no convergence.
scree_status scree_spectral_radius(const scree_specimen *specimen, double *radius, double *force, scree_error *error)
    __attribute__((warn_unused_result));

/// Relaxation of the strain for a spectral radius: 1 / (1 + radius), rounded down to a multiple of 2^-10, so that the
/// last bits of an eigenvalue do not steer a run. No mode of the iteration changes its sign then, at any stiffness,
/// and the critical step is at least 0.7 times that of rigid particles.
double scree_relaxation(double radius);

/// Critical step [s] of the leapfrog schemes with this treatment of the strain; INFINITY without springs and dashpots,
/// 0 where no step is stable. mode: motions of its mode (scree_specimen_motions), or NULL. Errors: memory; no
/// convergence.
scree_status scree_critical_step(const scree_specimen *specimen, scree_strain_scheme scheme, double *step, double *mode,
                                 scree_error *error) __attribute__((warn_unused_result));

/// How much of the limit a step [s] uses: the largest eigenvalue of the map whose eigenvalue is 1 at the critical step;
/// below 1 the step is stable, above it is not. Goes with the square of the step between rigid particles without
/// dashpots. Errors: memory; no convergence.
scree_status scree_stability_use(const scree_specimen *specimen, scree_strain_scheme scheme, double step, double *use,
                                 scree_error *error) __attribute__((warn_unused_result));

/// A bound of it from single bodies, never below it, at a hundredth of the cost; INFINITY where there is none
/// (bound.c). share: of the scheme. Errors: memory.
scree_status scree_stability_bound(const scree_specimen *specimen, double share, double step, double *bound,
                                   scree_error *error) __attribute__((warn_unused_result));

/// The same of the spectral radius of B.
scree_status scree_radius_bound(const scree_specimen *specimen, double *bound, scree_error *error)
    __attribute__((warn_unused_result));

/// The factor by which particles could be softer, or contacts stiffer against them, until the step [s] is critical: the
/// largest k_n / E_p at this step over the present one. Below 1 it is not stable now; 0 where the step is not even with
/// rigid particles; INFINITY where strains do not count (rigid, implicit). Errors: memory; no convergence.
scree_status scree_stability_softness(const scree_specimen *specimen, scree_strain_scheme scheme, double step,
                                      double *factor, scree_error *error) __attribute__((warn_unused_result));

/// k_n / E [m]: mean stiffness of the contacts over the mean Young's modulus of the particles that deform.
double scree_stiffness_ratio(const scree_specimen *specimen);

/// Steps [s] from single bodies: 2 sqrt(m / k) least over the bodies with the largest stiffness k of each while its
/// neighbours stand (M 2.17, 2.18), and sqrt(m_min / k_max) (M 2.19 with alpha = 1). Errors: memory.
scree_status scree_step_of_bodies(const scree_specimen *specimen, double *step, scree_error *error)
    __attribute__((warn_unused_result));
double scree_step_of_extremes(const scree_specimen *specimen);

#endif
