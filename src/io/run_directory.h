/// The run directory: names of its files, creation, refusal of a directory that holds another run, safe replacement.
#ifndef SCREE_IO_RUN_DIRECTORY_H
#define SCREE_IO_RUN_DIRECTORY_H

#include "base/error.h"
#include "io/file_names.h"
#include "io/folder_lock.h"
#include "io/replacement.h"

#include <stdbool.h>
#include <stdio.h>

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

/// Whether two names are of one folder that is there.
bool scree_folders_are_same(const char *one, const char *other);

/// Opens a temporary file beside `path`; scree_replace_finish flushes (fsync), checks and renames it over `path`,
/// or removes it when `keep` is false. A full disk is reported by finish and leaves the old file as it was. In a run
/// directory the name is listed first (io/manifest.h).
scree_status scree_replace_begin(const char *path, FILE **file, scree_error *error) SCREE_MUST_USE;
scree_status scree_replace_finish(const char *path, FILE *file, bool keep, scree_error *error) SCREE_MUST_USE;

/// Copies a file, as a whole or not at all. Errors: SCREE_ERROR_IO.
scree_status scree_file_copy(const char *from, const char *to, scree_error *error) SCREE_MUST_USE;

#endif
