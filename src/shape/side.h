/// On which side of a line a point lies, exactly.
///
/// Twice the signed area of the triangle a, b, c: positive where c lies to the left of the line from a to b. Taken from
/// a, so that a short edge keeps its digits however far away c lies. In floating point it is wrong by at most (3 + 16
/// u) u times the sum of the magnitudes of its two products (u = 2^-53; Shewchuk 1997, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", Discrete Comput. Geom. 18, 305). Where that decides
/// nothing, the value is summed exactly, as an expansion: a sum of doubles whose bits do not overlap.
///
/// Limits: no product of coordinates may underflow or overflow (magnitudes between 1e-140 and 1e150, or zero). NaN
/// gives NaN. Cost: 7 operations; the exact sum 40 to 100 ns.
#ifndef SCREE_SHAPE_SIDE_H
#define SCREE_SHAPE_SIDE_H

#include "base/inline.h"

#include <math.h>

/// Bound of the error relative to the sum of the magnitudes of the products.
#define SCREE_SIDE_ERROR ((3 + 16 * 0x1p-53) * 0x1p-53)

/// The same number without error but for its last rounding: its sign is right, zero is zero.
double scree_side_exact(const double a[2], const double b[2], const double c[2]);

/// A number whose sign is that of the side; zero if the three lie on one line.
SCREE_INLINE double scree_side(const double a[2], const double b[2], const double c[2])
{
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]), side = left - right;
    if (fabs(side) > SCREE_SIDE_ERROR * (fabs(left) + fabs(right))) return side;
    return scree_side_exact(a, b, c);
}

/// Whether c lies to the right of the line, for certain: a point that cannot be told is not.
SCREE_INLINE int scree_is_right(const double a[2], const double b[2], const double c[2])
{
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
    return left - right < -SCREE_SIDE_ERROR * (fabs(left) + fabs(right));
}

#endif
