/// Law linear: springs of constant stiffness along the normal and in the tangent plane, each with a dashpot beside it,
/// and Coulomb's cap (Madan 2019, "M", 2.20-2.40 without bonds; Cundall and Strack 1979).
///   k_n = the pair's own, or E A / L    c_n = 2 z_n sqrt(m_eff k_n)    f_n = max(k_n d + c_n d', 0)      M 2.25-2.37
///   k_t = ratio k_n                     c_t = 2 z_t sqrt(m_eff k_t)                                      M 2.27-2.37
///   stretch h [m], rate s:  h <- h + s dt, |k_t h| <= mu f_n,  f_t = -(k_t h + c_t s), |f_t| <= mu f_n   M 2.40
/// (slider.h). M prints d' with the opposite sign (his overlap is negative). A contact without a bond presses only: M's
/// text at 2.40, and the max here also while a dashpot would pull the parting bodies back.
///
/// Held (LINEAR_HELD, pairs of the persistent list): the spring pulls, too, is at rest at the overlap d_0 of the pair,
/// and neither it nor the tangential one slides (M 2.23-2.28):
///   f_n = k_n (d - d_0) + c_n d',   f_t = -(k_t h + c_t s)
/// It stands until -f_n >= S_n (M 2.38) or |f_t| >= max(S_t + q f_n, 0) (M 2.39; q: the slope of Mohr and Coulomb); the
/// law only says so (settle), bond/ breaks it. A broken one is a contact without a bond, with d - d_0 in place of d,
/// until d <= min(0, d_0): then an ordinary one has no force either.
///
/// E A / L: the bar from centre to centre, L = R_1 + R_2. Of discs of thickness t, A = t (R_1 + R_2), so k_n = E t
/// whatever the radii; of spheres A = pi R_1 R_2, so k_n = pi E R_eff: for equal bodies the section through the centre.
///
/// Memory (the fields in linear.c): h, and for the ledger, at n - 1, the normal damping force and the dashpot's part of
/// the tangential force.
///
/// Ledger: damping <f_n - k_n d> d' dt with the rate of the middle of the step (kinematics.h), the rest by slider.h.
/// k_t does not change, so springs are given no energy: `stiffness` is zero. Limits: the dashpot jumps to c_n v where
/// an impact begins, so a damped impact is of first order in the step. Cost: one root, one division a contact in 2D;
/// one and one in 3D, 3 and 2 in a group of lanes where one slides.
#ifndef SCREE_CONTACT_LINEAR_H
#define SCREE_CONTACT_LINEAR_H

#include "contact/law.h"
#include "contact/slider.h"
#include "model/law.h"

/// Options.
enum { LINEAR_HELD = 1, LINEAR_DEFORMS = 2 };

/// Bodies that deform: how strains go into the law, and what of it their ledger does not get from the slider and the
/// contact, per step: strains take up f_t . w dt of the spreading w, the slider only where slip has w in it.
typedef struct linear_strained {
    vector slip;         ///< m/s
    vector dashpot_slip; ///< m/s
    lanes rate;          ///< m/s, along the normal, that the dashpot dissipates with
    double loose, corrected;
} linear_strained;

SCREE_INLINE linear_strained linear_strain(variant v, const law_settings *settings, const kinematics *m)
{
    const int count = tangential_count(v.dimension);
    if (!(v.option & LINEAR_DEFORMS))
        return (linear_strained){.slip = m->slip, .dashpot_slip = m->dashpot_slip, .rate = m->approach};
    linear_strained s = {.loose = settings->number[SCREE_LAW_LOOSE],
                         .corrected = settings->number[SCREE_LAW_CORRECTED]};
    s.slip = vector_plus(count, m->slip, vector_times(count, m->spreading, lanes_all(s.corrected)));
    // Dashpots feel the bodies alone, as that along the normal does: strains lag, and a lagged rate over the step makes
    // the iteration of forces grow the faster the smaller the step.
    s.dashpot_slip = m->dashpot_slip;
    s.rate = m->approach + (1 - s.loose) * m->expanding;
    return s;
}

