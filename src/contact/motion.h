/// Relative motion of two bodies at their contact, in lanes: what every law needs.
///
/// With r = x_first - x_second, u = v_first - v_second at n - 1/2, L = |r|, n = r / L, P = 1 - n n:
///   indentation d = R_first + R_second - L,      its rate d' = -u . n  (P 2.A2, 2.A3 corrected)
///   lever arms a = R - d / 2,                    slip s = P u - (a_first w_first + a_second w_second) x n
/// which is one number along t = (-n_y, n_x) in two dimensions, s = u . t - (a_first w_first + a_second w_second).
/// The slip uses the lever arms of the torque (P 2.A5, 2.A6: r is measured from each centre to the contact point): only
/// then does a rigid rotation of the pair give no slip, and only then is the power of the tangential force f_t . s,
/// without a remainder f_t (w_first + w_second) d / 2 that no ledger could name.
///
/// Rolling and twisting. R_eff (w_first - w_second) x n is the velocity at which two rolling surfaces pass the contact
/// in opposite senses (Luding 2008), (w_first - w_second) . n the rate of twist (Marshall 2009).
///
/// What the contact remembers turns with it: from n - 1 to n, n turns by phi = P u dt / L, and the pair about its
/// normal by psi = (w_first + w_second) . n dt / 2 (the mean of both surfaces: a pair that turns rigidly takes its
/// spring along). motion_carry projects into the present tangent plane, which is that turn up to second order in phi.
///
/// Work over a step. In a leapfrog scheme the kinetic energy 1/2 m v(n-1/2) . v(n+1/2) changes by exactly
/// (F(n-1) + F(n))/2 . v(n-1/2) dt. F(n-1) acted along the normal of n - 1, so its power belongs to the geometry of n -
/// 1: the two half-steps together see, up to third order in dt and in the directions of n,
///   indentation increment  d' dt + phi . P u dt / 2                            (= d(n) - d(n-1), called D)
///   slip increment         s dt - D (phi + W dt x n / 2) / 2 + n x (A . n dt phi + psi s dt) / 2
///   rolling increment      s_r dt + n x (psi s_r dt - R_eff (w_first - w_second) . n dt phi) / 2
///   twist increment        (w_first - w_second) . (n dt - phi dt / 2)
/// W = w_first + w_second, A = a_first w_first + a_second w_second. (F(n-1) turned along with its contact has the power
/// of F(n-1) when the velocity is turned too; the geometry of n - 1 is that of n with n - phi, arms longer by D / 2.)
/// With these middle increments the trapezoids of the ledger close with the second order of the scheme itself.
#ifndef SCREE_CONTACT_MOTION_H
#define SCREE_CONTACT_MOTION_H

#include "contact/vector.h"

typedef struct bodies {
    vector place, velocity;
    vector spin; ///< one component in two dimensions
    lanes radius, mass, material;
} bodies;

typedef struct motion {
    vector normal;               ///< n, from second to first
    lanes indentation;           ///< m, negative when apart
    lanes approach;              ///< m/s, d'
    vector slip;                 ///< m/s, s
    vector roll;                 ///< m/s
    lanes twist;                 ///< rad/s, in space
    lanes arm_first, arm_second; ///< m
    lanes reduced_radius;        ///< m, R_eff
    lanes reduced_mass;          ///< kg, m_eff
    lanes turned;                ///< rad, psi
    lanes approached;            ///< middle increments over the step, for the ledger
    vector slipped, rolled;
    lanes twisted;
} motion;

/// Set where the bodies are in contact; also where a coordinate is NaN, so that the kernels notice.
SCREE_INLINE lanes_bits bodies_touch(int dimension, vector apart, lanes radii)
{
    return ~lanes_at_or_below(radii * radii, vector_dot(dimension, apart, apart));
}

/// A vector of the tangent plane of step n - 1 in that of n; in two dimensions there is only one tangent.
SCREE_INLINE vector motion_carry(int dimension, const motion *m, vector a)
{
    if (dimension == 2) return a;
    vector turned = vector_plus(3, a, vector_times(3, vector_cross(m->normal, a), m->turned));
    return vector_minus(3, turned, vector_times(3, m->normal, vector_dot(3, a, m->normal)));
}

