/// What a run goes on from.
#ifndef SCREE_RUN_RESTART_H
#define SCREE_RUN_RESTART_H

#include "io/snapshot.h"
#include "run/simulation.h"

/// The case of a run directory; all its problems fit into one error, the first.
scree_status scree_restart_case(const char *directory, scree_case **c, scree_error *error) SCREE_MUST_USE;

/// Whether every value of `state` is one that the run of `s` can have. All processes call it. Errors: SCREE_ERROR_IO
/// with dataset, row, value.
scree_status scree_restart_check(const scree_simulation *s, const scree_state *state,
                                 scree_error *error) SCREE_MUST_USE;

/// The same for one point, with the rows that it counts on. The state stays in `s`.
scree_status scree_restart_try(scree_simulation *s, const char *directory, uint64_t checksum,
                               const scree_restart_point *point, scree_error *error) SCREE_MUST_USE;

/// Reads what the run goes on from into the state of `s`, which is open and has none: whole, with values that a run of
/// this case can have, and with its rows in series.csv. `from` NULL: the newest checkpoint, else an older
/// one, else a snapshot, with a note when it is not the first; else the number of a snapshot, or "latest". *used says
/// what it was. Errors: SCREE_ERROR_INPUT when there is no such thing or it belongs to another case, SCREE_ERROR_IO
/// when it cannot be used; memory.
scree_status scree_restart_read(scree_simulation *s, const char *directory, const char *from, uint64_t checksum,
                                scree_restart_point *used, scree_notes *notes, scree_error *error) SCREE_MUST_USE;

/// Takes the folder back to `used`: what came after it is dropped, what is damaged is set aside with a note. A snapshot
/// becomes the newest checkpoint first. Rows are cut when the series are opened. All processes call it. Errors:
/// SCREE_ERROR_IO, memory.
scree_status scree_restart_rewind(scree_simulation *s, const char *directory, uint64_t checksum,
                                  const scree_restart_point *used, scree_notes *notes,
                                  scree_error *error) SCREE_MUST_USE;

#endif
