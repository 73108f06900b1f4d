/// run.h5 and the parts it is made of while a run lasts. A part is a small run.h5 of its own: the file
/// parts/snapshot-000012.h5 holds the group /snapshots/000012 and nothing else, and run.h5 holds an external link of
/// the same name to it. Parts and run.h5 are only ever replaced as a whole, in the order: part, then links.
#ifndef SCREE_IO_RUN_FILE_H
#define SCREE_IO_RUN_FILE_H

#include "io/hdf5_file.h"

typedef enum scree_part_kind { SCREE_PART_SNAPSHOT, SCREE_PART_CHECKPOINT, SCREE_PART_KINDS } scree_part_kind;
enum { SCREE_CHECKPOINTS_KEPT = 2 };

/// Numbers of the parts or groups that exist, ascending.
typedef struct scree_part_list {
    int64_t *index;
    size_t count, capacity;
} scree_part_list;
void scree_part_list_destroy(scree_part_list *list);

/// "/snapshots/000012"
void scree_part_group(scree_part_kind kind, int64_t index, char *name, size_t size);
/// "DIRECTORY/parts/snapshot-000012.h5"
scree_status scree_part_path(const char *directory, scree_part_kind kind, int64_t index, char *path, size_t size,
                             scree_error *error) SCREE_MUST_USE;
/// Makes DIRECTORY/parts when it is not there.
scree_status scree_parts_folder_make(const char *directory, scree_error *error) SCREE_MUST_USE;
/// "DIRECTORY/run.h5"
scree_status scree_run_file_path(const char *directory, char *path, size_t size, scree_error *error) SCREE_MUST_USE;

/// Parts on disk; none when the folder does not exist. Errors: memory, unreadable folder.
scree_status scree_parts_list(const char *directory, scree_part_kind kind, scree_part_list *list,
                              scree_error *error) SCREE_MUST_USE;
/// Groups of an open run.h5; with `own_only` those that are in the file itself and not links. Errors: memory.
scree_status scree_run_file_list(scree_hdf5 *run, scree_part_kind kind, bool own_only, scree_part_list *list);

/// Writes run.h5 anew with a link for each part: snapshots with numbers below `snapshot_limit`, the newest checkpoints.
/// What a finished run.h5 holds itself is put back into parts first. `case_name` NULL: as it was.
scree_status scree_run_file_renew(const char *directory, const char *case_name, int64_t snapshot_limit,
                                  scree_error *error) SCREE_MUST_USE;

#endif
