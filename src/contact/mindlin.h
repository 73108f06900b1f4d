/// Mindlin's springs with sliders and dashpots in the tangent plane, and resistance to rolling and twisting: what
/// hertz_mindlin and the laws that stick have in common (hertz_mindlin.h has the equations, slider.h the ledger).
#ifndef SCREE_CONTACT_MINDLIN_H
#define SCREE_CONTACT_MINDLIN_H

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

#endif
