/// One writer at a time: the lock on a folder that Scree writes into.
///
/// The lock is flock(2) on the file `scree.lock` in the folder. The kernel gives it back when the process ends, however
/// it ends, so a killed process locks nobody out; the file that it leaves is only a text that says who it was, and the
/// next one takes it over. Programs that are started (gnuplot, members of a sweep) do not inherit it. On NFS, Linux
/// makes of it a lock on the server that holds among hosts; a mount with `nolock` or `local_lock` restricts it to one
/// host.
#ifndef SCREE_IO_FOLDER_LOCK_H
#define SCREE_IO_FOLDER_LOCK_H

#include "base/error.h"

#include <limits.h>
#include <stdbool.h>

#define SCREE_FILE_LOCK "scree.lock"

typedef struct scree_folder_lock {
    bool held;
    bool unsupported; ///< the file system has no locks: nothing is kept out
    int file;
    char path[PATH_MAX];
} scree_folder_lock;

/// Locks `directory`, which exists, for `user` ("scree run"). Release it in any case; a zeroed lock may be released.
/// Errors: SCREE_ERROR_INPUT when somebody holds it, with who that is, or when the folder does not exist;
/// SCREE_ERROR_IO when the file cannot be written.
scree_status scree_folder_lock_take(scree_folder_lock *lock, const char *directory, const char *user,
                                    scree_error *error) SCREE_MUST_USE;
void scree_folder_lock_release(scree_folder_lock *lock);

/// What is written in the lock of a folder, which no other one has; empty: nothing, or there is no lock.
void scree_folder_lock_text(const char *directory, char *text, size_t size);

/// Whether somebody holds the lock now; `who` gets what is known of them.
bool scree_folder_lock_is_held(const char *directory, char *who, size_t size);

#endif
