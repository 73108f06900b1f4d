/// Confidence intervals of what samples have in common: of a mean, of a geometric mean, of the difference of two means
/// of different samples, and of a proportion.
#ifndef SCREE_SWEEP_INTERVAL_H
#define SCREE_SWEEP_INTERVAL_H

#include <stddef.h>

typedef struct scree_interval {
    double middle;    ///< the estimate; NAN without a value
    double low, high; ///< NAN where there are too few values for an interval
    size_t count;     ///< values that it rests on; of two groups the smaller number
} scree_interval;

/// What follows takes finite values only, and `confidence` between 0 and 1.

/// Mean with the interval of Student's t; from two values on. Exact for normally distributed values.
scree_interval scree_interval_mean(const double *value, size_t count, double confidence);

/// Least and largest value around the mean: of what does not depend on the sample.
scree_interval scree_interval_range(const double *value, size_t count);

/// Difference of the means of two independent groups of different spread (B. L. Welch, Biometrika 34, 28, 1947):
/// Student's t with (u + v)^2 / (u^2 / (m - 1) + v^2 / (n - 1)) degrees of freedom, u and v the squared errors of the
/// means. From two values in each group on.
scree_interval scree_interval_difference(const double *first, size_t first_count, const double *second,
                                         size_t second_count, double confidence);

/// Of logarithms back to what they are of: the middle is the geometric mean.
scree_interval scree_interval_exponential(scree_interval of_logarithms);

/// Part of `count` trials that succeed, exact (C. J. Clopper, E. S. Pearson, Biometrika 26, 404, 1934): quantiles of
/// the beta distribution.
scree_interval scree_interval_proportion(size_t successes, size_t count, double confidence);

#endif
