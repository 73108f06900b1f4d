/// What a force law is given and what it gives back, in lanes. A law is one always-inline function
///   law_force name(variant, constants, settings, motion, touching, before, after)
/// in a header of its own; contact/laws.h lists them. Values of lanes that do not touch must come out zero.
#ifndef SCREE_CONTACT_LAW_H
#define SCREE_CONTACT_LAW_H

#include "contact/motion.h"
#include "state/state.h"

/// What evaluations are specialised by: constants in the kernels, runtime values in the scalar reference.
typedef struct variant {
    int dimension;
    scree_law law;
    bool many_materials;
    bool ledger;
    bool rolling;  ///< some pair of materials resists rolling or twisting
    bool rescaled; ///< hertz_mindlin: springs that stiffen keep their force, not their displacement
} variant;

/// Constants of the pair of materials, one value a lane: model/model.h, scree_pair_constants.
typedef struct law_constants {
    lanes normal_stiffness, tangential_stiffness, friction, damping;
    lanes rolling_friction, twisting_friction;
} law_constants;

/// Numbers of the whole run.
typedef struct law_settings {
    double step;                       ///< s; 0 evaluates without advancing histories (contact table)
    double damping_time;               ///< s
    double binary_exponent;            ///< 1 / (c log 2)
    double exponent;                   ///< 1, c
    double inverse_reference_velocity; ///< s/m, 1 / v_R
} law_settings;

/// The rows that a contact remembers, in lanes: scree_history, scree_booking, scree_rolling.
typedef struct law_memory {
    lanes value[SCREE_HISTORY];
    lanes booked[4];
    lanes rolling[4], rolling_booked[4];
} law_memory;

typedef struct law_force {
    lanes normal;                             ///< N, along n, on first
    vector tangential;                        ///< N, on first: along t, or in the tangent plane
    vector couple;                            ///< N m, of rolling and twisting resistance, on first
    lanes damping, friction, stiffness;       ///< J, ledger increments of this step
    lanes elastic_normal, elastic_tangential; ///< J; the springs of rolling and twisting count as tangential
} law_force;

#endif
