/// Which process has a body, for processes that cannot know: each keeps the answers for a range of ids.
#ifndef SCREE_COMM_DIRECTORY_H
#define SCREE_COMM_DIRECTORY_H

#include "state/state.h"

typedef struct scree_directory {
    size_t ids;       ///< that were ever given
    size_t begin;     ///< this process keeps those from here on,
    size_t count;     ///< so many
    int32_t *process; ///< of each of them; negative: nobody has it
} scree_directory;

/// process[row]: what is said of the body in a row. All processes call it. Errors: memory; SCREE_ERROR_IO, in all
/// processes: an id is that of two bodies, or was never given. Cost: 8 bytes a body are sent, and 4 an id kept.
scree_status scree_directory_open(scree_directory *directory, const scree_state *state, const int32_t *process,
                                  scree_error *error) SCREE_MUST_USE;
void scree_directory_close(scree_directory *directory);

/// process[k]: what was said of the body id[k], negative of one that nobody has. Where it is not negative already it
/// stays, and nobody is asked. All processes call it. Errors: memory.
scree_status scree_directory_ask(const scree_directory *directory, const uint32_t *id, size_t count, int32_t *process,
                                 scree_error *error) SCREE_MUST_USE;

#endif
