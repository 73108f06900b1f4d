/// What a force law is given and what it gives back, in lanes. A law is one always-inline function
///   law_force name(constants, settings, motion, touching, before, after)
/// in a header of its own; contact/laws.h lists them. Values of lanes that do not touch must come out zero.
#ifndef SCREE_CONTACT_LAW_H
#define SCREE_CONTACT_LAW_H

#include "contact/motion.h"
#include "state/state.h"

/// Constants of the pair of materials, one value a lane: model/model.h, scree_pair_constants.
typedef struct law_constants {
    lanes normal_stiffness, tangential_stiffness, friction, damping;
} law_constants;

/// Numbers of the whole run.
typedef struct law_settings {
    double step;                       ///< s; 0 evaluates without advancing histories (contact table)
    double damping_time;               ///< s
    double inverse_exponent;           ///< 1, 1/c
    double exponent;                   ///< 1, c
    double inverse_reference_velocity; ///< s/m, 1 / v_R
} law_settings;

/// A history row in lanes.
typedef struct law_memory {
    lanes value[SCREE_HISTORY];
} law_memory;

typedef struct law_force {
    lanes normal, tangential;                 ///< N, along n and t, on first
    lanes damping, friction, stiffness;       ///< J, ledger increments of this step
    lanes elastic_normal, elastic_tangential; ///< J
} law_force;

#endif
