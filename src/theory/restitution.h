/// Restitution of a binary impact under the two Hertzian laws: what a damping coefficient means, and which one a wanted
/// restitution needs. The force is never attractive, the bodies part when it has fallen to zero; but where
/// hertz_brilliantov is asked for attraction, they part when their overlap is gone.
#ifndef SCREE_THEORY_RESTITUTION_H
#define SCREE_THEORY_RESTITUTION_H

#include "base/error.h"

#include <stdbool.h>

typedef struct scree_impact {
    double restitution; ///< 1, relative speed after the impact over that before
    double duration;    ///< s, from the first touch until the bodies part
} scree_impact;

/// Impact under f = K d^1.5 + T K d^0.5 d' (law hertz_brilliantov, P 2.16).
/// speed [m/s] > 0 at the first touch; stiffness K [N/m^1.5] > 0; mass [kg] > 0, effective: m1 m2 / (m1 + m2);
/// damping_time T [s] >= 0. Relative error below 1e-8. Errors: an argument out of range; a damping so strong that
/// T speed^(1/5) (K / mass)^(2/5) exceeds 1000; with attraction bodies that do not part again; memory.
scree_status scree_impact_viscoelastic(double speed, double stiffness, double mass, double damping_time,
                                       bool attraction, scree_impact *impact, scree_error *error) SCREE_MUST_USE;

/// Restitution under f = k d + damping sqrt(m_eff k) d', k = A sqrt(R_eff d) (law hertz_mindlin): a function of
/// `damping` [1] >= 0 alone, the same for every speed, stiffness and mass.
double scree_restitution_from_damping(double damping);

/// The inverse, to the last bit. restitution [1]: 1 and above gives 0, 0 and below gives INFINITY.
double scree_damping_from_restitution(double restitution);

#endif
