/// Law hertz_brilliantov: Hertz's normal force with the damping of Brilliantov et al. 1996, and friction regularised by
/// the slip speed (P 2.A1-2.A7, 3.A1-3.A3, corrected as in docs/theory.md).
///   f_n = max(K d^1.5 + T K d^0.5 d', 0), K = normal_stiffness sqrt(R_eff)
///   f_t = -sign(s) mu f_n (|s| / v_R)^(1/c), zero at s = 0
/// The power is that of contact/power.h; the slip is a signed number in two dimensions, so no root is needed.
///
/// Two updates of friction. Explicit: s is the slip of the velocities that brought the bodies here; a slip slower than
/// about mu f_n dt / m turns its sign in every step. Implicit (docs/friction-update.md): s = s* is the slip after the
/// coming kick. With s~ that slip if all forces stayed as they are, r the resistance -f_t and r' the one before,
///   s* = s~ - A (r - r'),  A = dt mobility,    r = sign(s*) mu f_n (|s*| / v_R)^(1/c),
/// the mobility for the share of mass that a body's contacts have each (motion.h; mass splitting after Tonge,
/// Benevolenski and Voroshilov 2012): a sweep of Jacobi's iteration in every step, from the forces of the last one,
/// that converges for any step. With y = (|s*| / v_R)^(1/c), b = |s~ + A r'| / v_R and g = A mu f_n / v_R, this is
///   y^c + g y = b,
/// which increases and is convex in y: min(b / g, b^(1/c)) is above the root, and two of Halley's steps are within 0.1
/// % of it for c = 50 (0.2 % for c = 200) where it is worst, at the corner between sticking and sliding.
///
/// History row: tangential force and normal damping force [N] at n - 1; the second only for the ledger, the first for
/// it and the implicit update. Ledger: damping <f_n - K d^1.5> delta, friction -<f_t> sigma (mean forces and middle
/// increments: motion.h). Cost: 2 roots, 2 divisions, one logarithm, one exponential a contact; implicit: 5 divisions
/// and 2 of these pairs more.
#ifndef SCREE_CONTACT_HERTZ_BRILLIANTOV_H
#define SCREE_CONTACT_HERTZ_BRILLIANTOV_H

#include "contact/law.h"
#include "contact/power.h"

/// y of y^c + g y = b.
SCREE_INLINE lanes hertz_brilliantov_mobilised(lanes b, lanes g, const law_settings *settings)
{
    const double c = settings->exponent, tiny = 1e-300; // against 0 / 0 where nothing slips
    lanes y = lanes_at_most(lanes_power(b, settings->inverse_exponent), b / (g + tiny));
    for (int k = 0; k < 2; k++) {
        lanes power = lanes_power(y, c);
        lanes excess = power + g * y - b, slope = c * power + g * y, bend = (c * (c - 1.0)) * power;
        y = y - y * (2.0 * (excess * slope) / (2.0 * (slope * slope) - excess * bend + tiny));
    }
    return y;
}

SCREE_INLINE lanes hertz_brilliantov_friction(bool implicit, lanes cap, const law_settings *settings, const motion *m,
                                              const law_memory *before)
{
    if (!implicit) {
        lanes speed = lanes_abs(m->slip) * settings->inverse_reference_velocity;
        return -lanes_with_sign(cap * lanes_power(speed, settings->inverse_exponent), m->slip);
    }
    // Nothing advances: the force that the last step ended with.
    if (settings->step == 0) return before->value[0];
    lanes mobility = settings->step * m->mobility * settings->inverse_reference_velocity;
    lanes goal = m->foreseen_slip * settings->inverse_reference_velocity - mobility * before->value[0];
    return -lanes_with_sign(cap * hertz_brilliantov_mobilised(lanes_abs(goal), mobility * cap, settings), goal);
}

SCREE_INLINE law_force hertz_brilliantov(bool implicit, const law_constants *constants, const law_settings *settings,
                                         const motion *m, lanes_bits touching, const law_memory *before,
                                         law_memory *after)
{
    lanes d = lanes_keep(touching, m->indentation);
    lanes stiffness = constants->normal_stiffness * lanes_root(m->reduced_radius * d);
    lanes elastic = stiffness * d;
    lanes normal = lanes_at_least(elastic + stiffness * (settings->damping_time * m->approach), lanes_all(0));

    lanes tangential = hertz_brilliantov_friction(implicit, constants->friction * normal, settings, m, before);

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
