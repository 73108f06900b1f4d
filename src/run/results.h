/// The named scalars of summary.json.
#ifndef SCREE_RUN_RESULTS_H
#define SCREE_RUN_RESULTS_H

#include "run/recorder.h"

/// Above this share the log warns.
#define SCREE_STIFFNESS_SHARE 0.01

/// What changes of stiffness have put into tangential springs, over the energy at the begin and the work turned over.
double scree_results_stiffness_share(const scree_state *state);

/// Writes summary.json from series.csv (so that a restarted run gives the same) and the final state. `status` is how
/// the run ended.
scree_status scree_results_write(const scree_recorder *recorder, scree_simulation *s, scree_status status,
                                 scree_error *error) SCREE_MUST_USE;

#endif
