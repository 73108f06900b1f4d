/// Status codes and the error record of the public interface.
#ifndef SCREE_ERROR_H
#define SCREE_ERROR_H

#include <scree/api.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The values are the exit status of the command line.
typedef enum scree_status {
    SCREE_OK = 0,
    SCREE_ERROR_INPUT = 2,   ///< the user's input is wrong
    SCREE_ERROR_GUARD = 3,   ///< a physics guard stopped the run
    SCREE_ERROR_IO = 4,      ///< input/output failed, or memory ran out
    SCREE_INTERRUPTED = 130, ///< stopped by a signal, after a checkpoint
} scree_status;

/// One problem, caller-owned, no allocation. Empty strings and zeros mean "does not apply".
typedef struct scree_error {
    scree_status status;
    int line;           ///< 1-based position in `file`
    int column;         ///< 1-based
    char file[256];     ///< case file, or the file that input/output failed on
    char field[160];    ///< key path, e.g. "stages.2.rate"
    char value[160];    ///< what was given
    char accepted[256]; ///< what is accepted: type, unit, range, or the nearest valid key
    char message[1024]; ///< a whole sentence for a person
} scree_error;

/// Writes "file:line:column: field: message (accepted: ...)", without what the message itself suggests in quotes, into
/// `text` (NUL-terminated, truncated to `size`). Returns the length that the whole text would have.
SCREE_API size_t scree_error_format(const scree_error *error, char *text, size_t size);

#ifdef __cplusplus
}
#endif
#endif
