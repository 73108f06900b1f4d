/// Law hertz_brilliantov: Hertz's normal force with the damping of Brilliantov et al. 1996, and friction regularised by
/// the slip speed (P 2.A1-2.A7, 3.A1-3.A3, corrected as in docs/theory.md).
///   f_n = max(K d^1.5 + T K d^0.5 d', 0), K = normal_stiffness sqrt(R_eff)
///   f_t = -sign(s) mu f_n (|s| / v_R)^(1/c), zero at s = 0
/// The power is 2^(log(|s| / v_R) / (c log 2)) with SLEEF's functions: the error of the logarithm is divided by c, and
/// the slip is a signed number in two dimensions, so no root is needed.
///
/// History row, only for the ledger: tangential force and normal damping force [N] at n - 1; unused without a ledger.
/// Ledger: damping <f_n - K d^1.5> delta, friction -<f_t> sigma (mean forces and middle increments: motion.h).
/// Cost: 2 roots, 2 divisions, one logarithm, one exponential a contact.
#ifndef SCREE_CONTACT_HERTZ_BRILLIANTOV_H
#define SCREE_CONTACT_HERTZ_BRILLIANTOV_H

#include "contact/law.h"

SCREE_INLINE law_force hertz_brilliantov(const law_constants *constants, const law_settings *settings, const motion *m,
                                         lanes_bits touching, const law_memory *before, law_memory *after)
{
    lanes d = lanes_keep(touching, m->indentation);
    lanes stiffness = constants->normal_stiffness * lanes_root(m->reduced_radius * d);
    lanes elastic = stiffness * d;
    lanes normal = lanes_at_least(elastic + stiffness * (settings->damping_time * m->approach), lanes_all(0));

    lanes speed = lanes_abs(m->slip) * settings->inverse_reference_velocity;
    lanes mobilised = lanes_exp2(lanes_log(speed) * settings->binary_exponent);
    lanes tangential = -lanes_with_sign(constants->friction * normal * mobilised, m->slip);

    lanes damping = normal - elastic, none = lanes_all(0);
    *after = (law_memory){{tangential, damping, none, none}};
    return (law_force){
        .normal = normal,
        .tangential = tangential,
        .damping = 0.5 * (damping + before->value[1]) * m->approached,
        .friction = -0.5 * (tangential + before->value[0]) * m->slipped,
        .stiffness = none,
        .elastic_normal = 0.4 * (elastic * d),
        .elastic_tangential = none,
    };
}

#endif
