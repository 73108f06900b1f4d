/// Gauges of a case: lengths between two selections, as columns of series.csv and results (gauges.c).
#ifndef SCREE_MEASURE_GAUGES_H
#define SCREE_MEASURE_GAUGES_H

#include "model/model.h"

enum { SCREE_GAUGES = 16 }; ///< most of a case

/// One of them.
typedef struct scree_gauge {
    char *name;
    char *between; ///< names of selections
    char *and_other;
    int along;  ///< 0 to 2
    char *from; ///< stage; NULL: every one by itself
} scree_gauge;

/// Number of the gauge of this name; -1: there is none.
int64_t scree_gauge_find(const scree_config *config, const char *name);

/// Axis of the gauge of this name, which is there, 0 to 2.
int scree_gauge_axis(const scree_model *model, const char *name);

/// Those of a case; count 0: none. The case has been checked.
const scree_gauge *scree_gauges_of(const scree_config *config, int64_t *count);

#endif
