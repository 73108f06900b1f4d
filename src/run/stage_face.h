/// Stages: one file a kind (stage_*.c), whose module has this face.
#ifndef SCREE_RUN_STAGE_FACE_H
#define SCREE_RUN_STAGE_FACE_H

#include "boundary/periodic.h"
#include "boundary/plates.h"
#include "measure/delaunay_boundary.h"
#include "state/work.h"

typedef struct scree_simulation scree_simulation;

/// What a stage needs at every step and can be derived from the state at its begin (so it is not stored).
typedef struct scree_stage_plan {
    uint64_t interval; ///< ticks between two samples, whole largest steps
    uint64_t expected; ///< ticks of the whole stage, whole largest steps; 0: not known in advance
    double ramp_time;  ///< s
    double time_limit; ///< s
} scree_stage_plan;

typedef struct scree_stage {
    const char *name;
    bool instant;       ///< ends as soon as it has begun (no steps)
    bool loading;       ///< samples of this stage have a strain, and snapshots are evenly spaced in it
    bool quasistatic;   ///< means to be
    int samples_a_wave; ///< samples in a wave time of the sample; 0: evenly over the stage

    // ---- asked before the stage begins; `config` is its own struct. Each may be NULL ----
    /// Time [s] at its full rate, of the sample that the model expects. NULL: not known.
    double (*duration)(const scree_model *model, const void *config);
    /// Time [s] that it is planned to last, where a wave goes through the sample in `wave` [s]. NULL: none.
    double (*planned)(const scree_model *model, const void *config, double wave);
    /// Makes it fit a case of `count` particles only.
    void (*shrink)(void *config, int64_t count);
    /// Time [s] that it takes, which is known when it has begun. NULL: as planned.
    double (*expected)(const scree_simulation *s);

    // ---- while a simulation is in it ----
    /// Strain that the stage imposes, as far as it has come. NULL: none.
    double (*strain)(const scree_simulation *s);
    /// Strain rate [1/s] that it has come to, or will. NULL: that which its numbers say (module/stage.h).
    double (*rate)(const scree_simulation *s);
    /// Once, when the stage begins: what the sample is like now goes into its own state. NULL: nothing to do.
    scree_status (*begin)(scree_simulation *s, scree_error *error);
    /// Derives the plan from the state; at begin and after a restart. NULL: for instant stages alone.
    void (*plan)(scree_simulation *s);
    /// Every step, before the plates move: velocities of plates, pressure. NULL: nothing to do.
    void (*control)(scree_simulation *s);
    /// Whether `control` looks at all bodies in this step (module/pass.h). NULL: never.
    bool (*control_whole)(const scree_simulation *s);
    /// At every sample: has the stage ended? Then writes the reason. May fail: time limit. NULL: for instant
    /// stages alone.
    scree_status (*finished)(scree_simulation *s, bool *done, scree_error *error);
    /// Fraction done, NAN when not known. NULL: never known.
    double (*fraction)(const scree_simulation *s);
} scree_stage;

#endif
