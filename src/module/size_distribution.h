/// The face of a distribution of sizes: one file a distribution (src/size/). Its keys are those of the section
/// `particles`, or of one of its species. Radii [m] follow the distribution by number.
#ifndef SCREE_MODULE_SIZE_DISTRIBUTION_H
#define SCREE_MODULE_SIZE_DISTRIBUTION_H

#include "module/module.h"

typedef struct scree_size_moments {
    double least, most; ///< m, no radius lies outside
    double mean;        ///< m
    double square;      ///< m2, mean of R^2
    double cube;        ///< m3, mean of R^3
} scree_size_moments;

/// What is wrong with the keys of a distribution.
typedef struct scree_size_problem {
    const char *key;
    const char *above; ///< it is larger than what this key says; NULL: another fault
    char text[200];
} scree_size_problem;

/// `keys`: the module's struct. dimension: of space, for shares by mass.
typedef struct scree_size_distribution {
    /// Least and largest radius, and moments.
    scree_size_moments (*moments)(const void *keys, int dimension);
    /// Radius below which the share `uniform` of all bodies lies, in [0, 1): of a body's own random number it makes
    /// its radius.
    double (*radius)(const void *keys, int dimension, double uniform);
    /// Whether something is wrong, and what. Missing and wrong values are NAN: of such nothing is said.
    bool (*wrong)(const void *keys, scree_size_problem *problem);
    bool equal; ///< a trait: there is one radius
} scree_size_distribution;

#endif
