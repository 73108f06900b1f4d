/// Resistance to turning of constant size (Zhou et al. 1999; model A of Ai et al. 2011): a torque mu_r R_eff f_n
/// against the relative rolling, and mu_tw R_eff f_n against the relative spin about the normal, however slow the
/// motion is.
///
/// At rest the direction is not defined. Below a speed the resistance falls in proportion to it,
///   F = -roll min(eta, cap / |roll|),     eta = m_eff / (8 kappa dt),   kappa = 2 (discs) or 2.5 (spheres)
/// a dashpot that takes, in one step dt, an eighth of what m_eff R_eff^2 / kappa (never more than the inertia of the
/// relative turning) can lose: so it stops a body without turning it back, also where several contacts act on it. It
/// only dissipates. Limit: it holds no torque at rest; under one below the cap a body creeps, with a speed of rolling
/// below 8 kappa dt cap / m_eff, which vanishes with the step. What has to stand on a slope wants springs (slider.h).
///
/// Memory: the force, which an evaluation without a step gives back, and with which the ledger has the mean of a step.
/// Ledger: friction <F> . roll dt.
#ifndef SCREE_CONTACT_CONSTANT_TORQUE_H
#define SCREE_CONTACT_CONSTANT_TORQUE_H

#include "contact/vector.h"

/// Which share of the inertia a step may stop, inverted.
#define CONSTANT_TORQUE_SHARE 8.0

typedef struct constant_torque {
    vector resistance; ///< -F; zero with a cap of zero
    lanes friction;    ///< J, twice what is dissipated
} constant_torque;

/// eta [kg/s] of a relative motion of this inertia [kg]; 0 without a step.
SCREE_INLINE lanes constant_torque_viscosity(int dimension, lanes mass, double step)
{
    const double kappa = dimension == 3 ? 2.5 : 2;
    return mass * (step > 0 ? 1 / (CONSTANT_TORQUE_SHARE * kappa * step) : 0);
}

/// before: the resistance of the last step, in the directions of this one. rate: of the motion; last_rate: of it at the
/// end of the step.
SCREE_INLINE constant_torque constant_torque_resist(int count, vector before, vector rate, vector last_rate,
                                                    double step, lanes viscosity, lanes cap)
{
    const vector wanted = step > 0 ? vector_times(count, last_rate, viscosity) : before;
    constant_torque c = {.resistance = vector_at_most(count, wanted, cap)};
    c.friction =
        vector_dot(count, vector_plus(count, c.resistance, before), vector_times(count, rate, lanes_all(step)));
    return c;
}

#endif
