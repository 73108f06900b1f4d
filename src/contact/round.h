/// Geometry round: two discs, or two spheres. The normal lies on the line of their centres, the contact point on it
/// too, in the middle of the overlap: d = R_first + R_second - L, n = r / L, arms a = R - d / 2 (contact/kinematics.h).
#ifndef SCREE_CONTACT_ROUND_H
#define SCREE_CONTACT_ROUND_H

#include "contact/kinematics.h"
#include "module/geometry.h"

static const scree_geometry_traits round_traits = {.levers = false};

/// Set where the bodies are in contact; also where a coordinate is NaN, so that the kernels notice.
SCREE_INLINE lanes_bits round_touches(int dimension, const bodies *first, const bodies *second)
{
    const vector apart = vector_minus(dimension, first->position, second->position);
    const lanes radii = first->radius + second->radius;
    return ~lanes_at_or_below(radii * radii, vector_dot(dimension, apart, apart));
}

SCREE_INLINE kinematics round_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const int count = tangential_count(dimension);
    kinematics m;
    vector apart = vector_minus(dimension, first->position, second->position);
    lanes radii = first->radius + second->radius, masses = first->mass + second->mass;
    lanes square = vector_dot(dimension, apart, apart), distance = lanes_root(square);
    // In space, where the chain of operations is long, the division does not wait for the root.
    lanes inverse_distance = dimension == 2 ? 1.0 / distance : distance * (1.0 / square);
    m.normal = vector_times(dimension, apart, inverse_distance);
    m.overlap = radii - distance;

    // One division serves both reduced quantities.
    lanes inverse = 1.0 / (radii * masses);
    m.reduced_radius = (first->radius * second->radius) * (masses * inverse);
    m.reduced_mass = (first->mass * second->mass) * (radii * inverse);

    lanes half = 0.5 * m.overlap;
    m.arm_first = first->radius - half;
    m.arm_second = second->radius - half;
    vector lever = vector_plus(count, vector_times(count, first->spin, m.arm_first),
                               vector_times(count, second->spin, m.arm_second));
    vector velocity = vector_minus(dimension, first->velocity, second->velocity);
    vector along = vector_across(dimension, velocity, m.normal);
    m.tilted = vector_times(count, along, step * inverse_distance);
    kinematics_advance(dimension, &m, velocity, along, lever, first->spin, second->spin, step);
    if (dimension == 3) m.half = 0.5 - (0.5 * step) * (m.approach * inverse_distance);
    m.expansion = m.expanding = m.turning = lanes_all(0);
    m.spreading = vector_none();
    return m;
}

/// Beside a wall, a body of infinite radius and mass: R_eff = R, m_eff = m. What does not depend on velocities.
SCREE_INLINE kinematics round_beside(const bodies *body, const double normal[3], double distance, double step)
{
    (void)step;
    kinematics m = {.normal = {lanes_all(normal[0]), lanes_all(normal[1]), lanes_all(normal[2])},
                    .overlap = body->radius - distance};
    m.arm_first = body->radius - 0.5 * m.overlap;
    m.reduced_radius = body->radius;
    m.reduced_mass = body->mass;
    return m;
}

/// How far a body reaches towards a wall, against whose normal it leans [m].
SCREE_INLINE lanes round_reach(const bodies *body)
{
    return body->radius;
}

#endif
