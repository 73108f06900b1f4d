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

/// All loading stages of a run as one curve.
typedef struct scree_loading_path {
    scree_loading_rows rows; ///< from the first row of the first one to the last row of the last one
    const double *strain;    ///< column: that runs on through them; of one stage `axial_strain`; NAN between stages
    const char *label;       ///< of its axis, in percent; NULL: there is one stage alone
    bool plates;             ///< plates did work in these rows
    bool sheared;            ///< it is a cell whose `strain_shear` goes further than the axial strain
} scree_loading_path;

/// Of several stages the strain is `strain_zz` (in the plane `strain_yy`), or of a cell that repeats itself
/// `strain_shear` where that goes further.
scree_loading_path scree_loading_path_find(const scree_series *series);

/// Width [1] of the running mean over the axial strain that a peak is looked for in.
#define SCREE_PEAK_WINDOW 0.01

typedef struct scree_peak {
    double value, strain; ///< NAN: there is none
} scree_peak;

/// Largest running mean of `ratio` over the rows whose strain lies within half of SCREE_PEAK_WINDOW, and the strain of
/// its row: the plates' start and single samples make spikes. A window ends where the strain turns, and between two
/// turns that are less than a window apart nothing is looked for: cycles have no peak. ratio, strain: columns of
/// series.csv; rows without a strain do not count. Cost: rows times rows in the window.
scree_peak scree_peak_find(const double *ratio, const double *strain, scree_loading_rows rows);

/// The first peak of a curve.
typedef struct scree_first_peak {
    double value, strain; ///< NAN: there is none
    double dip;           ///< largest fall after it, over it; NAN: there is none
} scree_first_peak;

/// A first peak has at least this share of the largest value: around zero every curve has small ones.
#define SCREE_PEAK_SHARE 0.1

/// The first maximum above zero that a fall of `fall` [1] of it follows before it is passed. value, strain: columns of
/// series.csv.
scree_first_peak scree_first_peak_find(const double *value, const double *strain, scree_loading_rows rows, double fall);

/// Maxima between the ends of a curve that stand out on both sides by at least `share` [1] of its range.
size_t scree_maxima_count(const double *value, scree_loading_rows rows, double share);

/// Rows of the two such maxima that stand out most, the earlier one first; false where there are not two.
bool scree_maxima_most(const double *value, scree_loading_rows rows, size_t row[2]);

/// Whether a snapshot of stage `now` at `strain` is the first of its stage, the one before it being of stage `before`:
/// stages may have the same name, and every one that strains begins with a snapshot at zero.
bool scree_snapshot_begins_stage(const char *before, const char *now, double strain);

#endif
