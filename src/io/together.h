/// One HDF5 file that all processes write together, each its range of rows (comm/ranges.h), by MPI-IO: not in the
/// memory of one process. Everything that describes the arrays, small arrays and attributes is the same in all
/// processes, as HDF5 demands; of small arrays that all have whole process 0's count.
///
/// Room on the disk is taken before HDF5 writes into it, so that a full disk is met here and not inside the library.
/// Behind the last array the file is flushed by all and closed, and process 0 gives it its checksum, flushes it and
/// renames it: a kill at any moment leaves what was there before. A process that fails leaves at once, as others wait
/// for it in HDF5: whoever called has to end them (run/ranks.h).
///
/// Memory: some arrays of a range. Cost: each array that is not small is one collective write. All processes call each
/// function, in the same order.
#ifndef SCREE_IO_TOGETHER_H
#define SCREE_IO_TOGETHER_H

#include "io/array.h"

#include <hdf5.h>

/// Bytes: arrays up to here are small, and lie in their object header.
enum { SCREE_ARRAY_SMALL = 8192 };

/// Whether an array is small, `all` of it.
static inline bool scree_array_is_small(const scree_array *all)
{
    return all->rows * scree_array_row_size(all) <= SCREE_ARRAY_SMALL;
}

/// Such a file while it is written, in place of `path`.
typedef struct scree_together {
    const char *path;   ///< caller-owned; NULL: the file is of one process
    size_t room, taken; ///< bytes that it needs on the disk, and has got
} scree_together;

/// Begins with `path`; *name, of PATH_MAX bytes, is that of the file which HDF5 has to make. Errors: disk.
scree_status scree_together_begin(scree_together *together, const char *path, char *name,
                                  scree_error *error) SCREE_MUST_USE;

/// `all`: an array as the file will have it. Takes the room on the disk for it; of a small one all->data becomes the
/// whole, to be released, else it stays. Errors: memory, disk.
scree_status scree_together_prepare(scree_together *together, const scree_array *array, scree_array *all,
                                    scree_error *error) SCREE_MUST_USE;

/// Writes the range of this process; false on failure.
bool scree_together_write(hid_t dataset, hid_t type, const scree_array *array, const scree_array *all);

/// Takes the room that is left to be taken, before the file is closed. Errors: disk.
scree_status scree_together_take_room(scree_together *together, scree_error *error) SCREE_MUST_USE;

/// Checksum and name of a file that has been closed; with `status` it is removed instead. Returns the first failure.
scree_status scree_together_end(const scree_together *together, scree_status status, scree_error *error);

#endif
