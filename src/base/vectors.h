/// Vectors of three. In 2D the third is zero.
#ifndef SCREE_BASE_VECTORS_H
#define SCREE_BASE_VECTORS_H

#include <math.h>

static inline double scree_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double scree_length(const double a[3])
{
    return sqrt(scree_dot(a, a));
}

static inline void scree_subtract(const double a[3], const double b[3], double difference[3])
{
    for (int k = 0; k < 3; k++) difference[k] = a[k] - b[k];
}

/// a + factor b.
static inline void scree_along(const double a[3], double factor, const double b[3], double sum[3])
{
    for (int k = 0; k < 3; k++) sum[k] = a[k] + factor * b[k];
}

static inline void scree_cross(const double a[3], const double b[3], double product[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    product[0] = x;
    product[1] = y;
    product[2] = z;
}

/// Divides by the length, which is returned; a zero vector stays.
static inline double scree_normalise(double a[3])
{
    double length = scree_length(a);
    for (int k = 0; k < 3 && length > 0; k++) a[k] /= length;
    return length;
}

#endif
