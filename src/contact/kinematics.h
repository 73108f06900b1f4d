/// Relative motion of two bodies at their contact, in lanes: what every law needs.
///
/// With r = x_first - x_second, u = v_first - v_second, L = |r|, n = r / L, P = 1 - n n:
///   overlap d = R_first + R_second - L,      its rate d' = -u . n  (P 2.A2, 2.A3 corrected)
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
/// normal by psi = (w_first + w_second) . (n - phi / 2) dt / 2 (the mean of both surfaces: a pair that turns rigidly
/// takes its spring along). kinematics_carry projects into the present tangent plane, which is that turn up to second
/// order in phi; kinematics_carry_whole also gives back the length that the projection takes, up to fourth order,
///   a <- (1 - psi^2 / 2) b + psi n x b,    b = a - (n - phi L / (2 L(n-1))) (a . n)
///
/// Rates in the middle of the step. Velocities and spins are those of n - 1/2, normal, distance and arms those of n.
/// Put together as they are, they give a pair that turns rigidly with w the slip dt/2 L (w . n) P w, and one that
/// closes while it turns d' dt w: errors of first order in the step. So all rates are those of the geometry of n - 1/2,
/// turned into the directions of n. There the normal is n - phi / 2, each arm longer by D / 4 where D is the increment
/// of the overlap, and what lies in the tangent plane is turned by phi / 2 and psi / 2: with W = w_first +
/// w_second, V = w_first - w_second, A = a_first w_first + a_second w_second,
///   approach  D / dt = d' + phi . P u / 2                         (D = d(n) - d(n-1))
///   slip      (1 + psi/2 n x) (P u - D / dt phi / 2 - (A + (A . n) phi / 2 + D W / 4) x n)
///   twist     V . (n - phi / 2)
///   rolling   (1 + psi/2 n x) R_eff (V + V . n phi / 2) x n
/// up to second order in dt. Springs are stretched by these rates times dt, so a rigid rotation about any axis leaves
/// them as they are up to third order a step, second order in all; dashpots and viscous friction follow the same rates.
///
/// Work over a step. In a leapfrog scheme the kinetic energy 1/2 m v(n-1/2) . v(n+1/2) changes by exactly
/// (F(n-1) + F(n))/2 . v(n-1/2) dt. F(n-1) acted along the normal of n - 1, so its power belongs to the geometry of n -
/// 1: F(n-1) turned along with its contact has the power of F(n-1) when the velocity is turned too. The mean of both
/// half-steps is the geometry in between, so the work is (F(n-1) + F(n))/2 times the rates above times dt, up to third
/// order: the trapezoids of the ledger close with the second order of the scheme itself.
#ifndef SCREE_CONTACT_KINEMATICS_H
#define SCREE_CONTACT_KINEMATICS_H

#include "contact/vector.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct bodies {
    vector position, velocity;
    vector spin; ///< one component in two dimensions
    lanes radius, mass, material;
    const double *stretch;              ///< one body at a time: its row (state/state.h); NULL: it is rigid
    const struct scree_state *state;    ///< one body at a time: where its geometry finds more of it,
    size_t row;                         ///< in this row;
    const struct scree_predicted *lead; ///< one body at a time: what it moves faster at n; NULL: not known
    const struct outlines_found *found; ///< of the first, in lanes: what of outlines has been found (outlines_lanes.h)
} bodies;

/// Radius times strain of the bodies of a contact, their sum: xx, yy, xy in 2D; xx, yy, zz, yz, xz, xy in 3D.
typedef struct stretch {
    lanes now[6];    ///< m
    lanes change[6]; ///< m, in the last step
} stretch;

