/// A file that takes the place of another only when it is whole.
#ifndef SCREE_IO_REPLACEMENT_H
#define SCREE_IO_REPLACEMENT_H

#include "base/error.h"

#include <stdbool.h>
#include <stdio.h>

/// What stands behind the name of a file while it is written.
#define SCREE_REPLACEMENT ".new"

/// Opens a temporary file beside `path`; scree_replacement_close flushes (fsync), checks and renames it over `path`, or
/// removes it when `keep` is false. In a run directory use scree_replace_begin, which lists the name, too. Errors:
/// SCREE_ERROR_IO, SCREE_ERROR_INPUT when the path is too long.
scree_status scree_replacement_open(const char *path, FILE **file, scree_error *error) SCREE_MUST_USE;
scree_status scree_replacement_close(const char *path, FILE *file, bool keep, scree_error *error) SCREE_MUST_USE;

/// The name of the temporary file. Errors: SCREE_ERROR_INPUT when it is too long.
scree_status scree_replacement_name(char *name, size_t size, const char *path, scree_error *error) SCREE_MUST_USE;

/// Takes the disk space of a file before HDF5 writes into it: a full disk is met here and not inside the library.
/// Errors: SCREE_ERROR_IO.
scree_status scree_file_reserve(const char *path, off_t begin, off_t bytes, scree_error *error) SCREE_MUST_USE;

/// The same without writing anything: where the file system cannot keep room for a file it has to have that much.
scree_status scree_file_claim(const char *path, off_t begin, off_t bytes, scree_error *error) SCREE_MUST_USE;

/// Puts its checksum behind the file `temporary`, flushes it to the disk and renames it to `path`. Errors:
/// SCREE_ERROR_IO.
scree_status scree_replacement_put(const char *temporary, const char *path, scree_error *error) SCREE_MUST_USE;

/// path = directory/name, checked for length.
scree_status scree_path_join(char *path, size_t size, const char *directory, const char *name,
                             scree_error *error) SCREE_MUST_USE;

#endif
