/// What is computed at the end of a run from the cells of its snapshots: cells.csv, bands.csv, names in summary.json.
#ifndef SCREE_RUN_CELL_RESULTS_H
#define SCREE_RUN_CELL_RESULTS_H

#include "case/config.h"
#include "io/series.h"
#include "io/summary.h"

/// Reads the snapshots of the run directory; those without cells, or outside loading, do not count. series: of the run,
/// what cells are compared with; NULL: with nothing. band_window: least axial strain over which shear bands are looked
/// for. Errors: disk, memory.
scree_status scree_cell_results_write(const char *directory, const scree_config_measure *measure, double band_window,
                                      const scree_series *series, scree_summary *summary,
                                      scree_error *error) SCREE_MUST_USE;

#endif
