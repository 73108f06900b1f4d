/// HDF5 with Scree's error handling: one open file, first failure kept, later calls do nothing, so that a caller lists
/// what it wants written and asks once at the end.
///
/// Files are built in memory (HDF5's core driver) and leave as one block through scree_replace_begin/finish: no HDF5
/// call ever writes to a full disk, which the library (1.10) answers with a crash in H5Ocopy or at exit. The newer file
/// format (1.10) is used because all of its metadata carry checksums, and values do so too (hdf5_file.c), so damage is
/// found before it is believed. HDF5
/// prints nothing: its own messages become part of the scree_error. Every handle below a file closes with it. Nothing
/// is compressed: shuffle and deflate save 13 % on such data at 37 MB/s (docs/output.md). Memory: twice the file while
/// it is saved. Limits: one file must fit into memory, unless several processes write it together (io/together.h); a
/// thread waits while another one has a file open.
#ifndef SCREE_IO_HDF5_FILE_H
#define SCREE_IO_HDF5_FILE_H

#include "io/together.h"

#include <hdf5.h>

typedef struct scree_hdf5 {
    size_t written;          ///< bytes of arrays
    hid_t file;              ///< negative: none
    hid_t group;             ///< of the last array that was written or read, while it is open; negative: none
    char group_name[160];    ///< its name
    const char *path;        ///< named in messages; caller-owned
    scree_status status;     ///< first failure
    bool damaged;            ///< the failure lies in the file, not in memory or in the caller
    scree_error *error;      ///< may be NULL
    scree_together together; ///< all processes write it
    bool keep;               ///< a file in memory leaves its bytes in `image` when it closes
    void *image;
    H5E_auto2_t printing; ///< what HDF5 did with its messages before
    void *printing_data;
} scree_hdf5;

/// Opens. `path` must outlive the file. All files that are open at the same time are closed in reverse order.
void scree_hdf5_create(scree_hdf5 *hdf5, const char *path, scree_error *error); ///< new, in memory
void scree_hdf5_create_together(scree_hdf5 *hdf5, const char *path,
                                scree_error *error);                          ///< new, by all processes (io/together.h)
void scree_hdf5_open(scree_hdf5 *hdf5, const char *path, scree_error *error); ///< to read
void scree_hdf5_open_checked(scree_hdf5 *hdf5, const char *path,
                             scree_error *error); ///< to read, if its checksum is whole
void scree_hdf5_extend(scree_hdf5 *hdf5, const char *path,
                       scree_error *error); ///< to add to, on disk; loses the checksum

/// Closes; returns the first failure. What is in memory and has not been saved is lost.
scree_status scree_hdf5_close(scree_hdf5 *hdf5);
/// Writes a file that was built in memory, or by all processes, with its checksum (checksum.h), over `path`, as a whole
/// or not at all, and closes it. Of one by all processes a process that fails must end the others.
scree_status scree_hdf5_save(scree_hdf5 *hdf5);

/// Records a failure with HDF5's innermost message; keeps the first. `action` is e.g. "write 'position' to".
void scree_hdf5_fail(scree_hdf5 *hdf5, const char *action, const char *name);

/// Records that what was read makes no sense.
void scree_hdf5_damaged(scree_hdf5 *hdf5, const char *reason);

/// The same with a reason that names dataset, row and value.
__attribute__((format(printf, 2, 3))) void scree_hdf5_refuse(scree_hdf5 *hdf5, const char *format, ...);

/// Group `name` with all groups above it; nothing happens when it is there.
void scree_hdf5_group(scree_hdf5 *hdf5, const char *name);

/// Reads everything below `group` to find damage: every dataset and attribute has a checksum of its own or lies in
/// metadata that have. Errors: SCREE_ERROR_IO with the object; memory.
scree_status scree_hdf5_verify(scree_hdf5 *hdf5, const char *group, scree_error *error) SCREE_MUST_USE;

/// Dataset `group`/`array->name` (group "" or NULL: in the root) with attributes `unit` and `description`. In a file of
/// all processes all write it: ranges, or an array that all have whole.
void scree_hdf5_write(scree_hdf5 *hdf5, const char *group, const scree_array *array);

/// Reads it back: fills array->rows from the file and allocates data. Type and components must be those of `array`.
void scree_hdf5_read(scree_hdf5 *hdf5, const char *group, scree_array *array);

/// The same of the range of rows that this process has of it (comm/ranges.h); begin and total are filled, too.
void scree_hdf5_read_range(scree_hdf5 *hdf5, const char *group, scree_array *array);

/// Attributes of the object `name` ("/" for the file). Texts are cut at `size`.
void scree_hdf5_set_text(scree_hdf5 *hdf5, const char *name, const char *attribute, const char *text);
void scree_hdf5_set_number(scree_hdf5 *hdf5, const char *name, const char *attribute, double value);
void scree_hdf5_set_integer(scree_hdf5 *hdf5, const char *name, const char *attribute, uint64_t value);
void scree_hdf5_get_text(scree_hdf5 *hdf5, const char *name, const char *attribute, char *text, size_t size);
void scree_hdf5_get_number(scree_hdf5 *hdf5, const char *name, const char *attribute, double *value);
void scree_hdf5_get_integer(scree_hdf5 *hdf5, const char *name, const char *attribute, uint64_t *value);

#endif
