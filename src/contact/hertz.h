/// What laws with Hertz's normal force have in common: constants of two materials and closed forms.
#ifndef SCREE_CONTACT_HERTZ_H
#define SCREE_CONTACT_HERTZ_H

#include "model/law.h"

/// Constants of a pair, beside SCREE_FRICTION.
enum {
    HERTZ_NORMAL = 0,     ///< Pa, (4/3) Ebar;  f_n = normal sqrt(R_eff) d^1.5
    HERTZ_TANGENTIAL = 1, ///< Pa, 8 Gbar;      k_t = tangential sqrt(R_eff d)
    HERTZ_DAMPING = 3,    ///< 1, eta = damping sqrt(m_eff k_n), k_n = normal sqrt(R_eff d)
    HERTZ_ROLLING = 4,    ///< 1, cap of the rolling resistance over f_n
    HERTZ_TWISTING = 5,   ///< 1, cap of the twisting torque over R_eff f_n
    HERTZ_RATIO = 6,      ///< 1, normal over tangential, for bounds
};

/// Both stiffnesses, their ratio and friction; b is NULL for something rigid, which leaves the rest to a. Symmetric.
scree_pair_constants scree_hertz_constants(const scree_config_material *a, const scree_config_material *b);

extern const scree_elastic scree_elastic_hertz;

#endif
