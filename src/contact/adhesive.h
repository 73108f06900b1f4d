/// What hertz_jkr and hertz_dmt have in common: Hertzian contacts that stick, with the springs, dashpots and sliders of
/// hertz_mindlin. Of a work of adhesion w [J/m2], with 1/Ebar as in hertz.c, N = 4/3 Ebar and B = sqrt(2 pi w / Ebar):
///
///   JKR (Johnson, Kendall and Roberts 1971), of the radius a of the contact area:
///     d = a^2 / R_eff - B sqrt(a)     f = N a^3 / R_eff - 3/2 B N a^1.5     F_c = 3/2 pi w R_eff = 9/16 B^2 N R_eff
///     U = N a^2 (2/5 s^2 - B s + 3/8 B^2),  s = a^1.5 / R_eff               energy of deformation less pi a^2 w
///   so f = 0 dU/dd on the branch a > a_c = (B R_eff / 4)^(2/3), which ends at d_c = -3/4 B a_c^(1/2). A contact begins
///   where the bodies touch (d = 0, f = -8/9 F_c: it snaps in) and holds until d <= d_c (f = -5/9 F_c: the neck
///   breaks); in between it pulls with F_c at most. That a contact has begun is what it remembers (k_t, which is a).
///   DMT (Derjaguin, Muller and Toporov 1975): d = a^2 / R_eff,  f = N a^3 / R_eff - F_c,  F_c = 2 pi w R_eff =
///     3/4 B^2 N R_eff,  U = 2/5 N a^5 / R_eff^2 - F_c d,  while the bodies touch. It has no neck and loses nothing.
///
/// Which of them: the Tabor parameter (R_eff w^2 / (Ebar^2 z_0^3))^(1/3), z_0 some 0.3 nm, is above about 5 for JKR
/// (soft, sticky, large) and below about 0.1 for DMT (Tabor 1977).
///
/// Method. With b = sqrt(a), c = sqrt(a_c), v = b - c, y = R_eff d + 3 c^4 the branch is v^2 (v^2 + 4 c v + 6 c^2) = y,
/// regular in sqrt(y) also where the neck breaks: FOUR Newton steps for v g(v) = sqrt(y), g^2 = v^2 + 4 c v + 6 c^2,
/// from v = sqrt(y) / (sqrt(3/2 c^2 + sqrt(y)) + sqrt(3/2) c), which is exact at both ends (y = 0 and c = 0) and 7 %
/// off between, leave round-off; the cube root c by a logarithm and a Newton step. The same operations in every lane.
///
/// Dashpots: eta = damping sqrt(m_eff N a); f_n = max(f + eta d', -F_c): they pull no harder than the surfaces hold.
/// Friction, rolling and twisting: sliders whose cap is their coefficient times the load f_n + 2 F_c (JKR; Thornton
/// 1991, from Savkoor and Briggs 1977) or f_n + F_c (DMT, the force of Hertz alone), both never negative; k_t = 8 Gbar
/// a, and springs keep their force where it grows (Thornton, Cummins and Cleary 2013; hertz_mindlin.h).
///
/// Ledger. damping <f_n - f> d' dt; in the steps in which a contact begins or ends also what is left of the work of f
/// over the step when the change of U is taken away: of JKR -U = 0.3 W where it snaps in and 0.0315 W where the neck
/// breaks, W = 2 pi w a_0^2, a_0 = (B R_eff)^(2/3) (elastic waves; Thornton and Ning 1998: 7.09 (w^5 R_eff^4 /
/// Ebar^2)^(1/3) in all), up to F_c d' dt; of DMT nothing, up to that. The force is a root near the break, so residuals
/// fall with the power 3/2 of the step from there, else with 2. Energies of springs (columns) have U, which is negative
/// where surfaces have gained more than bodies were deformed by. Cost: 8 roots, 6 divisions more than hertz_mindlin.
#ifndef SCREE_CONTACT_ADHESIVE_H
#define SCREE_CONTACT_ADHESIVE_H

#include "contact/mindlin.h"

/// Constants of a pair, beside those of Hertz.
enum { ADHESIVE_ROOT = 7 /* m^(1/2), B */ };

/// Options: how turning is resisted, as bits of hertz_mindlin over two.
enum { ADHESIVE_ROLLING = 1, ADHESIVE_CONSTANT = 2 };

/// Laws without a neck remember the same, so that beginning and end are known.
#define ADHESIVE_TRAITS(...)                                                                                           \
    {                                                                                                                  \
        .keeps_last_force = {false, true}, .displacement = true, .pulls = true, .wide = true, __VA_ARGS__              \
    }

/// F_c over B^2 N R_eff.
SCREE_INLINE double adhesive_pull(bool jkr)
{
    return jkr ? 9.0 / 16 : 3.0 / 4;
}

/// x^(1/3) of x >= 0; some 1e-100 for zero.
SCREE_INLINE lanes adhesive_cube_root(lanes x)
{
    x = lanes_at_least(x, lanes_all(1e-300));
    const lanes root = lanes_exp2(lanes_log(x) * (M_LOG2E / 3));
    return root - (root - x / (root * root)) * (1.0 / 3);
}

/// Radius a of the contact area [m] under JKR, where `present` has what may be a contact; those that are it: `holds`.
SCREE_INLINE lanes jkr_radius(lanes reduced_radius, lanes overlap, lanes root, lanes_bits present, lanes_bits *holds)
{
    const lanes cube = 0.25 * (root * reduced_radius), c = adhesive_cube_root(cube), square = c * c;
    const lanes y = reduced_radius * overlap + 3.0 * (c * cube);
    *holds = present & ~lanes_at_or_below(y, lanes_all(0));
    const lanes s = lanes_root(lanes_keep(*holds, y));
    lanes v = s / (lanes_root(1.5 * square + s) + sqrt(1.5) * c);
    for (int k = 0; k < 4; k++) {
        const lanes g_square = v * (v + 4.0 * c) + 6.0 * square, g = lanes_root(g_square);
        v -= (v * g - s) * g / (g_square + v * (v + 2.0 * c));
    }
    return lanes_keep(*holds, (c + v) * (c + v));
}

