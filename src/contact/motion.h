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
/// spring along). motion_carry projects into the present tangent plane, which is that turn up to second order in phi;
/// motion_carry_whole also gives back the length that the projection takes, up to fourth order,
///   a <- (1 - psi^2 / 2) b + psi n x b,    b = a - (n - phi L / (2 L(n-1))) (a . n)
///
/// Work over a step. In a leapfrog scheme the kinetic energy 1/2 m v(n-1/2) . v(n+1/2) changes by exactly
/// (F(n-1) + F(n))/2 . v(n-1/2) dt. F(n-1) acted along the normal of n - 1, so its power belongs to the geometry of n -
/// 1: the two half-steps together see, up to third order in dt and in the directions of n,
///   indentation increment  d' dt + phi . P u dt / 2                            (= d(n) - d(n-1), called D)
///   slip increment         s dt - D phi / 2 + n x (A . n dt phi + psi s dt + D W dt / 2) / 2
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
    vector tilted;               ///< rad, phi; zero against a wall
    lanes half;                  ///< 1, half of L / L(n - 1), in space
    vector turned;               ///< rad, psi n, in space
    lanes turn;                  ///< rad, psi, in space
    lanes approached, twisted;   ///< middle increments over the step, for the ledger
    vector slip_excess;          ///< by what the middle increments exceed the rates times the step
    vector roll_excess;
    vector foreseen_slip; ///< m/s, slip after the coming kick if all forces stay as they are (motion_foresee)
    lanes mobility;       ///< 1/kg, slip per tangential impulse of the contact's share of the bodies
} motion;

/// scree_foreseen in lanes.
typedef struct foresight {
    vector velocity, spin;
    lanes contacts;
} foresight;

/// Set where the bodies are in contact; also where a coordinate is NaN, so that the kernels notice.
SCREE_INLINE lanes_bits bodies_touch(int dimension, vector apart, lanes radii)
{
    return ~lanes_at_or_below(radii * radii, vector_dot(dimension, apart, apart));
}

/// A vector of the tangent plane of step n - 1 in that of n; in two dimensions there is only one tangent.
SCREE_INLINE vector motion_carry(int dimension, const motion *m, vector a)
{
    if (dimension == 2) return a;
    vector turned = vector_plus(3, a, vector_cross(m->turned, a));
    return vector_minus(3, turned, vector_times(3, m->normal, vector_dot(3, a, m->normal)));
}

/// The same with the length that it had.
SCREE_INLINE vector motion_carry_whole(int dimension, const motion *m, vector a)
{
    if (dimension == 2) return a;
    vector middle = vector_minus(3, m->normal, vector_times(3, m->tilted, m->half));
    vector upright = vector_minus(3, a, vector_times(3, middle, vector_dot(3, a, m->normal)));
    lanes shorter = 1.0 - 0.5 * (m->turn * m->turn);
    return vector_plus(3, vector_times(3, upright, shorter), vector_cross(m->turned, upright));
}

/// Middle increment of the slip.
SCREE_INLINE vector motion_slipped(int count, const motion *m, double step)
{
    return vector_plus(count, vector_times(count, m->slip, lanes_all(step)), m->slip_excess);
}

/// What turning bodies add to the middle increments, in space.
SCREE_INLINE void motion_turn(motion *m, vector lever, vector spins, vector relative, double step)
{
    const double half = 0.5 * step;
    vector n = m->normal, tilted = m->tilted;
    m->twist = vector_dot(3, relative, n);
    m->twisted = m->twist * step - half * vector_dot(3, relative, tilted);
    m->turn = half * vector_dot(3, spins, n);
    m->turned = vector_times(3, n, m->turn);

    lanes turning = m->turn * half;
    vector screw =
        vector_plus(3, vector_times(3, tilted, half * vector_dot(3, lever, n)), vector_times(3, m->slip, turning));
    screw = vector_plus(3, screw, vector_times(3, spins, m->approached * (0.5 * half)));
    m->slip_excess = vector_minus(3, vector_cross(n, screw), vector_times(3, tilted, 0.5 * m->approached));
    screw = vector_minus(3, vector_times(3, m->roll, turning),
                         vector_times(3, tilted, m->reduced_radius * m->twist * half));
    m->roll_excess = vector_cross(n, screw);
}

/// Everything that depends on velocities; normal, indentation, arms and reduced radius are set.
/// inverse_distance: 1 / L, zero for a wall. lever: a_first w_first + a_second w_second.
SCREE_INLINE void motion_advance(int dimension, motion *m, vector velocity, vector lever, vector spin_first,
                                 vector spin_second, lanes inverse_distance, double step)
{
    const int count = tangential_count(dimension);
    vector n = m->normal, along = vector_across(dimension, velocity, n);
    vector spins = vector_plus(count, spin_first, spin_second), relative = vector_minus(count, spin_first, spin_second);
    m->approach = -vector_dot(dimension, velocity, n);
    m->slip = vector_minus(count, along, spin_across(dimension, lever, n));
    m->roll = vector_times(count, spin_across(dimension, relative, n), m->reduced_radius);
    m->tilted = vector_times(count, along, step * inverse_distance);
    m->approached = step * (m->approach + 0.5 * vector_dot(count, along, m->tilted));
    if (dimension == 3) {
        m->half = 0.5 - (0.5 * m->approached) * inverse_distance;
        motion_turn(m, lever, spins, relative, step);
        return;
    }
    m->slip_excess.x = (m->tilted.x + spins.x * (0.5 * step)) * (m->approached * -0.5);
    m->roll_excess.x = lanes_all(0);
}

/// 1 / m + a^2 / J times the number of contacts that pull at the body: each may move its share of the mass alone.
SCREE_INLINE lanes body_mobility(int dimension, const bodies *body, const foresight *ahead, lanes arm)
{
    lanes lever = arm / body->radius;
    lanes one = 1.0 + (dimension == 3 ? 2.5 : 2.0) * (lever * lever);
    return lanes_at_least(ahead->contacts, lanes_all(1)) * one / body->mass;
}

/// For laws that look ahead. Against a wall, `second` is NULL.
SCREE_INLINE void motion_foresee(int dimension, motion *m, const bodies *first, const foresight *ahead,
                                 const bodies *second, const foresight *ahead_second)
{
    const int count = tangential_count(dimension);
    vector velocity = ahead->velocity, lever = vector_times(count, ahead->spin, m->arm_first);
    m->mobility = body_mobility(dimension, first, ahead, m->arm_first);
    if (second) {
        velocity = vector_minus(dimension, velocity, ahead_second->velocity);
        lever = vector_plus(count, lever, vector_times(count, ahead_second->spin, m->arm_second));
        m->mobility += body_mobility(dimension, second, ahead_second, m->arm_second);
    }
    vector change =
        vector_minus(count, vector_across(dimension, velocity, m->normal), spin_across(dimension, lever, m->normal));
    m->foreseen_slip = vector_plus(count, m->slip, change);
}

SCREE_INLINE motion motion_of_pair(int dimension, const bodies *first, const bodies *second, double step)
{
    const int count = tangential_count(dimension);
    motion m;
    vector apart = vector_minus(dimension, first->place, second->place);
    lanes radii = first->radius + second->radius, masses = first->mass + second->mass;
    lanes square = vector_dot(dimension, apart, apart), distance = lanes_root(square);
    // In space, where the chain of operations is long, the division does not wait for the root.
    lanes inverse_distance = dimension == 2 ? 1.0 / distance : distance * (1.0 / square);
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
