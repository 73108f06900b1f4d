/// How two numbers of the same elements go together.
#ifndef SCREE_AVERAGE_RELATION_H
#define SCREE_AVERAGE_RELATION_H

#include <stddef.h>

/// Spearman's rank correlation of x and y, equal values sharing their ranks; NAN with fewer than three. Cost:
/// O(count^2).
double scree_average_rank_correlation(const double *x, const double *y, size_t count);

/// Of what a parabola in x explains of the variance of y the share that a line does not (least squares): 0 of a line, 1
/// of a parabola about the mean of x; NAN with fewer than four, and of a constant.
double scree_average_bend(const double *x, const double *y, size_t count);

#endif