/// The same with the length that it had.
SCREE_INLINE vector motion_carry_whole(int dimension, const motion *m, vector a)
{
    if (dimension == 2) return a;
    vector carried = motion_carry(3, m, a);
    lanes square = vector_dot(3, carried, carried);
    lanes_bits some = ~lanes_at_or_below(square, lanes_all(0));
    return vector_times(3, carried, lanes_keep(some, lanes_root(vector_dot(3, a, a) / square)));
}

/// Everything that depends on velocities; normal, indentation, arms and reduced radius are set.
/// inverse_distance: 1 / L, zero for a wall. lever: a_first w_first + a_second w_second.
SCREE_INLINE void motion_advance(int dimension, motion *m, vector velocity, vector lever, vector spin_first,
                                 vector spin_second, lanes inverse_distance, double step)
{
    const int count = tangential_count(dimension);
    lanes dt = lanes_all(step);
    vector n = m->normal, along = vector_across(dimension, velocity, n);
    vector spins = vector_plus(count, spin_first, spin_second), relative = vector_minus(count, spin_first, spin_second);
    m->approach = -vector_dot(dimension, velocity, n);
    m->slip = vector_minus(count, along, spin_across(dimension, lever, n));
    m->roll = vector_times(count, spin_across(dimension, relative, n), m->reduced_radius);

    vector shift = vector_times(count, along, dt), angle = vector_times(count, shift, inverse_distance);
    vector turn = spin_across(dimension, vector_times(count, spins, dt), n);
    m->approached = m->approach * step + 0.5 * vector_dot(count, shift, angle);
    vector bent = vector_plus(count, angle, vector_times(count, turn, lanes_all(0.5)));
    m->slipped = vector_minus(count, vector_times(count, m->slip, dt), vector_times(count, bent, m->approached * 0.5));
    m->rolled = vector_times(count, m->roll, dt);
    if (dimension == 2) return;

    lanes lever_normal = vector_dot(3, lever, n) * step;
    m->twist = vector_dot(3, relative, n);
    m->turned = 0.5 * step * vector_dot(3, spins, n);
    vector screw = vector_plus(3, vector_times(3, angle, lever_normal), vector_times(3, m->slip, m->turned * step));
    m->slipped = vector_plus(3, m->slipped, vector_times(3, vector_cross(n, screw), lanes_all(0.5)));
    screw = vector_minus(3, vector_times(3, m->roll, m->turned * step),
                         vector_times(3, angle, m->reduced_radius * m->twist * step));
    m->rolled = vector_plus(3, m->rolled, vector_times(3, vector_cross(n, screw), lanes_all(0.5)));
    m->twisted = m->twist * step - 0.5 * step * vector_dot(3, relative, angle);
}

SCREE_INLINE motion motion_of_pair(int dimension, const bodies *first, const bodies *second, double step)
{
    const int count = tangential_count(dimension);
    motion m;
    vector apart = vector_minus(dimension, first->place, second->place);
    lanes radii = first->radius + second->radius, masses = first->mass + second->mass;
    lanes distance = lanes_root(vector_dot(dimension, apart, apart));
    lanes inverse_distance = 1.0 / distance;
    m.normal = vector_times(dimension, apart, inverse_distance);
    m.indentation = radii - distance;

    // One division serves both reduced quantities.
    lanes inverse = 1.0 / (radii * masses);
    m.reduced_radius = (first->radius * second->radius) * (masses * inverse);
    m.reduced_mass = (first->mass * second->mass) * (radii * inverse);

    lanes half = 0.5 * m.indentation;
    m.arm_first = first->radius - half;
    m.arm_second = second->radius - half;
    vector lever = vector_plus(count, vector_times(count, first->spin, m.arm_first),
                               vector_times(count, second->spin, m.arm_second));
    motion_advance(dimension, &m, vector_minus(dimension, first->velocity, second->velocity), lever, first->spin,
                   second->spin, inverse_distance, step);
    return m;
}

#endif
