/// From the motion at a contact to what is summed: forces and torques on both bodies and ledger increments as integers.
/// Shared by the scalar reference, the walls and the vector kernels.
#ifndef SCREE_CONTACT_EVALUATE_H
#define SCREE_CONTACT_EVALUATE_H

#include "contact/geometry.h"
#include "contact/job.h"
#include "contact/laws.h"

/// A vector in quanta; one component or two are zero where there are fewer (vector.h).
typedef struct quanta {
    lanes_bits x, y, z;
} quanta;

/// Contributions of one contact a lane, in quanta. The force on second is the opposite of that on first.
typedef struct contact_quanta {
    quanta force, torque_first, torque_second;
    lanes_bits count;                        ///< 1 where touching
    lanes_bits damping, friction, stiffness; ///< of the ledger
    lanes_bits in_range;                     ///< mask: the force is a number below the limit
    lanes_bits normal;                       ///< the same force along n
    quanta tangential;                       ///< and in the tangent plane (2D: along t)
    lanes deformation;                       ///< m, with law_holds
    vector straining;  ///< N, on first, what moments are of: the force before it became integers, or a part of it
    lanes_bits settle; ///< mask, with law_holds
} contact_quanta;

SCREE_INLINE quanta quanta_of(int count, vector v, double inverse_quantum)
{
    const lanes_bits none = lanes_as_bits(lanes_all(0));
    quanta q = {lanes_fixed(v.x, inverse_quantum), none, none};
    if (count > 1) q.y = lanes_fixed(v.y, inverse_quantum);
    if (count > 2) q.z = lanes_fixed(v.z, inverse_quantum);
    return q;
}

SCREE_INLINE quanta quanta_sum(quanta a, quanta b)
{
    return (quanta){a.x + b.x, a.y + b.y, a.z + b.z};
}

SCREE_INLINE quanta quanta_opposite(quanta a)
{
    return (quanta){-a.x, -a.y, -a.z};
}

/// f_n n + f_t.
SCREE_INLINE vector force_on_first(int dimension, const law_force *f, vector n)
{
    if (dimension == 2)
        return (vector){.x = f->normal * n.x - f->tangential.x * n.y, .y = f->normal * n.y + f->tangential.x * n.x};
    return vector_plus(3, vector_times(3, n, f->normal), f->tangential);
}

/// The part of it that does not strain the bodies.
SCREE_INLINE vector dashpot_on_first(int dimension, const law_force *f, vector n)
{
    const law_force part = {.normal = f->loose_normal, .tangential = f->loose};
    return force_on_first(dimension, &part, n);
}

/// -a n x f_t, for both bodies.
SCREE_INLINE quanta torque_on(int dimension, vector moment, lanes arm, const contact_scale *scale)
{
    const int count = tangential_count(dimension);
    lanes factor = arm * -scale->inverse_torque;
    return quanta_of(count, vector_times(count, moment, factor), 1);
}

/// l x f of a lever, of the first body; of the second with `sign` -1.
SCREE_INLINE quanta torque_of_lever(int dimension, vector lever, vector force, double sign, const contact_scale *scale)
{
    const int count = tangential_count(dimension);
    const vector torque = lever_cross(dimension, lever, force);
    return quanta_of(count, vector_times(count, torque, lanes_all(sign * scale->inverse_torque)), 1);
}

/// Where the force on one body acts: its branch, from its centre to that point, is -arm along; force and branch of the
/// second body both have the other sign.
typedef struct contact_branch {
    vector along;
    lanes arm; ///< m
} contact_branch;

SCREE_INLINE contact_branch contact_branch_of(variant v, const kinematics *m, bool first)
{
    if (geometry_has_levers(v))
        return (contact_branch){first ? m->lever_first : m->lever_second, lanes_all(first ? -1 : 1)};
    return (contact_branch){m->normal, first ? m->arm_first : m->arm_second};
}

/// What along_i f_j of a branch is multiplied by to become quanta of a body's moment. The arm of bodies that deform is
/// the radius (M 2.41), and left out: it is one number of the body (scree_moment_unit), and both get the same integers.
SCREE_INLINE lanes contact_moment_factor(bool deforms, const contact_scale *scale, lanes arm)
{
    return deforms ? lanes_all(-scale->inverse_force) : arm * -scale->inverse_torque;
}

