/// Law hertz_mindlin: Hertz's normal force, Mindlin's tangential spring with history, Coulomb's cap, damping from the
/// coefficient of restitution (Hertz 1882; Mindlin 1949; Tsuji, Tanaka and Ishida 1992), and resistance to rolling and
/// twisting where materials have it (Luding 2008; Marshall 2009).
///   a = sqrt(R_eff d)   k_n = normal_stiffness a   eta = damping sqrt(m_eff k_n)   f_n = max(k_n d + eta d', 0)
///   k_t = tangential_stiffness a
///   slip      stretch h [m], rate s, stiffness k_t, dashpot eta, cap mu f_n:                       force f_t
///   rolling   stretch [m], rate R_eff (w_first - w_second) x n, k_t, eta, cap mu_r f_n: F_r, torque R_eff n x F_r
///   twisting  angle [rad], rate (w_first - w_second) . n, k_t a^2 / 2, eta a^2 / 2, cap mu_tw R_eff f_n: torque along
///   n
/// each a spring with a slider and a dashpot (slider.h); those of rolling and twisting may be constant torques in place
/// of it (MINDLIN_CONSTANT, constant_torque.h). Twisting is that of two plane surfaces of radius a that stick
/// (Marshall 2009, whose cap is 2/3 a mu f_n; here its own coefficient, as for rolling). The couples on the two bodies
/// are opposite.
///
/// When k_t changes with d, a spring keeps its displacement, or (MINDLIN_RESCALED; Thornton, Cummins and Cleary 2013,
/// eq. 18) its force while k_t grows and its displacement while k_t falls, h <- h min(1, k_t(n-1) / k_t(n)). The first
/// gives a spring that is stretched while k_t is small, and released while it is large, energy that nobody has spent: a
/// closed cycle of overlap and slip may deliver work. With the second no change of k_t ever adds energy. Rolling
/// springs have the same k_t; twisting ones, of k_t a^2 / 2, the cube of that factor.
///
/// LAMMPS' `pair granular hertz/material, tangential mindlin, damping tsuji` differs in sliding contacts: there the
/// spring is set to mu f_n - eta s, which in a fast slide stretches it backwards and charges it with energy that no
/// body has spent. It also leaves out that the spring turns with the pair about n.
///
/// In space the tangential displacement is kept in the axes of space and brought into the present tangent plane in each
/// step, with its length (kinematics_carry_whole): what the rotation of n leaves out is of second order in the angle of
/// one step, and only concerns the direction. Two bodies that turn at different rates about n take the spring along at
/// the mean.
///
/// Memory (the fields in hertz_mindlin.c): h, k_t(n - 1), and at n - 1 for the ledger the normal damping force and the
/// dashpot's part of the tangential force; of rolling the displacement and, in 3D, the angle of twist, and their
/// dashpots.
///
/// Ledger: damping <f_n - k_n d> d' dt with the rate of the middle of the step (kinematics.h), the rest by slider.h.
/// Cost: 3 roots, 3 divisions a contact in 2D; 3 and 2 in 3D, 5 and 4 in a group of lanes where one slides; rolling and
/// twisting 3 and 4 more; rescaled one division more.
#ifndef SCREE_CONTACT_HERTZ_MINDLIN_H
#define SCREE_CONTACT_HERTZ_MINDLIN_H

#include "contact/mindlin.h"

/// Resistance to turning looks materials up even if there is only one.
#define hertz_mindlin_KERNELS(row)                                                                                     \
    row(hertz_mindlin, 0, one) row(hertz_mindlin, 0, many) row(hertz_mindlin, 1, one) row(hertz_mindlin, 1, many)      \
        row(hertz_mindlin, 2, many) row(hertz_mindlin, 3, many) row(hertz_mindlin, 4, many)                            \
            row(hertz_mindlin, 5, many)

/// In 2D the history holds what the ledger reads, too.
#define MINDLIN_TRAITS(...)                                                                                            \
    {                                                                                                                  \
        .keeps_last_force = {false, true}, .displacement = true, __VA_ARGS__                                           \
    }
#define MINDLIN_TURNS .rolling = true, .wide = true
static const scree_law_traits hertz_mindlin_traits[] = {
    [0] = MINDLIN_TRAITS(),
    [MINDLIN_RESCALED] = MINDLIN_TRAITS(),
    [MINDLIN_ROLLING] = MINDLIN_TRAITS(MINDLIN_TURNS),
    [MINDLIN_ROLLING | MINDLIN_RESCALED] = MINDLIN_TRAITS(MINDLIN_TURNS),
    [MINDLIN_CONSTANT] = MINDLIN_TRAITS(MINDLIN_TURNS),
    [MINDLIN_CONSTANT | MINDLIN_RESCALED] = MINDLIN_TRAITS(MINDLIN_TURNS),
};

SCREE_INLINE law_force hertz_mindlin(variant v, const law_constants *constants, const law_settings *settings,
                                     const kinematics *m, lanes_bits touching, const law_memory *before,
                                     law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    lanes d = lanes_keep(touching, m->overlap);
    lanes contact_radius = lanes_root(m->reduced_radius * d);
    lanes normal_stiffness = constants->value[HERTZ_NORMAL] * contact_radius;
    lanes tangential_stiffness = constants->value[HERTZ_TANGENTIAL] * contact_radius;
    lanes eta = constants->value[HERTZ_DAMPING] * lanes_root(m->reduced_mass * normal_stiffness);
    lanes elastic = normal_stiffness * d;
    lanes normal = lanes_at_least(elastic + eta * m->dashpot_approach, lanes_all(0));
    lanes damping = normal - elastic;

    slider_memory slipped =
        remembered(dimension, m, before, before->value, dimension == 2 ? before->value + 3 : before->last + 1);
    lanes kept = kept_displacement(v, before, tangential_stiffness);
    slider slip = advance_slider(v, count, &slipped, kept, m->slip, m->dashpot_slip, settings->step,
                                 tangential_stiffness, eta, constants->value[SCREE_FRICTION] * normal, touching);
    vector tangential_displacement = slip.now.displacement, dashpot = slip.now.dashpot;
    lanes damping_before = before->value[2];
    *after = (law_memory){.value = {tangential_displacement.x, tangential_stiffness, damping, dashpot.x}};
    if (dimension == 3) {
        damping_before = before->last[0];
        *after = (law_memory){.value = {tangential_displacement.x, tangential_displacement.y, tangential_displacement.z,
                                        tangential_stiffness},
                              .last = {damping, dashpot.x, dashpot.y, dashpot.z}};
    }
    law_force f = {
        .normal = normal,
        .tangential = vector_opposite(count, slip.resistance),
        .couple = vector_none(),
        .damping = 0.5 * ((damping + damping_before) * (m->approach * settings->step) + slip.damping),
        .friction = 0.5 * slip.friction,
        .stiffness = 0.5 * slip.stiffness,
        .elastic_normal = 0.4 * (elastic * d),
        .elastic_tangential = slip.elastic,
    };
    if (v.option & MINDLIN_CONSTANT) resist_constantly(v, constants, m, settings->step, normal, before, after, &f);
    if (v.option & MINDLIN_ROLLING)
        resist_turning(v, constants, m, settings->step, tangential_stiffness, eta, normal, touching, before, after, &f);
    return f;
}

#endif
