/// Whole files in memory.
#ifndef SCREE_BASE_FILE_BYTES_H
#define SCREE_BASE_FILE_BYTES_H

#include "base/error.h"

#include <stddef.h>

/// The bytes of a file, and a NUL behind them; the caller releases them. Errors: SCREE_ERROR_IO (not there, larger than
/// 4 GB), memory; *bytes is NULL then.
scree_status scree_file_load(const char *path, char **bytes, size_t *length, scree_error *error) SCREE_MUST_USE;

#endif
