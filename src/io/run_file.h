/// run.h5 and the parts it is made of while a run lasts. A part is a small run.h5 of its own: the file
/// parts/snapshot-000012.h5 holds the group /snapshots/000012 and nothing else, and run.h5 holds an external link of
/// the same name to it. Parts and run.h5 are only ever replaced as a whole, in the order: part, then links.
#ifndef SCREE_IO_RUN_FILE_H
#define SCREE_IO_RUN_FILE_H

#include "base/notes.h"
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
/// Opens run.h5 and finds snapshot number `which` of those that it holds: its index and its group. What is wrong is in
/// run->status: SCREE_ERROR_INPUT when there are not so many.
void scree_run_file_open_snapshot(scree_hdf5 *run, const char *path, size_t which, int64_t *index, char *group,
                                  size_t size, scree_error *error);

/// Opens DIRECTORY/run.h5 to read. When its checksum is broken it is opened all the same, since every part of it has a
/// checksum of its own: look at groups with scree_hdf5_verify before they are copied. *sound: the checksum is whole. A
/// file that cannot be opened has run->status and run->damaged set.
void scree_run_file_open(scree_hdf5 *run, const char *path, bool *sound, scree_error *error);

/// What a run that goes on keeps.
typedef struct scree_kept {
    int64_t snapshots;                         ///< those with numbers below it
    int64_t first_checkpoint, last_checkpoint; ///< those in between, both included
} scree_kept;
#define SCREE_KEEP_ALL                                                                                                 \
    (scree_kept)                                                                                                       \
    {                                                                                                                  \
        INT64_MAX, 0, INT64_MAX                                                                                        \
    }

/// Writes run.h5 anew with a link for each part that is kept, of checkpoints the newest ones. What a finished run.h5
/// holds itself is put back into parts first; what of it is damaged is left out, with a note, and the file is kept as
/// run.h5.damaged. `case_name` NULL: as it was. Errors: SCREE_ERROR_IO, memory.
scree_status scree_run_file_renew(const char *directory, const char *case_name, const scree_kept *kept,
                                  scree_notes *notes, scree_error *error) SCREE_MUST_USE;

/// Before a run goes on: looks at every part, sets aside what is damaged (NAME.damaged, with a note), drops what is not
/// kept and renews run.h5. Errors: SCREE_ERROR_IO, memory.
scree_status scree_run_file_rewind(const char *directory, const char *case_name, const scree_kept *kept,
                                   scree_notes *notes, scree_error *error) SCREE_MUST_USE;

/// Renames a damaged part to NAME.damaged, with a note that holds `reason`. Errors: SCREE_ERROR_IO.
scree_status scree_part_set_aside(const char *directory, scree_part_kind kind, int64_t index, const char *reason,
                                  scree_notes *notes, scree_error *error) SCREE_MUST_USE;

/// Removes a part. Errors: SCREE_ERROR_IO.
scree_status scree_part_remove(const char *directory, scree_part_kind kind, int64_t index,
                               scree_error *error) SCREE_MUST_USE;

/// Flushes the names in DIRECTORY/parts, where there is one. Errors: SCREE_ERROR_IO.
scree_status scree_parts_sync(const char *directory, scree_error *error) SCREE_MUST_USE;

/// The end of a run: everything into one self-contained run.h5, parts removed. What is damaged is left out, with a note
/// (`notes` may be NULL). Killed at any moment, or out of disk space, it leaves what was there before. Calling it again
/// is harmless.
scree_status scree_run_file_finish(const char *directory, scree_notes *notes, scree_error *error) SCREE_MUST_USE;

/// Name of the case in run.h5; empty where there is none, or where it is damaged. Errors: memory.
scree_status scree_run_file_case_name(const char *path, char *name, size_t size, scree_error *error) SCREE_MUST_USE;
/// A run.h5 in memory with its attributes and empty groups.
void scree_run_file_create(scree_hdf5 *run, const char *path, const char *case_name, scree_error *error);

#endif
