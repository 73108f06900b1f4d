/// Dispersion relation from displacements over place and time.
#ifndef SCREE_MEASURE_DISPERSION_H
#define SCREE_MEASURE_DISPERSION_H

#include "base/error.h"

#include <stdbool.h>

/// One wave of the sample.
typedef struct scree_dispersion_point {
    double wavenumber; ///< rad/m
    double frequency;  ///< rad/s, where its power is largest
    double share;      ///< of its power that lies around that frequency
} scree_dispersion_point;

/// value: displacements [m] of `layers` layers, `spacing` [m] apart, at `records` times, `interval` [s] apart: layer by
/// layer within a time. periodic: the last layer is followed by the first. Fills one point a wavenumber, layers / 2 of
/// them: 2 pi n / (layers spacing), n from 1. Errors: SCREE_ERROR_INPUT with less than 4 layers or 16 times; memory.
scree_status scree_dispersion_find(const double *value, size_t layers, size_t records, double spacing, double interval,
                                   bool periodic, scree_dispersion_point *point, scree_error *error) SCREE_MUST_USE;

#endif
