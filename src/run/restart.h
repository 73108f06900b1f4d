/// What a run goes on from.
#ifndef SCREE_RUN_RESTART_H
#define SCREE_RUN_RESTART_H

#include "run/simulation.h"

/// The case of a run directory; all its problems fit into one error, the first.
scree_status scree_restart_case(const char *directory, scree_case **c, scree_error *error) SCREE_MUST_USE;

/// Whether every value of `state` is one that the run of `s` can have. Errors: SCREE_ERROR_IO with dataset, row, value.
scree_status scree_restart_check(const scree_simulation *s, const scree_state *state,
                                 scree_error *error) SCREE_MUST_USE;

/// Reads the newest checkpoint that can be used into the state of `s`, which is open and has none: whole, with values
/// that a run of this case can have, and with its rows in series.csv and walls.csv. Without a failure error->message
/// tells that an older one had to serve, else it is empty. Errors: those of scree_checkpoint_read.
scree_status scree_restart_read(scree_simulation *s, const char *directory, uint64_t checksum,
                                scree_error *error) SCREE_MUST_USE;

#endif
