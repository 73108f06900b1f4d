/// The elastic test of a run as others see it: its curves, and the constants that it comes to (elastic_test.c).
#ifndef SCREE_RUN_ELASTIC_TEST_H
#define SCREE_RUN_ELASTIC_TEST_H

#include "run/conclusion.h"

/// Columns of the series over the stage with the largest force, rows [first, last]; the force is largest in row `peak`.
typedef struct scree_elastic_curves {
    const double *time;               ///< s
    const double *force;              ///< N, of the load along the gauge, with its sign
    const double *axial, *shortening; ///< 1, m; of the gauge along the load
    const double *lateral;            ///< 1; NULL: there is no gauge across
    double length, width;             ///< m, of the two gauges when the stage began; NAN where there is none
    double area;                      ///< m2, that bears the force
    int along;                        ///< axis of the load
    size_t first, peak, last;
    double young, poisson; ///< Pa, 1: of the linear range; NAN where there is none
} scree_elastic_curves;

/// Whether a case has an elastic test.
bool scree_elastic_is_asked(const scree_config *config);

/// False where the run has no such test, or no force in it.
bool scree_elastic_find(const scree_conclusion *run, scree_elastic_curves *curves);

#endif
