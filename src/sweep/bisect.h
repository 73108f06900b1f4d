/// Search for a limit by runs: see scree_bisect in <scree/sweep.h>, and bisect.c.
#ifndef SCREE_SWEEP_BISECT_H
#define SCREE_SWEEP_BISECT_H

#include <scree/sweep.h>

#include "base/error.h"

#include <limits.h>

/// Checks what a search is about against its case, before anything runs: a key that is a number, two ends, a result
/// that is one. ends: in SI units. Errors: SCREE_ERROR_INPUT, with `field` the part of it that is wrong ("between").
scree_status scree_bisection_check(const scree_case *c, const scree_bisection *what, double ends[2],
                                   scree_error *error) SCREE_MUST_USE;

enum { SCREE_BISECTION_CURVES = 4 }; ///< most in a figure

/// A run in the figure of a search.
typedef struct scree_bisection_curve {
    char folder[PATH_MAX];
    char label[96];
    bool stands;
} scree_bisection_curve;

/// figures/runs: a column of series.csv over time. Errors: no such column (SCREE_ERROR_INPUT); gnuplot, disk.
scree_status scree_bisection_figure(const char *output, const char *title, const char *column,
                                    const scree_bisection_curve *curve, size_t count,
                                    scree_error *error) SCREE_MUST_USE;

#endif
