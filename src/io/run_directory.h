/// The run directory: names of its files, creation, refusal of a directory that holds another run, safe replacement.
#ifndef SCREE_IO_RUN_DIRECTORY_H
#define SCREE_IO_RUN_DIRECTORY_H

#include "base/error.h"
#include "io/folder_lock.h"

#include <stdbool.h>
#include <stdio.h>

#define SCREE_FILE_CASE       "case.yaml"
#define SCREE_FILE_SUMMARY    "summary.json"
#define SCREE_FILE_SERIES     "series.csv"
#define SCREE_FILE_CELLS      "cells.csv"
#define SCREE_FILE_BANDS      "bands.csv"
#define SCREE_FILE_BREAKS     "breaks.csv"
#define SCREE_FILE_RUN        "run.h5"
#define SCREE_FILE_RUN_WHOLE  "run.h5.whole" ///< run.h5 while it is gathered
#define SCREE_FILE_LOG        "log.txt"
#define SCREE_FOLDER_FIGURES  "figures"
#define SCREE_FOLDER_PARAVIEW "paraview"
#define SCREE_FOLDER_PARTS    "parts" ///< snapshots and checkpoints of a run that has not ended, linked from run.h5

/// What stands behind the name of a file while it is written.
#define SCREE_REPLACEMENT ".new"

/// Makes `path` and locks it for a run. Release the lock in any case. Errors: SCREE_ERROR_INPUT when somebody else
/// writes there, with who that is; SCREE_ERROR_IO.
scree_status scree_run_directory_lock(const char *path, scree_folder_lock *lock, scree_error *error) SCREE_MUST_USE;

/// Creates `path` and its folders. A directory that already holds a run is refused (SCREE_ERROR_INPUT) without `force`;
/// with it the files of the old run (only those that Scree wrote) are removed first. So is, without `force`, a run that
/// has left neither a snapshot nor a checkpoint: its preparation failed. A message without a failure in *error tells
/// what was left or replaced.
scree_status scree_run_directory_create(const char *path, bool force, scree_error *error) SCREE_MUST_USE;

/// Makes `path` and the folders above it. Errors: SCREE_ERROR_IO, SCREE_ERROR_INPUT when a file is in the way.
scree_status scree_folders_make(const char *path, scree_error *error) SCREE_MUST_USE;

/// Opens a temporary file beside `path`; scree_replace_finish flushes (fsync), checks and renames it over `path`,
/// or removes it when `keep` is false. A full disk is reported by finish and leaves the old file as it was. In a run
/// directory the name is listed first (io/manifest.h).
scree_status scree_replace_begin(const char *path, FILE **file, scree_error *error) SCREE_MUST_USE;
scree_status scree_replace_finish(const char *path, FILE *file, bool keep, scree_error *error) SCREE_MUST_USE;

/// path = directory/name, checked for length.
scree_status scree_path_join(char *path, size_t size, const char *directory, const char *name,
                             scree_error *error) SCREE_MUST_USE;

#endif
