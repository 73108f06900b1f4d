/// Law hertz_brilliantov: Hertz's normal force with the damping of Brilliantov et al. 1996, and friction regularised by
/// the slip speed (P 2.A1-2.A7, 3.A1-3.A3, corrected as in docs/theory.md).
///   f_n = max(K d^1.5 + T K d^0.5 d', 0), K = normal_stiffness sqrt(R_eff)
///   f_t = -mu f_n (|s| / v_R)^(1/c) s / |s|, zero at s = 0
/// The power is 2^(log(|s| / v_R) / (c log 2)) with SLEEF's functions: the error of the logarithm is divided by c. In
/// two dimensions the slip is a signed number, so no root is needed.
///
/// History row, only for the ledger, at n - 1: in 2D tangential force and normal damping force [N], in 3D x, y, z of
/// the tangential force and the normal damping force; unused without a ledger. Ledger: damping <f_n - K d^1.5> delta,
/// friction -<f_t> . sigma (mean forces and middle increments: motion.h).
/// Cost: 2 roots, 2 divisions (3D: 3 and 3), one logarithm, one exponential a contact.
#ifndef SCREE_CONTACT_HERTZ_BRILLIANTOV_H
#define SCREE_CONTACT_HERTZ_BRILLIANTOV_H

#include "contact/law.h"

/// -magnitude along the slip.
SCREE_INLINE vector against_slip(int dimension, lanes magnitude, vector slip, lanes speed)
{
    if (dimension == 2) return (vector){.x = -lanes_with_sign(magnitude, slip.x)};
    lanes_bits slips = ~lanes_at_or_below(speed, lanes_all(0));
    return vector_times(3, slip, -lanes_keep(slips, magnitude / speed));
}

SCREE_INLINE law_force hertz_brilliantov(variant v, const law_constants *constants, const law_settings *settings,
                                         const motion *m, lanes_bits touching, const law_memory *before,
                                         law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    lanes d = lanes_keep(touching, m->indentation);
    lanes stiffness = constants->normal_stiffness * lanes_root(m->reduced_radius * d);
    lanes elastic = stiffness * d;
    lanes normal = lanes_at_least(elastic + stiffness * (settings->damping_time * m->approach), lanes_all(0));

    lanes speed = dimension == 2 ? lanes_abs(m->slip.x) : lanes_root(vector_dot(3, m->slip, m->slip));
    lanes relative = speed * settings->inverse_reference_velocity;
    lanes mobilised = lanes_exp2(lanes_log(relative) * settings->binary_exponent);
    vector tangential = against_slip(dimension, constants->friction * normal * mobilised, m->slip, speed);

    lanes damping = normal - elastic, none = lanes_all(0), damping_before = before->value[1];
    vector tangential_before = {.x = before->value[0]};
    *after = (law_memory){.value = {tangential.x, damping, none, none}};
    if (dimension == 3) {
        vector kept = {before->value[0], before->value[1], before->value[2]};
        tangential_before = motion_carry(3, m, kept);
        damping_before = before->value[3];
        *after = (law_memory){.value = {tangential.x, tangential.y, tangential.z, damping}};
    }
    vector both = vector_plus(count, tangential, tangential_before);
    return (law_force){
        .normal = normal,
        .tangential = tangential,
        .couple = vector_none(),
        .damping = 0.5 * (damping + damping_before) * m->approached,
        .friction = vector_dot(count, vector_times(count, both, lanes_all(-0.5)), m->slipped),
        .stiffness = none,
        .elastic_normal = 0.4 * (elastic * d),
        .elastic_tangential = none,
    };
}

#endif
