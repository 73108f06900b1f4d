/// A row of series.csv: every scalar measure of the present step.
#ifndef SCREE_RUN_SAMPLE_H
#define SCREE_RUN_SAMPLE_H

#include "run/core_columns.h"
#include "run/simulation_data.h"

/// Builds s->table and fills s->sample, of a whole state or of a part; guards the energy balance. What a user sees is
/// compression positive.
scree_status scree_sample_take(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// The last value of a column, NAN when there is none of this name.
double scree_sample_get(const scree_simulation *s, const char *name);

#endif
