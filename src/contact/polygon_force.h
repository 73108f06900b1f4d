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
/// Ledger: damping and friction as of `linear`; `stiffness` is what the elastic force gave that is not stored:
///   W(n) - W(n-1) - (f_e(n-1) + f_e(n))/2 a dt
/// of the energy W that the law says the contact has. Where f_e is its gradient that is of third order in the step, and
/// not accumulated.
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

#define POLYGON_TRAITS                                                                                                 \
    {                                                                                                                  \
        .remembers = true, .for_ledger = {0x6, 0x6}, .keeps_last_force = {true, true}, .displacement = true,           \
        .wide = true, .areas = true                                                                                    \
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
    const lanes way = m->approach * settings->step;
    return (law_force){
        .normal = normal,
        .tangential = vector_opposite(1, slip.resistance),
        .couple = vector_none(),
        .damping = half * ((damping + before->last[0]) * way + slip.damping),
        .friction = half * slip.friction,
        .stiffness = stored - before->value[2] - half * (elastic + before->value[1]) * way,
        .elastic_normal = stored,
        .elastic_tangential = slip.elastic,
    };
}

#endif
