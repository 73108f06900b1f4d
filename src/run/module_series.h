/// Columns that modules add to series.csv behind those of the core (run/sample.h), and their last values among the
/// results.
#ifndef SCREE_RUN_MODULE_SERIES_H
#define SCREE_RUN_MODULE_SERIES_H

#include "io/series.h"
#include "io/summary.h"
#include "run/simulation.h"

/// scree_series_open with all columns of this case. Errors: memory, input/output.
scree_status scree_module_series_open(scree_series_writer *writer, const scree_simulation *s, const char *path,
                                      int64_t append_rows, scree_error *error) SCREE_MUST_USE;

/// The last sample, and what the modules say now.
scree_status scree_module_series_append(scree_series_writer *writer, const scree_simulation *s,
                                        scree_error *error) SCREE_MUST_USE;

void scree_module_series_summarise(const scree_simulation *s, scree_summary *summary);

#endif
