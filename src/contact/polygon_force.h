/// What the laws of polygons share: keys of a material, constants of a pair, the dashpots, the tangential spring, the
/// ledger of a step (polygon_overlap.h, polygon_potential.h).
///
/// With the elastic force f_e along the normal, of depth d = A / l and its rate d' = c a / l (a: the approach at the
/// point, c: the chord; R 2.34 from the geometry and not from a difference):
///   normal      f_n = f_e + max(gamma sqrt(E m_perp) d', -f_e)                               R 2.29, 2.32, 2.35
///   tangential  h <- h + s dt, |k_t h| <= mu f_n; f_t = -(k_t h + eta sqrt(k_t m_par) s), |f_t| <= mu f_n
///               k_t = 2/7 E, eta = 1; m_par with the inertias of both bodies                 R 2.36 - 2.39
/// R 2.39 keeps the viscous part within what is accumulated; here the spring alone is kept and capped, then the sum
/// (slider.h), and slip has the sign with which a rigid rotation of the pair gives none. E is young_modulus times the
/// thickness [N/m]: R's modulus of the plane. Static and dynamic friction are one; there is no cohesion.
///
/// Ledger. In a leapfrog scheme the forces of n - 1 and n have each done half of their power at v(n - 1/2) times dt,
/// each along its normal and at its point. A chord may jump where an edge turns through parallel, so neither is taken
/// from the rates of the middle of the step: the contact remembers normal and lever of its last force, and with the
/// ways a', s' of n - 1 and a, s of n the work on dashpots is (g(n-1) a' + g(n) a)/2, and `stiffness` is what the
/// forces gave that is not stored or dissipated,
///   W(n) - W(n-1) - (f_e(n-1) a' + f_e(n) a)/2,
/// of the energy W that the law says the contact has, and the same of the tangential force, third order in the step.
/// Then the balance closes to round-off. Where f_e is the gradient of W it is the error of the step alone, and not
/// accumulated.
#ifndef SCREE_CONTACT_POLYGON_FORCE_H
#define SCREE_CONTACT_POLYGON_FORCE_H

#include "contact/law.h"
#include "contact/slider.h"
#include "model/law.h"

/// Constants of a pair, beside SCREE_FRICTION.
enum {
    POLYGON_STIFFNESS = 0,  ///< N/m, E
    POLYGON_TANGENTIAL = 1, ///< N/m, k_t
    POLYGON_DAMPING = 3,    ///< 1, gamma
    POLYGON_VISCOSITY = 4,  ///< 1, eta
};

/// What a case says of a material.
typedef struct scree_polygon_material {
    double damping_constant;     ///< 1, gamma
    double tangential_share;     ///< 1, k_t over E
    double tangential_viscosity; ///< 1, eta
} scree_polygon_material;

/// Numbers of the history: the stretch of the tangential spring, elastic force and energy of the last step, the
/// direction of its force.
enum { POLYGON_ENERGY = 2 };

#define POLYGON_TRAITS                                                                                                 \
    {                                                                                                                  \
        .keeps_last_force = {true, true}, .displacement = true, .wide = true, .areas = true,                           \
        .energy_at = POLYGON_ENERGY                                                                                    \
    }

/// What a direction is kept as, one number in -2 .. 2: the way round the square |x| + |y| = 1 from (1, 0), which needs
/// no function but a division.
SCREE_INLINE lanes direction_fold(vector n)
{
    return lanes_with_sign(1.0 - n.x / (lanes_abs(n.x) + lanes_abs(n.y)), n.y);
}

SCREE_INLINE vector direction_unfold(lanes kept)
{
    const lanes x = 1.0 - lanes_abs(kept), y = lanes_with_sign(1.0 - lanes_abs(x), kept);
    const lanes inverse = 1.0 / lanes_root(x * x + y * y);
    return (vector){x * inverse, y * inverse, x};
}

/// The pose at which the force of now acts: normal and lever of the first body.
SCREE_INLINE void polygon_remember(const kinematics *m, lanes_bits touching, law_memory *after)
{
    after->value[3] = lanes_keep(touching, direction_fold(m->normal));
    after->last[2] = lanes_keep(touching, m->lever_first.x);
    after->last[3] = lanes_keep(touching, m->lever_first.y);
}