/// Rates are those of the middle of the step. Dashpots have rates of their own: the same ones, but where bodies are
/// known to move differently at n (kinematics_at_end).
typedef struct kinematics {
    vector normal;          ///< n, from second to first
    lanes overlap;          ///< m, negative when apart
    lanes expansion;        ///< m, the part of it that the strains of the bodies add
    lanes expanding;        ///< m/s, its rate
    vector spreading;       ///< m/s, at which the strains move the surfaces past each other, as slip
    lanes turning;          ///< m, by which the overlap has changed since the normal turned past the strained bodies
    lanes approach;         ///< m/s, d'
    vector slip;            ///< m/s, s
    vector roll;            ///< m/s
    lanes twist;            ///< rad/s, in space
    lanes dashpot_approach; ///< m/s, of the dashpots, in the same order
    vector dashpot_slip;    ///< m/s
    vector dashpot_roll;    ///< m/s
    lanes dashpot_twist;    ///< rad/s
    lanes arm_first, arm_second;      ///< m, of the levers, along the normal
    vector lever_first, lever_second; ///< m, from the centres to the contact point, of geometries with levers;
    vector moved_first, moved_second; ///< m, by which they have changed in the last step
    lanes reduced_radius;             ///< m, R_eff
    lanes reduced_mass;               ///< kg, m_eff
    lanes area;                       ///< m2, that the bodies share, of geometries with `areas`; its gradient as the
    lanes chord;                      ///< m,  first body moves along -n; lengths l of R 2.31, and the same of the radii
    lanes length, rest_length;        ///< m,  of equal area;
    lanes reduced_mass_along;         ///< kg, of the tangential motion at the point
    vector passing;                   ///< m/s, of the first centre past the second, and
    lanes spin_first, spin_second;    ///< rad/s, both of n - 1/2, of geometries with `areas`
    lanes gain, gain_middle;          ///< 1, |gradient of the overlap|, of geometries with `gains`; middle of the step
    vector tilted;                    ///< rad, phi; zero against a plane
    lanes half;                       ///< 1, half of L / L(n - 1), of pairs in space
    vector turned;                    ///< rad, psi n, in space
    lanes turn;                       ///< rad, psi, in space
    vector predicted_slip; ///< m/s, slip after the coming kick if all forces stay as they are (kinematics_predict)
    lanes mobility;        ///< 1/kg, slip per tangential impulse of the contact's share of the bodies
} kinematics;

/// scree_predicted in lanes.
typedef struct prediction {
    vector velocity, spin;
    lanes contacts;
} prediction;

/// A vector of the tangent plane of step n - 1 in that of n; in two dimensions there is only one tangent.
SCREE_INLINE vector kinematics_carry(int dimension, const kinematics *m, vector a)
{
    if (dimension == 2) return a;
    vector turned = vector_plus(3, a, vector_cross(m->turned, a));
    return vector_minus(3, turned, vector_times(3, m->normal, vector_dot(3, a, m->normal)));
}

/// The same with the length that it had.
SCREE_INLINE vector kinematics_carry_whole(int dimension, const kinematics *m, vector a)
{
    if (dimension == 2) return a;
    vector middle = vector_minus(3, m->normal, vector_times(3, m->tilted, m->half));
    vector upright = vector_minus(3, a, vector_times(3, middle, vector_dot(3, a, m->normal)));
    lanes shorter = 1.0 - 0.5 * (m->turn * m->turn);
    return vector_plus(3, vector_times(3, upright, shorter), vector_cross(m->turned, upright));
}

/// For what has been evaluated already: what the contact remembers is that of now, and is carried no further.
SCREE_INLINE void kinematics_hold(kinematics *m)
{
    m->tilted = m->turned = vector_none();
    m->turn = lanes_all(0);
}

/// A rate in the tangent plane of the middle, turned on by psi / 2.
SCREE_INLINE vector turn_half(const kinematics *m, vector rate)
{
    return vector_plus(3, rate, vector_times(3, vector_cross(m->turned, rate), lanes_all(0.5)));
}

/// Turn, twist and rolling, in space.
SCREE_INLINE void kinematics_turn(kinematics *m, vector spins, vector relative, double step)
{
    vector half = vector_times(3, m->tilted, lanes_all(0.5)), middle = vector_minus(3, m->normal, half);
    m->turn = (0.5 * step) * vector_dot(3, spins, middle);
    m->turned = vector_times(3, m->normal, m->turn);
    m->twist = vector_dot(3, relative, middle);
    relative = vector_plus(3, relative, vector_times(3, half, m->twist));
    m->roll = turn_half(m, vector_times(3, vector_cross(relative, m->normal), m->reduced_radius));
}

/// Dashpots follow the rates of the middle of the step.
SCREE_INLINE void kinematics_set_dashpots(int dimension, kinematics *m)
{
    m->dashpot_approach = m->approach;
    m->dashpot_slip = m->slip;
    m->dashpot_roll = m->roll;
    if (dimension == 3) m->dashpot_twist = m->twist;
}

/// Velocity and spin of a body at n.
typedef struct motion_at_n {
    vector velocity, spin;
} motion_at_n;

