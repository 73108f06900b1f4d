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

#include "contact/constant_torque.h"
#include "contact/hertz.h"
#include "contact/law.h"
#include "contact/slider.h"

/// Options.
enum {
    MINDLIN_RESCALED = 1, ///< springs that stiffen keep their force, not their displacement
    MINDLIN_ROLLING = 2,  ///< some pair of materials resists rolling or twisting, with springs
    MINDLIN_CONSTANT = 4, ///< the same with constant torques, in place of springs
};

typedef enum scree_tangential_history {
    SCREE_TANGENTIAL_DISPLACEMENT,
    SCREE_TANGENTIAL_RESCALED
} scree_tangential_history;

typedef enum scree_rolling_resistance { SCREE_ROLLING_SPRINGS, SCREE_ROLLING_CONSTANT } scree_rolling_resistance;

/// What a case says of it, under `contact` and of a material.
typedef struct scree_mindlin_config {
    int tangential_history; ///< scree_tangential_history
    int rolling_resistance; ///< scree_rolling_resistance
} scree_mindlin_config;

typedef struct scree_mindlin_material {
    double restitution;       ///< 1
    double rolling_friction;  ///< 1, limit of the rolling resistance over the normal force
    double twisting_friction; ///< 1, in 3D: limit of the twisting torque over R_eff times that force
} scree_mindlin_material;

/// Resistance to turning looks materials up even if there is only one.
#define hertz_mindlin_KERNELS(row)                                                                                     \
    row(hertz_mindlin, 0, one) row(hertz_mindlin, 0, many) row(hertz_mindlin, 1, one) row(hertz_mindlin, 1, many)      \
        row(hertz_mindlin, 2, many) row(hertz_mindlin, 3, many) row(hertz_mindlin, 4, many)                            \
            row(hertz_mindlin, 5, many)

/// In 2D the history holds what the ledger reads, too; k_t is for the ledger alone where springs are not rescaled.
#define MINDLIN_TRAITS(ledger_2d, ledger_3d, ...)                                                                      \
    {                                                                                                                  \
        .remembers = true, .for_ledger = {ledger_2d, ledger_3d}, .keeps_last_force = {false, true},                    \
        .displacement = true, __VA_ARGS__                                                                              \
    }
#define MINDLIN_TURNS .rolling = true, .wide = true
static const scree_law_traits hertz_mindlin_traits[] = {
    [0] = MINDLIN_TRAITS(0xe, 0x8),
    [MINDLIN_RESCALED] = MINDLIN_TRAITS(0xc, 0),
    [MINDLIN_ROLLING] = MINDLIN_TRAITS(0xe, 0x8, MINDLIN_TURNS),
    [MINDLIN_ROLLING | MINDLIN_RESCALED] = MINDLIN_TRAITS(0xc, 0, MINDLIN_TURNS),
    [MINDLIN_CONSTANT] = MINDLIN_TRAITS(0xe, 0x8, MINDLIN_TURNS),
    [MINDLIN_CONSTANT | MINDLIN_RESCALED] = MINDLIN_TRAITS(0xc, 0, MINDLIN_TURNS),
};

SCREE_INLINE bool is_rescaled(variant v)
{
    return v.option & MINDLIN_RESCALED;
}

/// Three values of a row, one after the other.
SCREE_INLINE vector row_vector(const lanes value[3])
{
    return (vector){value[0], value[1], value[2]};
}

/// k_t at n - 1.
SCREE_INLINE lanes stiffness_before(int dimension, const law_memory *before)
{
    return before->value[dimension == 2 ? 1 : 3];
}

/// What a slider of stiffness k_t remembers, from the rows of its displacement and of its dashpot.
SCREE_INLINE slider_memory remembered(int dimension, const kinematics *m, const law_memory *before,
                                      const lanes displacement[3], const lanes dashpot[3])
{
    const lanes stiffness = stiffness_before(dimension, before);
    if (dimension == 2)
        return (slider_memory){{.x = displacement[0]}, {.x = displacement[0] * stiffness}, {.x = dashpot[0]}};
    vector tangential_displacement = kinematics_carry_whole(3, m, row_vector(displacement));
    return (slider_memory){tangential_displacement, vector_times(3, tangential_displacement, stiffness),
                           kinematics_carry(3, m, row_vector(dashpot))};
}

/// min(1, k_t(n-1) / k_t): what stiffening springs keep of their displacement. 1 where nothing touches.
SCREE_INLINE lanes kept_displacement(variant v, const law_memory *before, lanes tangential_stiffness)
{
    if (!is_rescaled(v)) return lanes_all(1);
    return lanes_at_most(lanes_all(1), stiffness_before(v.dimension, before) / tangential_stiffness);
}

