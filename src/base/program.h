/// Another program as a process of its own, run to its end.
#ifndef SCREE_BASE_PROGRAM_H
#define SCREE_BASE_PROGRAM_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct scree_program {
    const char *folder;           ///< in which it runs
    const char *const *arguments; ///< its name, which is looked for in PATH, and what it is given; NULL ends
    const char *log;              ///< file in the folder that takes what it prints; NULL: none
} scree_program;

/// What became of it.
typedef struct scree_program_end {
    bool done;      ///< it ended with status 0
    bool missing;   ///< it was started, but could not become the program
    char said[600]; ///< the beginning of what it printed, in one line; empty with a log
} scree_program_end;

/// Runs a program without a shell and without input, and waits for it. Errors (SCREE_ERROR_IO, errno is set): it cannot
/// be started, which may be a folder that is not there.
scree_status scree_program_run(const scree_program *program, scree_program_end *end, scree_error *error) SCREE_MUST_USE;

/// The first program of this name in PATH, as a path; false: there is none.
bool scree_program_find(const char *name, char *path, size_t room);

/// Whether PATH has a program of this name.
bool scree_program_is_there(const char *name);

#endif
