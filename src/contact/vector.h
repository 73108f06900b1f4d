/// Vectors of lanes with a constant number of components: 2 or 3 in space, and 1 or 3 for what is normal to the plane
/// in two dimensions (spin, torque) or along the one tangent there (slip, tangential force), which is then `x`.
/// Components beyond the count are never read.
#ifndef SCREE_CONTACT_VECTOR_H
#define SCREE_CONTACT_VECTOR_H

#include "contact/lanes.h"

typedef struct vector {
    lanes x, y, z;
} vector;

/// Components of a spin, a torque, a slip or a tangential force.
SCREE_INLINE int tangential_count(int dimension)
{
    return dimension == 3 ? 3 : 1;
}

SCREE_INLINE vector vector_none(void)
{
    return (vector){lanes_all(0), lanes_all(0), lanes_all(0)};
}

SCREE_INLINE lanes vector_dot(int count, vector a, vector b)
{
    lanes sum = a.x * b.x;
    if (count > 1) sum += a.y * b.y;
    if (count > 2) sum += a.z * b.z;
    return sum;
}

SCREE_INLINE vector vector_plus(int count, vector a, vector b)
{
    a.x += b.x;
    if (count > 1) a.y += b.y;
    if (count > 2) a.z += b.z;
    return a;
}

SCREE_INLINE vector vector_minus(int count, vector a, vector b)
{
    a.x -= b.x;
    if (count > 1) a.y -= b.y;
    if (count > 2) a.z -= b.z;
    return a;
}

SCREE_INLINE vector vector_times(int count, vector a, lanes factor)
{
    a.x *= factor;
    if (count > 1) a.y *= factor;
    if (count > 2) a.z *= factor;
    return a;
}

SCREE_INLINE vector vector_opposite(int count, vector a)
{
    a.x = -a.x;
    if (count > 1) a.y = -a.y;
    if (count > 2) a.z = -a.z;
    return a;
}

SCREE_INLINE vector vector_keep(int count, lanes_bits mask, vector a)
{
    a.x = lanes_keep(mask, a.x);
    if (count > 1) a.y = lanes_keep(mask, a.y);
    if (count > 2) a.z = lanes_keep(mask, a.z);
    return a;
}

/// Sum of the magnitudes of the components: a bound of the length.
SCREE_INLINE lanes vector_extent(int count, vector a)
{
    lanes sum = lanes_abs(a.x);
    if (count > 1) sum += lanes_abs(a.y);
    if (count > 2) sum += lanes_abs(a.z);
    return sum;
}

/// a x b in space.
SCREE_INLINE vector vector_cross(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Part of `a` normal to the unit vector `n`: in two dimensions its component along t = (-n_y, n_x).
SCREE_INLINE vector vector_across(int dimension, vector a, vector n)
{
    if (dimension == 2) return (vector){.x = a.y * n.x - a.x * n.y};
    return vector_minus(3, a, vector_times(3, n, vector_dot(3, a, n)));
}

/// w x n, w a spin: in two dimensions the component along t.
SCREE_INLINE vector spin_across(int dimension, vector w, vector n)
{
    return dimension == 2 ? w : vector_cross(w, n);
}

/// w x l, w a spin, l a lever.
SCREE_INLINE vector spin_cross(int dimension, vector w, vector l)
{
    return dimension == 2 ? (vector){.x = -(w.x * l.y), .y = w.x * l.x} : vector_cross(w, l);
}

/// l x f, l a lever: the torque of a force.
SCREE_INLINE vector lever_cross(int dimension, vector l, vector f)
{
    return dimension == 2 ? (vector){.x = l.x * f.y - l.y * f.x} : vector_cross(l, f);
}

/// n x f, f a tangential force.
SCREE_INLINE vector moment_of(int dimension, vector n, vector f)
{
    return dimension == 2 ? f : vector_cross(n, f);
}

/// Factor that shortens `a` in space to the length `limit` where it is longer, else 1. NaN for a vector with NaN.
/// limit |a| / a^2: root and division do not wait for each other.
SCREE_INLINE lanes vector_limit_factor(vector a, lanes limit)
{
    lanes square = vector_dot(3, a, a);
    lanes_bits within = lanes_at_or_below(square, limit * limit);
    return lanes_select(within, lanes_all(1), limit * (lanes_root(square) * (1.0 / square)));
}

/// `a`, shortened to the length `limit` where it is longer.
SCREE_INLINE vector vector_at_most(int count, vector a, lanes limit)
{
    if (count == 1) return (vector){.x = lanes_at_least(lanes_at_most(a.x, limit), -limit)};
    return vector_times(3, a, vector_limit_factor(a, limit));
}

#endif