/// Twice the energy [J] that nobody has given in a step: what strains take up by tangential forces (M's form has no
/// potential), and what the spring takes up, from `elastic` on at n - 1, since the normal has turned past them.
SCREE_INLINE lanes linear_unpaid(variant v, const linear_strained *s, const slider *slip, const slider_memory *before,
                                 const kinematics *m, lanes elastic, lanes stiffness, lanes_bits pulls, double step)
{
    const int count = tangential_count(v.dimension);
    if (!(v.option & LINEAR_DEFORMS)) return lanes_all(0);
    lanes elastic_before = elastic - stiffness * ((m->approach + m->expanding) * step + m->turning);
    elastic_before = lanes_select(pulls, elastic_before, lanes_at_least(elastic_before, lanes_all(0)));
    vector springs = vector_plus(count, slip->now.spring, before->spring);
    vector dashpots = vector_plus(count, slip->now.dashpot, before->dashpot);
    vector unpaid = vector_plus(count, vector_times(count, springs, lanes_all(s->corrected - 1)),
                                vector_times(count, dashpots, lanes_all(s->corrected - 1 + s->loose)));
    return vector_dot(count, unpaid, vector_times(count, m->spreading, lanes_all(step))) +
           (elastic + elastic_before) * m->turning;
}

/// Constants of a pair, beside SCREE_FRICTION.
enum {
    LINEAR_NORMAL = 0,             ///< N/m; k_n = normal + by_radius R_eff
    LINEAR_RATIO = 1,              ///< 1, k_t / k_n
    LINEAR_DAMPING = 3,            ///< 1, c_n = damping sqrt(m_eff k_n)
    LINEAR_BY_RADIUS = 4,          ///< N/m2
    LINEAR_TANGENTIAL_DAMPING = 5, ///< 1, c_t = tangential_damping sqrt(m_eff k_n)
    LINEAR_INVERSE_RATIO = 6,      ///< 1, 0 without a tangential spring; for bounds
};

/// What a case says of a material. Not numbers: auto.
typedef struct scree_linear_material {
    double restitution;              ///< 1, where there is no damping ratio
    double normal_stiffness;         ///< N/m, on its like; auto: E A / L
    double tangential_stiffness;     ///< N/m, on its like; auto: by the ratio
    double stiffness_ratio;          ///< 1; auto: 1
    double damping_ratio;            ///< 1, of the normal dashpot; auto: of the restitution
    double tangential_damping_ratio; ///< 1; auto: the normal one
} scree_linear_material;

#define linear_KERNELS(row)                                                                                            \
    row(linear, 0, one) row(linear, 0, many) row(linear, 1, many) row(linear, 2, one) row(linear, 2, many)             \
        row(linear, 3, one) row(linear, 3, many)

#define LINEAR_TRAITS(...)                                                                                             \
    {                                                                                                                  \
        .keeps_last_force = {false, true}, .displacement = true, .wide = true, __VA_ARGS__                             \
    }
static const scree_law_traits linear_traits[] = {
    [0] = LINEAR_TRAITS(),
    [LINEAR_HELD] = LINEAR_TRAITS(.pulls = true, .holds = true),
    [LINEAR_DEFORMS] = LINEAR_TRAITS(.deforms = true),
    [LINEAR_HELD | LINEAR_DEFORMS] = LINEAR_TRAITS(.pulls = true, .holds = true, .deforms = true),
};

/// What the slider remembers; a spring that has lost its contact still holds what it held.
SCREE_INLINE slider_memory linear_remembered(int dimension, const kinematics *m, const law_memory *before,
                                             lanes tangential_stiffness)
{
    if (dimension == 2) {
        lanes spring = tangential_stiffness * before->value[0];
        return (slider_memory){{.x = before->value[0]}, {.x = spring}, {.x = before->value[2]}};
    }
    vector displacement = {before->value[0], before->value[1], before->value[2]};
    vector dashpot = {before->last[0], before->last[1], before->last[2]};
    vector tangential_displacement = kinematics_carry_whole(3, m, displacement);
    return (slider_memory){tangential_displacement, vector_times(3, tangential_displacement, tangential_stiffness),
                           kinematics_carry(3, m, dashpot)};
}