/// Elastic force and energy of a contact; zero for a radius of zero.
typedef struct adhesive_state {
    lanes force;  ///< N
    lanes energy; ///< J
} adhesive_state;

SCREE_INLINE adhesive_state adhesive_at(bool jkr, lanes stiffness, lanes root, lanes inverse_radius, lanes pull,
                                        lanes a)
{
    const lanes square = a * a;
    if (!jkr) {
        const lanes d = square * inverse_radius, hertz = stiffness * (a * d);
        const lanes held = lanes_keep(lanes_differ(a, lanes_all(0)), pull);
        return (adhesive_state){hertz - held, (0.4 * hertz - held) * d};
    }
    const lanes cube = a * lanes_root(a), s = cube * inverse_radius;
    return (adhesive_state){stiffness * cube * (s - 1.5 * root),
                            stiffness * square * ((0.4 * s - root) * s + 0.375 * (root * root))};
}

/// Twice what is lost where a contact begins or ends in this step; a_before is zero where it was none. What overlapped
/// before the step has been placed so: it did not snap in, and the ledger began with its energy.
SCREE_INLINE lanes adhesive_snap(const adhesive_state *now, const adhesive_state *before, lanes a, lanes a_before,
                                 lanes overlap, lanes way)
{
    const lanes_bits is = lanes_differ(a, lanes_all(0)), was = lanes_differ(a_before, lanes_all(0));
    const lanes_bits apart = lanes_at_or_below(overlap - way, 1e-3 * lanes_abs(way));
    return lanes_keep((is ^ was) & (was | apart),
                      (now->force + before->force) * way - 2.0 * (now->energy - before->energy));
}

SCREE_INLINE law_force adhesive_contact(bool jkr, variant v, const law_constants *constants,
                                        const law_settings *settings, const kinematics *m, lanes_bits touching,
                                        const law_memory *before, law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    const variant springs = {.dimension = dimension, .option = MINDLIN_RESCALED | v.option << 1};
    const lanes stiffness = constants->value[HERTZ_NORMAL], root = constants->value[ADHESIVE_ROOT];
    const lanes inverse_radius = 1.0 / m->reduced_radius,
                a_before = stiffness_before(dimension, before) / constants->value[HERTZ_TANGENTIAL];
    lanes_bits holds = touching & ~lanes_at_or_below(m->overlap, lanes_all(0));
    lanes a =
        jkr ? jkr_radius(m->reduced_radius, m->overlap, root, touching | lanes_differ(a_before, lanes_all(0)), &holds)
            : lanes_root(m->reduced_radius * lanes_keep(holds, m->overlap));
    const lanes pull = adhesive_pull(jkr) * (root * root) * (stiffness * m->reduced_radius);
    const adhesive_state now = adhesive_at(jkr, stiffness, root, inverse_radius, pull, a);
    const lanes eta = constants->value[HERTZ_DAMPING] * lanes_root(m->reduced_mass * stiffness * a);
    const lanes normal = lanes_keep(holds, lanes_at_least(now.force + eta * m->dashpot_approach, -pull));
    const lanes adhesion = lanes_keep(holds, (jkr ? 2.0 : 1.0) * pull), load = normal + adhesion;
    const lanes damping = normal - now.force, tangential_stiffness = constants->value[HERTZ_TANGENTIAL] * a;

    slider_memory slipped =
        remembered(dimension, m, before, before->value, dimension == 2 ? before->value + 3 : before->last + 1);
    const lanes kept = kept_displacement(springs, before, tangential_stiffness);
    const slider slip = advance_slider(springs, count, &slipped, kept, m->slip, m->dashpot_slip, settings->step,
                                       tangential_stiffness, eta, constants->value[SCREE_FRICTION] * load, holds);
    const vector displacement = slip.now.displacement, dashpot = slip.now.dashpot;
    lanes damping_before = before->value[2];
    *after = (law_memory){.value = {displacement.x, tangential_stiffness, damping, dashpot.x}};
    if (dimension == 3) {
        damping_before = before->last[0];
        *after = (law_memory){.value = {displacement.x, displacement.y, displacement.z, tangential_stiffness},
                              .last = {damping, dashpot.x, dashpot.y, dashpot.z}};
    }
    const lanes way = m->approach * settings->step;
    const adhesive_state last = adhesive_at(jkr, stiffness, root, inverse_radius, pull, a_before);
    const lanes lost = adhesive_snap(&now, &last, a, a_before, m->overlap, way);
    law_force f = {
        .normal = normal,
        .tangential = vector_opposite(count, slip.resistance),
        .couple = vector_none(),
        .damping = 0.5 * ((damping + damping_before) * way + slip.damping + lost),
        .friction = 0.5 * slip.friction,
        .stiffness = 0.5 * slip.stiffness,
        .elastic_normal = now.energy,
        .elastic_tangential = slip.elastic,
        .adhesion = adhesion,
        .in_contact = holds,
    };
    if (v.option & ADHESIVE_CONSTANT) resist_constantly(springs, constants, m, settings->step, load, before, after, &f);
    if (v.option & ADHESIVE_ROLLING)
        resist_turning(springs, constants, m, settings->step, tangential_stiffness, eta, load, holds, before, after,
                       &f);
    return f;
}

#endif
