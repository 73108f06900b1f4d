/// Localisation in two strain windows of a case that adjoin each other: does it stay, and does it intensify? Of a case
/// with one window alone: its localisation.
#ifndef SCREE_RUN_WINDOW_BANDS_H
#define SCREE_RUN_WINDOW_BANDS_H

#include "case/config.h"
#include "io/cell_file.h"

/// Axial strains at which the instants lie: three of two windows, two of one.
typedef struct scree_followed {
    double strain[3];
    size_t count;
} scree_followed;

/// The first window of `measure` that ends where the next one in the list begins, and that one; or the only one there
/// is. False: there is none.
bool scree_windows_followed(const scree_config_measure *measure, scree_followed *out);

typedef struct scree_window_bands {
    double correlation; ///< of the smoothed distortions at the bodies, first and second window
    double overlap;     ///< bodies in both bands over bodies in either; 0 where a window has none
    double index[2];    ///< localisation index of each window
} scree_window_bands;

/// Compares the motions first -> middle and middle -> last. Cells are those of the begin of each. `last` NULL: of the
/// first motion alone, the rest NAN. Errors: memory.
scree_status scree_window_bands_compare(const scree_cell_snapshot *first, const scree_cell_snapshot *middle,
                                        const scree_cell_snapshot *last, scree_window_bands *out,
                                        scree_error *error) SCREE_MUST_USE;

#endif
