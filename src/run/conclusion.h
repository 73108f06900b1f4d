/// The end of a run, as modules are told of it (`conclude` in module/module.h).
#ifndef SCREE_RUN_CONCLUSION_H
#define SCREE_RUN_CONCLUSION_H

#include "base/log.h"
#include "io/series.h"
#include "io/summary.h"
#include "run/simulation.h"

typedef struct scree_conclusion {
    const char *directory;      ///< of the run; files go there
    scree_simulation *s;        ///< the end
    const scree_series *series; ///< series.csv, so that a restarted run gives the same
    scree_summary *summary;     ///< takes the results
    scree_log *log;             ///< takes what could not be found, and is no reason to end without results
} scree_conclusion;

/// All results that modules declare: those that are measured, then those that they conclude.
scree_status scree_conclude(const scree_conclusion *run, scree_error *error) SCREE_MUST_USE;

/// Notes in `warnings` and log.txt when the elements of `what` hold few grains (average/cuts.h). It is no line on the
/// terminal: these results are told of every run, whether or not somebody wants them.
void scree_conclude_few(const scree_conclusion *run, const char *what, double grains, const char *remedy);

#endif
