/// A normal variable z that is cut at two limits, and radii that follow from it: what the normal and the log-normal
/// distribution share.
#ifndef SCREE_SIZE_GAUSSIAN_H
#define SCREE_SIZE_GAUSSIAN_H

#include "size/limits.h"

/// Radius R = middle + z spread, or middle exp(z spread), between the limits.
typedef struct scree_gaussian {
    scree_size_limits limits; ///< m
    double middle;            ///< m
    double spread;            ///< m, logarithmic: 1
    bool logarithmic;
} scree_gaussian;

/// Moments to 1e-10, by quadrature; radius of the body with this random number.
scree_size_moments scree_gaussian_moments(const scree_gaussian *g);
double scree_gaussian_radius(const scree_gaussian *g, double uniform);

/// The limits hold too little of it. key: what the fault is said of.
bool scree_gaussian_wrong(const scree_gaussian *g, const char *key, scree_size_problem *problem);

/// The face of a distribution whose keys `gaussian` turns into one; key: what the problem is said of.
#define SIZE_GAUSSIAN(gaussian, key)                                                                                   \
    static scree_size_moments moments(const void *own, int dimension)                                                  \
    {                                                                                                                  \
        (void)dimension;                                                                                               \
        const scree_gaussian g = gaussian(own);                                                                        \
        return scree_gaussian_moments(&g);                                                                             \
    }                                                                                                                  \
    static double radius(const void *own, int dimension, double uniform)                                               \
    {                                                                                                                  \
        (void)dimension;                                                                                               \
        const scree_gaussian g = gaussian(own);                                                                        \
        return scree_gaussian_radius(&g, uniform);                                                                     \
    }                                                                                                                  \
    static bool wrong(const void *own, scree_size_problem *problem)                                                    \
    {                                                                                                                  \
        const scree_gaussian g = gaussian(own);                                                                        \
        return scree_gaussian_wrong(&g, key, problem);                                                                 \
    }                                                                                                                  \
    static const scree_size_distribution face = {.moments = moments, .radius = radius, .wrong = wrong}

#endif
