/// The named scalars of summary.json.
#ifndef SCREE_RUN_RESULTS_H
#define SCREE_RUN_RESULTS_H

#include "io/summary.h"
#include "run/recorder.h"

/// Above this share the log warns.
#define SCREE_STIFFNESS_SHARE 0.01

/// What changes of stiffness have put into tangential springs, over the energy at the begin and the work turned over.
double scree_results_stiffness_share(const scree_state *state);

/// Computes the results from series.csv (so that a restarted run gives the same) and the final state, and writes the
/// tables that come with them. *summary with scree_summary_destroy, also after a failure.
scree_status scree_results_collect(const scree_recorder *recorder, scree_simulation *s, scree_summary **summary,
                                   scree_error *error) SCREE_MUST_USE;

/// Writes summary.json; `status` is how the run has ended so far.
scree_status scree_results_write(const scree_recorder *recorder, scree_summary *summary, const char *status,
                                 scree_error *error) SCREE_MUST_USE;

#endif
