/// Intervals by their quantiles. Values are added in the order given, so results do not depend on scheduling.
#include "sweep/interval.h"

#include <gsl/gsl_cdf.h>

#include <math.h>

/// Mean, and the squared error of the mean (NAN below two values).
static double mean_of(const double *value, size_t count, double *error)
{
    double sum = 0, squares = 0, n = (double)count;
    for (size_t i = 0; i < count; i++) sum += value[i];
    double mean = sum / n;
    for (size_t i = 0; i < count; i++) squares += (value[i] - mean) * (value[i] - mean);
    *error = count > 1 ? squares / (n - 1) / n : NAN;
    return count > 0 ? mean : NAN;
}

static scree_interval around(double middle, double half, size_t count)
{
    return (scree_interval){middle, middle - half, middle + half, count};
}

scree_interval scree_interval_mean(const double *value, size_t count, double confidence)
{
    double error, mean = mean_of(value, count, &error);
    double t = count > 1 ? gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, (double)count - 1) : NAN;
    return around(mean, t * sqrt(error), count);
}

scree_interval scree_interval_range(const double *value, size_t count)
{
    double error;
    scree_interval range = {mean_of(value, count, &error), NAN, NAN, count};
    for (size_t i = 0; i < count; i++) {
        range.low = fmin(range.low, value[i]);
        range.high = fmax(range.high, value[i]);
    }
    return range;
}

scree_interval scree_interval_difference(const double *first, size_t first_count, const double *second,
                                         size_t second_count, double confidence)
{
    double u, v, m = (double)first_count, n = (double)second_count;
    double difference = mean_of(first, first_count, &u);
    difference -= mean_of(second, second_count, &v);
    size_t fewer = first_count < second_count ? first_count : second_count;
    if (fewer < 2) return around(difference, NAN, fewer);
    if (u + v == 0) return around(difference, 0, fewer);
    double freedom = (u + v) * (u + v) / (u * u / (m - 1) + v * v / (n - 1));
    return around(difference, gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, freedom) * sqrt(u + v), fewer);
}

scree_interval scree_interval_exponential(scree_interval of_logarithms)
{
    return (scree_interval){exp(of_logarithms.middle), exp(of_logarithms.low), exp(of_logarithms.high),
                            of_logarithms.count};
}

scree_interval scree_interval_proportion(size_t successes, size_t count, double confidence)
{
    if (count == 0) return (scree_interval){NAN, NAN, NAN, 0};
    double k = (double)successes, n = (double)count, tail = 0.5 - 0.5 * confidence;
    return (scree_interval){
        .middle = k / n,
        .low = successes > 0 ? gsl_cdf_beta_Pinv(tail, k, n - k + 1) : 0,
        .high = successes < count ? gsl_cdf_beta_Qinv(tail, k + 1, n - k) : 1,
        .count = count,
    };
}
