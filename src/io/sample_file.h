/// Samples to average over, read from the snapshots of a run (average/sample.h).
#ifndef SCREE_IO_SAMPLE_FILE_H
#define SCREE_IO_SAMPLE_FILE_H

#include "average/sample.h"

/// What a snapshot is of.
typedef struct scree_snapshot_mark {
    int64_t index;       ///< its number
    size_t place;        ///< among all snapshots of the run
    double time;         ///< s
    double axial_strain; ///< NAN outside loading
    char stage[32];      ///< its kind
    char stage_name[64]; ///< in the case; of older snapshots the kind
} scree_snapshot_mark;

/// Whether a snapshot is one of a stage that is called so: by the name of the stage in the case, or by its kind.
bool scree_snapshot_mark_is_of(const scree_snapshot_mark *mark, const char *stage);

/// All snapshots of a run in their order; free *marks with scree_release. Errors: SCREE_ERROR_IO, SCREE_ERROR_INPUT (no
/// run, none in it); memory.
scree_status scree_snapshot_marks(const char *directory, scree_snapshot_mark **marks, size_t *count,
                                  scree_error *error) SCREE_MUST_USE;

/// Reads the sample of a snapshot. Thickness and, where the snapshot was written before it kept gravity, gravity are
/// those of the case in the folder. Free *sample. Errors: SCREE_ERROR_IO; SCREE_ERROR_INPUT; memory.
scree_status scree_sample_read(const char *directory, int64_t index, scree_average_sample *sample,
                               scree_error *error) SCREE_MUST_USE;

#endif
