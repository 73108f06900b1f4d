/// Runs in little, to be kept (archive.c).
#ifndef SCREE_IO_ARCHIVE_H
#define SCREE_IO_ARCHIVE_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

/// Makes the folder `target` from the run in `directory`: case.yaml, summary.json, series.csv, and a run.h5 of `count`
/// snapshots, rounded to 24 bits. Errors: SCREE_ERROR_INPUT: the folder is there; SCREE_ERROR_IO; memory.
scree_status scree_run_archive(const char *directory, const char *target, const int64_t *index, size_t count,
                               scree_error *error) SCREE_MUST_USE;

#endif
