/// Everything that a run writes while it goes on: series, snapshots, ParaView files, checkpoints, log, progress.
#ifndef SCREE_RUN_RECORDER_H
#define SCREE_RUN_RECORDER_H

#include "base/log.h"
#include "io/series.h"
#include "run/quasistatic.h"
#include "run/rank_counts.h"
#include "run/simulation.h"

typedef struct scree_recorder {
    const scree_run_options *options;
    const char *directory;
    bool writes; ///< this process writes the files (run/ranks.h)
    scree_log log;
    scree_series_writer series;
    scree_quasistatic_watch watch;
    uint64_t case_checksum;
    double started;    ///< s, monotonic clock at the begin of this process's part of the run
    double clocked[2]; ///< s, until when the state's time is counted: wall, processor
    double last_progress, last_checkpoint, last_threads;
    int threads; ///< as the log has it
    uint64_t progress_step, progress_evaluations, checkpoint_evaluations;
    uint64_t first_evaluations; ///< at `started`
    double stepping;            ///< s of wall time in the stepping loop
    scree_rank_counts counts;   ///< of all processes, when the stepping loop has ended
} scree_recorder;

/// Opens log and series in a run directory that exists; rows > 0 or restart: continues the series after `rows` rows.
scree_status scree_recorder_open(scree_recorder *recorder, const scree_simulation *s, const scree_run_options *options,
                                 const char *directory, bool restart, scree_error *error) SCREE_MUST_USE;
void scree_recorder_close(scree_recorder *recorder);

/// After every step: writes what is due.
scree_status scree_recorder_follow(scree_recorder *recorder, scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Counts the wall time since the last call into the state.
void scree_recorder_clock(scree_recorder *recorder, scree_simulation *s);

/// Writes a checkpoint now.
scree_status scree_recorder_checkpoint(scree_recorder *recorder, scree_simulation *s,
                                       scree_error *error) SCREE_MUST_USE;

/// Writes a snapshot of a state that a guard has stopped, for inspection; a restart writes over it.
scree_status scree_recorder_last_look(scree_recorder *recorder, scree_simulation *s, scree_error *error) SCREE_MUST_USE;

#endif
