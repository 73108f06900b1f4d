/// Means with confidence intervals, and curves averaged over realisations.
#ifndef SCREE_SWEEP_STATISTICS_H
#define SCREE_SWEEP_STATISTICS_H

#include "base/error.h"

typedef struct scree_estimate {
    size_t count;     ///< finite values
    size_t of;        ///< all values: what is not there, or has no number, is counted
    double mean;      ///< NAN without a value
    double deviation; ///< standard deviation of the sample (n - 1), NAN below two values
    double half;      ///< half of the confidence interval of the mean, NAN below two values
    double range[2];  ///< least and largest value, NAN without a value
} scree_estimate;

/// Mean of the finite ones of `value` with the two-sided interval of Student's t: half = t(1 - (1 - confidence)/2,
/// n - 1) s / sqrt(n). Exact for normally distributed values. How many there were in all is kept in `of`.
scree_estimate scree_estimate_mean(const double *value, size_t count, double confidence);

/// One curve of a member: `count` places of rising x.
typedef struct scree_curve {
    double *x, *y;
    size_t count;
} scree_curve;

/// The last ascent of a series as a curve: rows where x and y are finite and x is above all before; where the stage
/// changes and x falls back, the curve begins anew. `stage` may be NULL.
scree_status scree_curve_from_series(const double *x, const double *y, const double *stage, size_t rows,
                                     scree_curve *curve, scree_error *error) SCREE_MUST_USE;
void scree_curve_destroy(scree_curve *curve);

/// y at `x` by linear interpolation, NAN outside.
double scree_curve_at(const scree_curve *curve, double x);

/// Averages curves at `places` evenly spaced x of the range that all of them have. Outputs hold `places` values each;
/// Errors: the curves have no common range (SCREE_ERROR_INPUT), memory.
scree_status scree_curves_average(const scree_curve *curve, size_t count, double confidence, size_t places, double *x,
                                  scree_estimate *estimate, scree_error *error) SCREE_MUST_USE;

#endif
