/// Relative motion of two bodies at their contact, in lanes: what every law needs.
///
/// With r = x_first - x_second, u = v_first - v_second at n - 1/2, L = |r|, n = r / L, t = (-n_y, n_x):
///   indentation d = R_first + R_second - L,      its rate d' = -u . n  (P 2.A2, 2.A3 corrected)
///   lever arms a = R - d / 2,                    slip s = u . t - (a_first w_first + a_second w_second)
/// The slip uses the lever arms of the torque (P 2.A5, 2.A6: r is measured from each centre to the contact point): only
/// then does a rigid rotation of the pair give no slip, and only then is the power of the tangential force f_t s,
/// without a remainder f_t (w_first + w_second) d / 2 that no ledger could name.
///
/// Work over a step. In a leapfrog scheme the kinetic energy 1/2 m v(n-1/2) . v(n+1/2) changes by exactly
/// (F(n-1) + F(n))/2 . v(n-1/2) dt. F(n-1) acted along the normal of n - 1, so its power belongs to the geometry of n -
/// 1: the two half-steps together see, up to third order in dt,
///   indentation increment  d' dt + (u.t dt)^2 / (2 L)                                   (= d(n) - d(n-1))
///   slip increment         s dt - 1/2 (d(n) - d(n-1)) (u.t dt / L + 1/2 (w_first + w_second) dt)
/// With these middle increments the trapezoids of the ledger close with the second order of the scheme itself.
#ifndef SCREE_CONTACT_MOTION_H
#define SCREE_CONTACT_MOTION_H

#include "contact/lanes.h"

typedef struct bodies {
    lanes x, y, material, radius, vx, vy, spin, mass;
} bodies;

typedef struct motion {
    lanes normal_x, normal_y;
    lanes indentation;           ///< m, negative when apart
    lanes approach;              ///< m/s, d'
    lanes slip;                  ///< m/s, s
    lanes arm_first, arm_second; ///< m
    lanes reduced_radius;        ///< m, R_eff
    lanes reduced_mass;          ///< kg, m_eff
    lanes approached, slipped;   ///< m, middle increments over the step, for the ledger
    lanes foreseen_slip;         ///< m/s, slip after the coming kick if all forces stay as they are
    lanes mobility;              ///< 1/kg, slip per tangential impulse of the contact's share of the bodies
} motion;

/// scree_foreseen in lanes.
typedef struct foresight {
    lanes vx, vy, spin, contacts;
} foresight;

/// Set where the bodies are in contact; also where a coordinate is NaN, so that the kernels notice.
SCREE_INLINE lanes_bits bodies_touch(lanes x, lanes y, lanes radii)
{
    return ~lanes_at_or_below(radii * radii, x * x + y * y);
}

/// The increments of the ledger. shift: u . t dt; inverse_distance: 1 / L, zero for a wall; turn: sum of spins * dt.
SCREE_INLINE void motion_advance(motion *m, lanes shift, lanes inverse_distance, lanes turn, double step)
{
    lanes angle = shift * inverse_distance;
    m->approached = m->approach * step + 0.5 * (shift * angle);
    m->slipped = m->slip * step - 0.5 * (m->approached * (angle + 0.5 * turn));
}

/// 1 / m + a^2 / J times the number of contacts that pull at the body: each may move its share of the mass alone.
SCREE_INLINE lanes body_mobility(const bodies *body, const foresight *ahead, lanes arm)
{
    lanes lever = arm / body->radius;
    return lanes_at_least(ahead->contacts, lanes_all(1)) * (1.0 + 2.0 * (lever * lever)) / body->mass;
}

/// For laws that look ahead. Against a wall, `second` is NULL.
SCREE_INLINE void motion_foresee(motion *m, const bodies *first, const foresight *ahead, const bodies *second,
                                 const foresight *ahead_second)
{
    m->foreseen_slip = m->slip + (ahead->vy * m->normal_x - ahead->vx * m->normal_y - m->arm_first * ahead->spin);
    m->mobility = body_mobility(first, ahead, m->arm_first);
    if (!second) return;
    m->foreseen_slip -=
        ahead_second->vy * m->normal_x - ahead_second->vx * m->normal_y + m->arm_second * ahead_second->spin;
    m->mobility += body_mobility(second, ahead_second, m->arm_second);
}

SCREE_INLINE motion motion_of_pair(const bodies *first, const bodies *second, double step)
{
    motion m;
    lanes x = first->x - second->x, y = first->y - second->y;
    lanes radii = first->radius + second->radius, masses = first->mass + second->mass;
    lanes distance = lanes_root(x * x + y * y);
    lanes inverse_distance = 1.0 / distance;
    m.normal_x = x * inverse_distance;
    m.normal_y = y * inverse_distance;
    m.indentation = radii - distance;

    // One division serves both reduced quantities.
    lanes inverse = 1.0 / (radii * masses);
    m.reduced_radius = (first->radius * second->radius) * (masses * inverse);
    m.reduced_mass = (first->mass * second->mass) * (radii * inverse);

    lanes u = first->vx - second->vx, v = first->vy - second->vy;
    lanes along_tangent = v * m.normal_x - u * m.normal_y;
    lanes half = 0.5 * m.indentation;
    m.approach = -(u * m.normal_x + v * m.normal_y);
    m.arm_first = first->radius - half;
    m.arm_second = second->radius - half;
    m.slip = along_tangent - (m.arm_first * first->spin + m.arm_second * second->spin);
    motion_advance(&m, along_tangent * step, inverse_distance, (first->spin + second->spin) * step, step);
    return m;
}

#endif
