/// What a stage rotate_particle has found, at the end of a run.
#ifndef SCREE_RUN_ROTATION_RESULTS_H
#define SCREE_RUN_ROTATION_RESULTS_H

#include "run/conclusion.h"

#define SCREE_FILE_ROTATION_DECAY  "rotation-decay.csv"
#define SCREE_FILE_ROTATION_ROSE   "rotation-rose.csv"
#define SCREE_FILE_ROTATION_BODIES "rotation-bodies.csv"
#define SCREE_FILE_ROTATION_HANDED "rotation-handed.csv"

/// Without a forced particle: nothing. Else the scalars `forced_particle`, `rotation_...` and four tables in the run
/// directory: the bins of the decay with the fit, the rose of W, the transmission per contact by its force and its
/// direction, and every body with its distance and spin. Errors:
/// disk, memory.
scree_status scree_rotation_conclude(const scree_conclusion *run, scree_error *error) SCREE_MUST_USE;

#endif