/// slider_move, of a displacement of which `kept` is left where springs are rescaled.
SCREE_INLINE slider advance_slider(variant v, int count, slider_memory *before, lanes kept, vector rate,
                                   vector dashpot_rate, double step, lanes stiffness, lanes viscosity, lanes cap,
                                   lanes_bits touching)
{
    lanes lost = lanes_all(0);
    if (is_rescaled(v)) lost = slider_rescale(count, before, kept);
    slider s = slider_move(count, before, rate, dashpot_rate, step, stiffness, viscosity, cap, touching);
    if (is_rescaled(v)) s.stiffness = s.stiffness - lost;
    return s;
}

/// Adds a slider's energies to those of the contact.
SCREE_INLINE void slider_work(law_force *f, const slider *s)
{
    f->damping += 0.5 * s->damping;
    f->friction += 0.5 * s->friction;
    f->stiffness += 0.5 * s->stiffness;
    f->elastic_tangential += s->elastic;
}

/// Couple and energy of constant torques; what they remember stands in the rows of rolling.
SCREE_INLINE void resist_constantly(variant v, const law_constants *constants, const kinematics *m, double step,
                                    lanes normal, const law_memory *before, law_memory *after, law_force *f)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    const lanes eta = constant_torque_viscosity(dimension, m->reduced_mass, step);
    const vector rolled =
        dimension == 2 ? (vector){.x = before->rolling[0]} : kinematics_carry(3, m, row_vector(before->rolling));
    const constant_torque roll = constant_torque_resist(count, rolled, m->roll, m->dashpot_roll, step, eta,
                                                        constants->value[HERTZ_ROLLING] * normal);
    f->couple = vector_times(count, moment_of(dimension, m->normal, roll.resistance), -m->reduced_radius);
    f->friction += 0.5 * roll.friction;
    after->rolling[0] = roll.resistance.x;
    if (dimension == 2) return;
    const constant_torque twist = constant_torque_resist(
        1, (vector){.x = before->rolling[3]}, (vector){.x = m->twist}, (vector){.x = m->dashpot_twist}, step,
        eta * (m->reduced_radius * m->reduced_radius), constants->value[HERTZ_TWISTING] * m->reduced_radius * normal);
    f->couple = vector_minus(3, f->couple, vector_times(3, m->normal, twist.resistance.x));
    f->friction += 0.5 * twist.friction;
    after->rolling[1] = roll.resistance.y, after->rolling[2] = roll.resistance.z;
    after->rolling[3] = twist.resistance.x;
}

/// Couple and energies of rolling and twisting resistance by springs.
SCREE_INLINE void resist_turning(variant v, const law_constants *constants, const kinematics *m, double step,
                                 lanes tangential_stiffness, lanes eta, lanes normal, lanes_bits touching,
                                 const law_memory *before, law_memory *after, law_force *f)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    lanes kept = kept_displacement(v, before, tangential_stiffness);
    slider_memory rolled = remembered(dimension, m, before, before->rolling, before->rolling_last);
    slider roll = advance_slider(v, count, &rolled, kept, m->roll, m->dashpot_roll, step, tangential_stiffness, eta,
                                 constants->value[HERTZ_ROLLING] * normal, touching);
    f->couple = vector_times(count, moment_of(dimension, m->normal, roll.resistance), -m->reduced_radius);
    slider_work(f, &roll);
    if (dimension == 2) {
        after->rolling[0] = roll.now.displacement.x;
        after->rolling_last[0] = roll.now.dashpot.x;
        return;
    }
    // a^2 / 2 at n - 1 from k_t = tangential_stiffness a.
    lanes radius = tangential_stiffness / constants->value[HERTZ_TANGENTIAL], half_square = 0.5 * (radius * radius);
    lanes radius_before = before->value[3] / constants->value[HERTZ_TANGENTIAL];
    lanes twisting_before = before->value[3] * (0.5 * (radius_before * radius_before));
    slider_memory twisted = {
        {.x = before->rolling[3]}, {.x = twisting_before * before->rolling[3]}, {.x = before->rolling_last[3]}};
    slider twist =
        advance_slider(v, 1, &twisted, kept * kept * kept, (vector){.x = m->twist}, (vector){.x = m->dashpot_twist},
                       step, tangential_stiffness * half_square, eta * half_square,
                       constants->value[HERTZ_TWISTING] * m->reduced_radius * normal, touching);
    f->couple = vector_minus(3, f->couple, vector_times(3, m->normal, twist.resistance.x));
    slider_work(f, &twist);
    vector tangential_displacement = roll.now.displacement, dashpot = roll.now.dashpot;
    lanes *value = after->rolling, *last = after->rolling_last;
    value[0] = tangential_displacement.x, value[1] = tangential_displacement.y, value[2] = tangential_displacement.z,
    value[3] = twist.now.displacement.x;
    last[0] = dashpot.x, last[1] = dashpot.y, last[2] = dashpot.z, last[3] = twist.now.dashpot.x;
}

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
