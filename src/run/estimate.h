/// What a run of a case will take: steps, processor time, memory.
#ifndef SCREE_RUN_ESTIMATE_H
#define SCREE_RUN_ESTIMATE_H

#include "model/model.h"
#include "run/probe.h"

/// Steps and files of a stage.
typedef struct scree_stage_cost {
    double steps;     ///< force evaluations
    double samples;   ///< rows of series.csv
    double snapshots; ///< those at its ends included
} scree_stage_cost;

typedef struct scree_run_cost {
    double steps;                     ///< of all stages
    double stepping, output, figures; ///< s, processor time of one thread
    double preparation;               ///< s, of the stepping
    double lists;                     ///< s, beside it: of several processes, pairs of the whole where it is looked at
    double rate;                      ///< particle-steps a second of the stepping; NAN without steps
    double memory;                    ///< bytes, peak
} scree_run_cost;

/// What stage `index` of the model's case will take, a stage `collide` that lasts `collision` [s].
scree_stage_cost scree_stage_expect(const scree_model *model, int64_t index, double collision);

/// The stage after the first that takes most steps; the first when there is no other.
int64_t scree_longest_stage(const scree_model *model);

/// The whole run, with the speeds that were probed. looks_at_samples: columns of series.csv need the whole sample.
void scree_run_expect(const scree_model *model, const scree_probe *probe, bool looks_at_samples, scree_run_cost *cost);

/// Peak of the memory [bytes] of the run.
double scree_memory_expect(const scree_model *model);

/// The same of a process that computes it together with others: of one that has `bodies` of its own and knows `ghosts`
/// of others; of process 0 (`root`), which prepares the whole, puts it together, writes and draws.
double scree_rank_memory_expect(const scree_model *model, double bodies, double ghosts, bool root);

#endif