/// Where the motion at n is known, and not only that of the middle of the step: dashpots have the rates of n, in the
/// geometry of n, which makes their forces functions of places and velocities at one time. Springs, and the work of
/// all forces, keep the way of the step. levers: of geometries that have them. velocities and spins: at n, of the
/// first body relative to a wall that moves; second: NULL beside a wall.
SCREE_INLINE void kinematics_at_end(int dimension, bool levers, kinematics *m, const motion_at_n *first,
                                    const motion_at_n *second)
{
    const int count = tangential_count(dimension);
    const vector n = m->normal;
    const vector lever = levers ? m->lever_first : vector_times(dimension, n, -m->arm_first);
    vector passing = vector_plus(dimension, first->velocity, spin_cross(dimension, first->spin, lever));
    vector relative = first->spin;
    if (second) {
        const vector there = levers ? m->lever_second : vector_times(dimension, n, m->arm_second);
        const vector moving = spin_cross(dimension, second->spin, there);
        passing = vector_minus(dimension, passing, vector_plus(dimension, second->velocity, moving));
        relative = vector_minus(count, relative, second->spin);
    }
    m->dashpot_approach = -vector_dot(dimension, passing, n);
    m->dashpot_slip = vector_across(dimension, passing, n);
    m->dashpot_roll = vector_times(count, relative, m->reduced_radius);
    if (dimension == 2) return;
    m->dashpot_twist = vector_dot(3, relative, n);
    m->dashpot_roll = vector_times(3, vector_cross(relative, n), m->reduced_radius);
}

/// Of geometries with `gains`, whose overlap is no length along the normal n, but a function of the pose with the
/// gradient g n: it grows g times as fast as the bodies approach each other. Rates and forces of laws are conjugate to
/// the overlap: rates are g times those at the contact, and the bodies get g times the forces of the law
/// (contact_law), along the normal and in the tangent plane alike. So power, energy, friction over normal force are
/// those of the contact; the mass that belongs to such rates is m_eff / g^2, which the geometry sets.
SCREE_INLINE void kinematics_gain(int dimension, kinematics *m)
{
    const int count = tangential_count(dimension);
    m->approach *= m->gain_middle;
    m->slip = vector_times(count, m->slip, m->gain_middle);
    m->roll = vector_times(count, m->roll, m->gain_middle);
    kinematics_set_dashpots(dimension, m);
}

/// The same of dashpots with rates of their own.
SCREE_INLINE void kinematics_gain_at_end(int dimension, kinematics *m)
{
    const int count = tangential_count(dimension);
    m->dashpot_approach *= m->gain;
    m->dashpot_slip = vector_times(count, m->dashpot_slip, m->gain);
    m->dashpot_roll = vector_times(count, m->dashpot_roll, m->gain);
}

/// Everything that depends on velocities; normal, overlap, arms, reduced radius and `tilted` are set.
/// along: P u. lever: a_first w_first + a_second w_second.
SCREE_INLINE void kinematics_advance(int dimension, kinematics *m, vector velocity, vector along, vector lever,
                                     vector spin_first, vector spin_second, double step)
{
    const int count = tangential_count(dimension);
    vector n = m->normal;
    vector spins = vector_plus(count, spin_first, spin_second), relative = vector_minus(count, spin_first, spin_second);
    vector half = vector_times(count, m->tilted, lanes_all(0.5));
    m->approach = vector_dot(count, along, half) - vector_dot(dimension, velocity, n);

    lever = vector_plus(count, lever, vector_times(count, spins, m->approach * (0.25 * step)));
    if (dimension == 3) lever = vector_plus(3, lever, vector_times(3, half, vector_dot(3, lever, n)));
    along = vector_minus(count, along, vector_times(count, half, m->approach));
    m->slip = vector_minus(count, along, spin_across(dimension, lever, n));
    m->roll = vector_times(count, relative, m->reduced_radius);
    if (dimension == 3) {
        kinematics_turn(m, spins, relative, step);
        m->slip = turn_half(m, m->slip);
    }
    kinematics_set_dashpots(dimension, m);
}

SCREE_INLINE motion_at_n motion_at_end(int dimension, const bodies *body, prediction lead)
{
    return (motion_at_n){vector_plus(dimension, body->velocity, lead.velocity),
                         vector_plus(tangential_count(dimension), body->spin, lead.spin)};
}