/// Branch (x) force of one body of a contact, d x d by rows.
SCREE_INLINE void contact_moments(int dimension, vector along, lanes factor, vector force, lanes_bits moment[9])
{
    const vector branch = vector_times(dimension, along, factor);
    const lanes s[3] = {branch.x, branch.y, branch.z}, f[3] = {force.x, force.y, force.z};
    for (int i = 0; i < dimension; i++)
        for (int j = 0; j < dimension; j++) moment[dimension * i + j] = lanes_fixed(s[i] * f[j], 1);
}

/// An increment of the ledger [J] in quanta; of laws of areas, whose bounds of energies are no strict ones, cut where
/// it would be no number any more.
SCREE_INLINE lanes_bits energy_quanta(variant v, lanes energy, double inverse_quantum)
{
    const lanes most = lanes_all(ldexp(1, SCREE_FIXED_RANGE_BITS) / inverse_quantum);
    if (law_traits(v)->areas) energy = lanes_at_most(lanes_at_least(energy, -most), most);
    return lanes_fixed(energy, inverse_quantum);
}

/// What the law says, as it acts on the bodies: g times as much where the overlap has a gain g.
SCREE_INLINE law_force contact_law(variant v, const law_constants *constants, const law_settings *settings,
                                   const kinematics *m, lanes_bits touching, const law_memory *before,
                                   law_memory *after)
{
    law_force f = law_evaluate(v, constants, settings, m, touching, before, after);
    if (!geometry_has_gains(v)) return f;
    const int count = tangential_count(v.dimension);
    f.normal *= m->gain;
    f.tangential = vector_times(count, f.tangential, m->gain);
    f.couple = vector_times(count, f.couple, m->gain);
    return f;
}

SCREE_INLINE contact_quanta contact_evaluate(variant v, const law_constants *constants, const law_settings *settings,
                                             const contact_scale *scale, const kinematics *m, lanes_bits touching,
                                             const law_memory *before, law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    const bool pulls = law_traits(v)->pulls;
    law_force f = contact_law(v, constants, settings, m, touching, before, after);
    vector moment = moment_of(dimension, m->normal, f.tangential), force = force_on_first(dimension, &f, m->normal);
    contact_quanta q = {
        .straining =
            law_deforms(v) ? vector_minus(dimension, force, dashpot_on_first(dimension, &f, m->normal)) : force,
        .force = quanta_of(dimension, force, scale->inverse_force),
        .torque_first = torque_on(dimension, moment, m->arm_first, scale),
        .torque_second = torque_on(dimension, moment, m->arm_second, scale),
        .count = -touching,
        .normal = lanes_fixed(f.normal, scale->inverse_force),
        .tangential = quanta_of(count, f.tangential, scale->inverse_force),
        .damping = energy_quanta(v, f.damping, scale->inverse_damping),
        .friction = energy_quanta(v, f.friction, scale->inverse_friction),
        .stiffness = energy_quanta(v, f.stiffness, scale->inverse_friction),
        .in_range = lanes_at_or_below((pulls ? lanes_abs(f.normal) : f.normal) + vector_extent(count, f.tangential),
                                      lanes_all(scale->force_limit)),
    };
    if (geometry_has_levers(v)) {
        q.torque_first = torque_of_lever(dimension, m->lever_first, force, 1, scale);
        q.torque_second = torque_of_lever(dimension, m->lever_second, force, -1, scale);
    }
    if (law_holds(v)) {
        q.deformation = f.deformation;
        q.settle = f.settle;
        q.count = -f.in_contact;
    }
    if (law_necks(v)) q.count = -f.in_contact;
    if (law_rolls(v)) {
        quanta couple = quanta_of(count, f.couple, scale->inverse_torque);
        q.torque_first = quanta_sum(q.torque_first, couple);
        q.torque_second = quanta_sum(q.torque_second, quanta_opposite(couple));
    }
    return q;
}

#endif
