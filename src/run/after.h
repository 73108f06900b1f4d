/// A run that begins where another one has ended a stage.
#ifndef SCREE_RUN_AFTER_H
#define SCREE_RUN_AFTER_H

#include "io/snapshot.h"
#include "run/simulation.h"

/// Where a run begins.
typedef struct scree_after {
    scree_restart_point point; ///< in the folder of the other run
    char told[512];            ///< for the log: ", behind stage confine of out"
} scree_after;

/// Reads into the state of `s`, which is open and has none, what the run in the folder options->after was at the end of
/// the last stage that it has with case `c` in common. Errors: SCREE_ERROR_INPUT when they have none in common, when no
/// such stage has ended there, and when the case makes another step or other contacts of the same keys; SCREE_ERROR_IO;
/// memory.
scree_status scree_after_read(scree_simulation *s, const scree_case *c, const scree_run_options *options,
                              scree_after *after, scree_error *error) SCREE_MUST_USE;

/// Copies rows and snapshots of that run up to there into the folder `directory`, which is made and has none. Columns
/// that only the new case has are nan. Errors: SCREE_ERROR_IO, memory.
scree_status scree_after_copy(const scree_simulation *s, const char *other, const char *directory,
                              scree_error *error) SCREE_MUST_USE;

#endif
