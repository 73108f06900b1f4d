/// What is on disk of a member: its run directory, and beside it the case that it runs (.yaml) and what it printed
/// (.txt), with lines of the sweep in between. The last of these lines tells how a member that left no result ended.
#ifndef SCREE_SWEEP_MEMBER_H
#define SCREE_SWEEP_MEMBER_H

#include "sweep/sweep.h"

#include <limits.h>

typedef enum scree_member_state {
    SCREE_MEMBER_MISSING,
    SCREE_MEMBER_INTERRUPTED, ///< can be continued, or has to begin anew
    SCREE_MEMBER_DONE,
    SCREE_MEMBER_FAILED,
    SCREE_MEMBER_CHANGED, ///< the directory holds another case
} scree_member_state;

/// "done", "failed", ...
const char *scree_member_state_name(scree_member_state state);

typedef struct scree_member_paths {
    char folder[PATH_MAX]; ///< run directory
    char file[PATH_MAX];   ///< case
    char log[PATH_MAX];
} scree_member_paths;

scree_status scree_member_find(const scree_sweep *sweep, size_t member, const char *output, scree_member_paths *paths,
                               scree_error *error) SCREE_MUST_USE;

/// State of a member whose case is `c`. `reason` (may be NULL) gets the last line that it printed when it
/// failed.
scree_member_state scree_member_look(const scree_member_paths *paths, const scree_case *c, char *reason, size_t size);

/// What a member that failed printed last, by its log (.txt), or how it ended; "" where it did not fail.
void scree_member_last_words(const char *log, char *text, size_t size);

/// Whether a member in that state goes on from a whole checkpoint. One that a guard has stopped, or that would not be
/// continued the last time, begins anew.
bool scree_member_can_continue(const scree_member_paths *paths, scree_member_state state);

/// Opens the log for appending and locks it against other sweeps; a child inherits the lock, which lasts until the last
/// of them has ended. Errors: SCREE_ERROR_INPUT when another sweep runs this member; SCREE_ERROR_IO.
scree_status scree_member_open_log(const scree_member_paths *paths, int *log, scree_error *error) SCREE_MUST_USE;

/// A line of the sweep in a log.
void scree_member_note(int log, const char *format, ...) SCREE_PRINTF(2, 3);

/// How a failed run is noted; scree_member_look recognises it. One that was killed is only interrupted.
#define SCREE_MEMBER_FAILURE "failed: "
#define SCREE_MEMBER_DEATH   "killed by "

#endif