/// Lanes whose bond is not broken.
SCREE_INLINE lanes_bits linear_sound(const law_constants *constants)
{
    return lanes_at_or_below(lanes_all(0), constants->own[SCREE_MEMBER_TENSION]);
}

/// Lanes whose bond breaks, or is broken and the two have parted.
SCREE_INLINE lanes_bits linear_settle(int count, const lanes own[], lanes overlap, lanes_bits sound, lanes normal,
                                      vector tangential)
{
    lanes limit = lanes_at_least(own[SCREE_MEMBER_SHEAR] + own[SCREE_MEMBER_SLOPE] * normal, lanes_all(0));
    lanes_bits pulled = lanes_at_or_below(own[SCREE_MEMBER_TENSION], -normal);
    lanes_bits sheared = lanes_at_or_below(limit * limit, vector_dot(count, tangential, tangential));
    lanes_bits parted = lanes_at_or_below(overlap, lanes_at_most(own[SCREE_MEMBER_REST], lanes_all(0)));
    return (sound & (pulled | sheared)) | (~sound & parted);
}

SCREE_INLINE law_force linear(variant v, const law_constants *constants, const law_settings *settings,
                              const kinematics *m, lanes_bits touching, const law_memory *before, law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    const lanes *constant = constants->value, none = lanes_all(0);
    const bool held = v.option & LINEAR_HELD;
    const lanes_bits present = touching, sound = held ? linear_sound(constants) : lanes_as_bits(none);
    lanes from_rest = held ? m->overlap - constants->own[SCREE_MEMBER_REST] : m->overlap;
    if (held) touching &= sound | ~lanes_at_or_below(from_rest, none);
    lanes d = lanes_keep(touching, from_rest);
    lanes whole = constant[LINEAR_NORMAL] + constant[LINEAR_BY_RADIUS] * m->reduced_radius;
    lanes stiffness = lanes_keep(touching, whole);
    lanes root = lanes_root(m->reduced_mass * stiffness);
    lanes elastic = stiffness * d;
    lanes normal = elastic + constant[LINEAR_DAMPING] * root * m->dashpot_approach;
    normal = lanes_select(sound, normal, lanes_at_least(normal, none));
    lanes cap = lanes_select(sound, lanes_all(INFINITY), constant[SCREE_FRICTION] * normal);
    lanes damping = normal - elastic, damping_before = before->value[dimension == 2 ? 1 : 3];

    const linear_strained strained = linear_strain(v, settings, m);
    slider_memory slipped = linear_remembered(dimension, m, before, constant[LINEAR_RATIO] * whole);
    slider slip =
        slider_move(count, &slipped, strained.slip, strained.dashpot_slip, settings->step,
                    constant[LINEAR_RATIO] * stiffness, constant[LINEAR_TANGENTIAL_DAMPING] * root, cap, touching);
    vector tangential_displacement = slip.now.displacement, dashpot = slip.now.dashpot;
    *after = (law_memory){.value = {tangential_displacement.x, damping, dashpot.x, none}};
    if (dimension == 3)
        *after = (law_memory){
            .value = {tangential_displacement.x, tangential_displacement.y, tangential_displacement.z, damping},
            .last = {dashpot.x, dashpot.y, dashpot.z, none}};
    law_force force = {
        .normal = normal,
        .tangential = vector_opposite(count, slip.resistance),
        .couple = vector_none(),
        .damping = 0.5 * ((damping + damping_before) * (strained.rate * settings->step) + slip.damping),
        .loose_normal = strained.loose * damping,
        .loose = vector_times(count, dashpot, lanes_all(-strained.loose)),
        .friction = 0.5 * slip.friction,
        .stiffness = 0.5 * linear_unpaid(v, &strained, &slip, &slipped, m, elastic, stiffness, sound, settings->step),
        .elastic_normal = 0.5 * (elastic * d),
        .elastic_tangential = slip.elastic,
    };
    if (held) {
        force.deformation = lanes_at_least(lanes_abs(d), vector_extent(count, tangential_displacement));
        force.in_contact = touching;
        force.settle = present & linear_settle(count, constants->own, m->overlap, sound, normal, force.tangential);
    }
    return force;
}

#endif
