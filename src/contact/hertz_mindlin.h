/// Law hertz_mindlin: Hertz's normal force, Mindlin's tangential spring with history, Coulomb's cap, damping from the
/// coefficient of restitution (Hertz 1882; Mindlin 1949; Tsuji, Tanaka and Ishida 1992; displacement history without
/// rescaling).
///   a = sqrt(R_eff d)   k_n = normal_stiffness a   eta = damping sqrt(m_eff k_n)   f_n = max(k_n d + eta d', 0)
///   k_t = tangential_stiffness a   h <- h + s dt, |k_t h| <= mu f_n   f_t = -(k_t h + eta s), |f_t| <= mu f_n
/// The spring alone is kept in the history and capped, then the sum with the dashpot: a sliding spring stretches no
/// further. LAMMPS' `pair granular hertz/material, tangential mindlin, damping tsuji` differs in sliding contacts only:
/// there the spring is set to mu f_n - eta s, which in a fast slide stretches it backwards and charges it with energy
/// that no body has spent.
///
/// History row: h [m], and at n - 1 for the ledger: spring force k_t h, normal damping force, dashpot's part of the
/// tangential force [N].
///
/// Ledger, with middle increments delta and sigma (motion.h) and mean forces <f> = (f(n-1) + f(n))/2:
///   damping    <f_n - k_n d> delta + <f_t - k_t h> sigma
///   friction   <k_t h> (s dt - (h(n) - h(n-1)))           zero while the contact sticks
///   stiffness  1/2 (k_t(n) - k_t(n-1)) h(n) h(n-1) - <k_t h> (sigma - s dt)
/// The work done on the spring, <k_t h> sigma, minus the change of its energy 1/2 k_t h^2 is friction - stiffness,
/// exactly. Where a contact has opened, forces and h at n are zero: the same lines book what the spring still held as
/// friction.
/// Cost: 3 roots, 3 divisions a contact.
#ifndef SCREE_CONTACT_HERTZ_MINDLIN_H
#define SCREE_CONTACT_HERTZ_MINDLIN_H

#include "contact/law.h"

SCREE_INLINE law_force hertz_mindlin(const law_constants *constants, const law_settings *settings, const motion *m,
                                     lanes_bits touching, const law_memory *before, law_memory *after)
{
    lanes d = lanes_keep(touching, m->indentation);
    lanes contact_radius = lanes_root(m->reduced_radius * d);
    lanes normal_stiffness = constants->normal_stiffness * contact_radius;
    lanes tangential_stiffness = constants->tangential_stiffness * contact_radius;
    lanes eta = constants->damping * lanes_root(m->reduced_mass * normal_stiffness);
    lanes elastic = normal_stiffness * d;
    lanes normal = lanes_at_least(elastic + eta * m->approach, lanes_all(0));

    lanes slip_step = m->slip * settings->step;
    lanes stretch = before->value[0] + slip_step;
    lanes trial = tangential_stiffness * stretch, cap = constants->friction * normal;
    lanes spring = lanes_at_least(lanes_at_most(trial, cap), -cap);
    lanes resistance = lanes_at_least(lanes_at_most(spring + eta * m->slip, cap), -cap);
    stretch = lanes_keep(touching, lanes_select(lanes_differ(spring, trial), spring / tangential_stiffness, stretch));

    *after = (law_memory){{stretch, spring, normal - elastic, resistance - spring}};
    lanes mean_spring = 0.5 * (spring + before->value[1]);
    lanes mean_damping = 0.5 * (after->value[2] + before->value[2]);
    lanes mean_dashpot = 0.5 * (after->value[3] + before->value[3]);
    return (law_force){
        .normal = normal,
        .tangential = -resistance,
        .damping = mean_damping * m->approached + mean_dashpot * m->slipped,
        .friction = mean_spring * (slip_step - (stretch - before->value[0])),
        .stiffness =
            0.5 * (spring * before->value[0] - before->value[1] * stretch) - mean_spring * (m->slipped - slip_step),
        .elastic_normal = 0.4 * (elastic * d),
        .elastic_tangential = 0.5 * (spring * stretch),
    };
}

#endif
