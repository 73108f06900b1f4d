/// How two numbers of the same elements go together.
#ifndef SCREE_AVERAGE_RELATION_H
#define SCREE_AVERAGE_RELATION_H

#include "average/table.h"

/// Spearman's rank correlation of x and y, equal values sharing their ranks; NAN with fewer than three. Cost:
/// O(count^2).
double scree_average_rank_correlation(const double *x, const double *y, size_t count);

/// Of what a parabola in x explains of the variance of y the share that a line does not (least squares): 0 of a line, 1
/// of a parabola about the mean of x; NAN with fewer than four, and of a constant.
double scree_average_bend(const double *x, const double *y, size_t count);

/// Angle between the major axes of two tensors of a row of a table in space, 0 to 90 degrees: elevations alone do not
/// say it. first, second: names of their columns before `_xx`; sign: of the first, -1 of a stress whose pressure is
/// meant. NAN where one has no such axis, or is not there with nine components, as in the plane.
double scree_average_axes_apart(const scree_average_table *table, size_t row, const char *first, double sign,
                                const char *second);

#endif