/// The same of geometries with levers: normal, overlap, reduced radius and mass, `tilted`, the levers and their changes
/// are set. With the levers of the middle of the step, m = l - moved / 2, the bodies pass each other at the contact
/// point with c = u + w_first x m_first - w_second x m_second; of it the approach is -c . (n - phi / 2), and the rest
/// is slip. second: NULL for a wall that stands.
SCREE_INLINE void kinematics_from_levers(int dimension, kinematics *m, const bodies *first, const bodies *second,
                                         double step)
{
    const int count = tangential_count(dimension);
    const lanes half = lanes_all(0.5);
    const vector n = m->normal, tilt = vector_times(count, m->tilted, half);
    const vector middle = vector_minus(dimension, m->lever_first, vector_times(dimension, m->moved_first, half));
    // One body after the other, so that the exchange of the two changes signs alone.
    vector passing = vector_plus(dimension, first->velocity, spin_cross(dimension, first->spin, middle));
    vector spins = first->spin, relative = first->spin;
    if (second) {
        const vector there = vector_minus(dimension, m->lever_second, vector_times(dimension, m->moved_second, half));
        passing = vector_minus(dimension, passing,
                               vector_plus(dimension, second->velocity, spin_cross(dimension, second->spin, there)));
        spins = vector_plus(count, spins, second->spin);
        relative = vector_minus(count, relative, second->spin);
        m->arm_second = vector_dot(dimension, m->lever_second, n);
    }
    m->arm_first = -vector_dot(dimension, m->lever_first, n);
    const vector along = vector_across(dimension, passing, n);
    m->approach = vector_dot(count, along, tilt) - vector_dot(dimension, passing, n);
    m->slip = vector_minus(count, along, vector_times(count, tilt, m->approach));
    m->roll = vector_times(count, relative, m->reduced_radius);
    m->expansion = m->expanding = m->turning = lanes_all(0);
    m->spreading = vector_none();
    if (dimension == 3) {
        kinematics_turn(m, spins, relative, step);
        m->slip = turn_half(m, m->slip);
    }
    kinematics_set_dashpots(dimension, m);
}

/// 1 / m + a^2 / J times the number of contacts that pull at the body: each may move its share of the mass alone.
SCREE_INLINE lanes body_mobility(int dimension, const bodies *body, const prediction *ahead, lanes arm)
{
    lanes lever = arm / body->radius;
    lanes one = 1.0 + (dimension == 3 ? 2.5 : 2.0) * (lever * lever);
    return lanes_at_least(ahead->contacts, lanes_all(1)) * one / body->mass;
}

/// For laws that look ahead. Against a wall, `second` is NULL.
SCREE_INLINE void kinematics_predict(int dimension, kinematics *m, const bodies *first, const prediction *ahead,
                                     const bodies *second, const prediction *ahead_second)
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
    m->predicted_slip = vector_plus(count, m->slip, change);
}

/// R strain n [m]: the way of the surface from the centre, where the normal is n (M 2.52); of two bodies, of both.
SCREE_INLINE vector stretch_along(int dimension, const lanes e[6], vector n)
{
    if (dimension == 2) return (vector){.x = e[0] * n.x + e[2] * n.y, .y = e[2] * n.x + e[1] * n.y};
    return (vector){e[0] * n.x + e[5] * n.y + e[4] * n.z, e[5] * n.x + e[1] * n.y + e[3] * n.z,
                    e[4] * n.x + e[3] * n.y + e[2] * n.z};
}

/// Of bodies that deform: the overlap of the deformed surfaces (M 2.53), and the rates at which strains change it and
/// move the surfaces past each other. Arms and the other rates stay those of the circles: the contact point and the
/// normal are taken to be where they were (M 2.6).
SCREE_INLINE void kinematics_expand(int dimension, kinematics *m, const stretch *both, double step)
{
    vector way = stretch_along(dimension, both->now, m->normal);
    vector change = stretch_along(dimension, both->change, m->normal);
    const int count = tangential_count(dimension);
    vector middle = vector_minus(dimension, way, vector_times(dimension, change, lanes_all(0.5)));
    change = vector_times(dimension, change, lanes_all(step > 0 ? 1 / step : 0));
    m->turning = 2 * vector_dot(count, vector_across(dimension, middle, m->normal), m->tilted);
    m->expansion = vector_dot(dimension, m->normal, way);
    m->overlap += m->expansion;
    m->expanding = vector_dot(dimension, m->normal, change);
    m->spreading = vector_opposite(count, vector_across(dimension, change, m->normal));
}

/// Set where they are in contact then; also where it is not a number.
SCREE_INLINE lanes_bits expanded_touch(const kinematics *m)
{
    return ~lanes_at_or_below(m->overlap, lanes_all(0));
}

#endif
