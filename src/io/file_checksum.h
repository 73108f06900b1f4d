/// A checksum behind the last byte of a file: 16 bytes, a mark and the checksum of everything before it. HDF5 ignores
/// what follows its own data. A file whose checksum is whole is whole; others are refused before HDF5 (1.10) parses
/// them, whose error paths crash in H5Ocopy and leave complaints at exit. Any flipped bit and any cut is found, with a
/// chance of 2^-64 to miss one. Cost: one pass, about 4 GB/s.
#ifndef SCREE_IO_FILE_CHECKSUM_H
#define SCREE_IO_FILE_CHECKSUM_H

#include "base/error.h"

#include <stdint.h>

enum { SCREE_FILE_CHECKSUM_SIZE = 16 };

/// The checksum of `size` bytes in memory.
void scree_file_checksum_make(const void *bytes, size_t size, unsigned char ending[SCREE_FILE_CHECKSUM_SIZE]);

/// Appends its checksum to a file that has none.
scree_status scree_file_checksum_append(const char *path, scree_error *error) SCREE_MUST_USE;

/// SCREE_OK when the file ends with its checksum. Errors: SCREE_ERROR_IO, unreadable or damaged.
scree_status scree_file_checksum_check(const char *path, scree_error *error) SCREE_MUST_USE;

#endif
