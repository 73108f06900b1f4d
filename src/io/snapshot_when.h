/// Snapshots by when they were taken, as options name it: `start`, `end`, `#N`, a stage, an axial strain of the loading
/// stage that was the last, or a time with its unit.
#ifndef SCREE_IO_SNAPSHOT_WHEN_H
#define SCREE_IO_SNAPSHOT_WHEN_H

#include "io/sample_file.h"

/// *which: of a stage the last one, of a strain or a time the nearest. Errors: SCREE_ERROR_INPUT with `option` ("--at")
/// as its field and what there is: nothing of that name, or the run does not reach it, by more than a twentieth of its
/// range.
scree_status scree_snapshot_find_when(const scree_snapshot_mark *mark, size_t count, const char *when,
                                      const char *option, size_t *which, scree_error *error) SCREE_MUST_USE;

/// The error that there is none of this name.
scree_status scree_snapshot_refuse_when(const scree_snapshot_mark *mark, size_t count, const char *when,
                                        const char *option, scree_error *error);

#endif
