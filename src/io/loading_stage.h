/// The loading stage of a run, for its summary, its figures and its curves in sweeps: the last stage that has strained
/// the sample (compress, deform: `axial_strain` of series.csv is a number), whatever comes after it.
#ifndef SCREE_IO_LOADING_STAGE_H
#define SCREE_IO_LOADING_STAGE_H

#include "io/series.h"

#include <stdbool.h>

/// Rows [first, last) of series.csv.
typedef struct scree_loading_rows {
    size_t first, last;
} scree_loading_rows;

/// Those of the loading stage; none when there is no such stage or column.
scree_loading_rows scree_loading_rows_find(const scree_series *series);

/// Width [1] of the running mean over the axial strain that a peak is looked for in.
#define SCREE_PEAK_WINDOW 0.01

typedef struct scree_peak {
    double value, strain; ///< NAN: there is none
} scree_peak;

/// Largest running mean of `ratio` over the rows whose strain lies within half of SCREE_PEAK_WINDOW, and the strain of
/// its row: the plates' start and single samples make spikes. ratio, strain: columns of series.csv. Cost: rows times
/// rows in the window.
scree_peak scree_peak_find(const double *ratio, const double *strain, scree_loading_rows rows);

/// Whether a snapshot of stage `now` at `strain` is the first of its stage, the one before it being of stage `before`:
/// stages may have the same name, and every one that strains begins with a snapshot at zero.
bool scree_snapshot_begins_stage(const char *before, const char *now, double strain);

#endif
