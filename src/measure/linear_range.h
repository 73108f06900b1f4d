/// The straight part of a curve: between two shares of its peak, or the widest that there is.
#ifndef SCREE_MEASURE_LINEAR_RANGE_H
#define SCREE_MEASURE_LINEAR_RANGE_H

#include "base/error.h"

#include <stddef.h>

/// Rows in the order of time.
typedef struct scree_curve {
    const double *x, *y;
    const double *load; ///< whose shares bound the range: y itself, or another column
    size_t count;
} scree_curve;

typedef struct scree_linear_range {
    double from, to; ///< 1, shares of the largest magnitude of the load
    size_t rows;
    double slope;     ///< of the line of least squares
    double departure; ///< 1, largest distance of y from the line over what y changes by
    double peak, at;  ///< largest magnitude of the load, and x there; NAN: there is no load
} scree_linear_range;

/// Of the rows up to the largest magnitude of the load. from, to: shares of it, or NAN: the widest range in steps of
/// 5 %, at least 20 % wide, in which y departs by no more than `straight` from its line; of several the lowest. Errors:
/// SCREE_ERROR_INPUT when there is none, with how near it came; the peak is told nevertheless.
scree_status scree_linear_range_find(const scree_curve *curve, double from, double to, double straight,
                                     scree_linear_range *range, scree_error *error) SCREE_MUST_USE;

#endif
