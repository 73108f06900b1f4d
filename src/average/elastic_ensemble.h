/// Elastic constants of an ensemble: those of its mean fields.
///
/// A constant is a quotient; where the strain of one sample is near zero it is wild, and a mean of quotients with it.
/// So in tables of an ensemble the constants are those of the mean change of stress and the mean strain of the samples
/// that have both, and their bands those of the resamples of whole samples (average/table.h). Cost: resamples x samples
/// a row.
#ifndef SCREE_AVERAGE_ELASTIC_ENSEMBLE_H
#define SCREE_AVERAGE_ELASTIC_ENSEMBLE_H

#include "average/table.h"

/// Writes them into the mean of `count` tables, and with more than one into both ends of the band (NULL: without).
/// Nothing happens where the tables have none. Errors: memory.
scree_status scree_average_elastic_ensemble(const scree_average_table *table, size_t count, scree_average_table *mean,
                                            scree_average_table *low, scree_average_table *high,
                                            scree_error *error) SCREE_MUST_USE;

#endif