/// How far the bodies move along a force and its tangent in the step, at the pose at which it acts [m].
typedef struct polygon_ways {
    lanes approach, slip;
} polygon_ways;

SCREE_INLINE polygon_ways polygon_ways_at(const kinematics *m, vector n, vector first, vector second, double step)
{
    const lanes x = m->passing.x - m->spin_first * first.y + m->spin_second * second.y;
    const lanes y = m->passing.y + m->spin_first * first.x - m->spin_second * second.x;
    return (polygon_ways){-step * (x * n.x + y * n.y), step * (y * n.x - x * n.y)};
}

SCREE_INLINE polygon_ways polygon_ways_now(const kinematics *m, double step)
{
    return polygon_ways_at(m, m->normal, m->lever_first, m->lever_second, step);
}

SCREE_INLINE polygon_ways polygon_ways_last(const kinematics *m, const law_memory *before, double step)
{
    const vector first = {.x = before->last[2], .y = before->last[3]};
    const vector second = {.x = first.x + (m->lever_second.x - m->lever_first.x) - step * m->passing.x,
                           .y = first.y + (m->lever_second.y - m->lever_first.y) - step * m->passing.y};
    return polygon_ways_at(m, direction_unfold(before->value[3]), first, second, step);
}

/// The force of a contact whose elastic part is `elastic` [N] and whose energy is `stored` [J].
SCREE_INLINE law_force polygon_force(const law_constants *constants, const law_settings *settings, const kinematics *m,
                                     lanes_bits touching, lanes elastic, lanes stored, const law_memory *before,
                                     law_memory *after)
{
    const lanes *constant = constants->value, none = lanes_all(0), half = lanes_all(0.5);
    elastic = lanes_keep(touching, elastic);
    stored = lanes_keep(touching, stored);
    const lanes stiffness = lanes_keep(touching, constant[POLYGON_STIFFNESS]);
    const lanes tangential = lanes_keep(touching, constant[POLYGON_TANGENTIAL]);
    const lanes rate = m->chord / m->length * m->dashpot_approach;
    lanes damping = constant[POLYGON_DAMPING] * lanes_root(stiffness * m->reduced_mass) * rate;
    damping = lanes_at_least(damping, -elastic);
    const lanes normal = elastic + damping, cap = constant[SCREE_FRICTION] * normal;

    const slider_memory slipped = {
        {.x = before->value[0]}, {.x = constant[POLYGON_TANGENTIAL] * before->value[0]}, {.x = before->last[1]}};
    const lanes viscosity = constant[POLYGON_VISCOSITY] * lanes_root(tangential * m->reduced_mass_along);
    const slider slip =
        slider_move(1, &slipped, m->slip, m->dashpot_slip, settings->step, tangential, viscosity, cap, touching);
    *after = (law_memory){.value = {slip.now.displacement.x, elastic, stored, none},
                          .last = {damping, slip.now.dashpot.x, none, none}};
    polygon_remember(m, touching, after);
    const polygon_ways now = polygon_ways_now(m, settings->step), last = polygon_ways_last(m, before, settings->step);
    const lanes resisted = (slipped.spring.x + slipped.dashpot.x) * last.slip + slip.resistance.x * now.slip;
    const lanes spring = half * slipped.spring.x * slipped.displacement.x;
    const lanes tangential_work = half * (slip.damping + slip.friction) + slip.elastic - spring;
    return (law_force){
        .normal = normal,
        .tangential = vector_opposite(1, slip.resistance),
        .couple = vector_none(),
        .damping = half * (before->last[0] * last.approach + damping * now.approach + slip.damping),
        .friction = half * slip.friction,
        .stiffness = stored - before->value[POLYGON_ENERGY] -
                     half * (before->value[1] * last.approach + elastic * now.approach) +
                     (tangential_work - half * resisted),
        .elastic_normal = stored,
        .elastic_tangential = slip.elastic,
    };
}

#endif
