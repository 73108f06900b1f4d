/// A simulation in memory, from its begin to its end.
#ifndef SCREE_RUN_SIMULATION_H
#define SCREE_RUN_SIMULATION_H

#include "run/stage.h"

/// The model of a case. Errors: scree_model_build's, at their place in the case.
scree_status scree_case_model(const scree_case *c, scree_model *model, scree_error *error) SCREE_MUST_USE;

/// Builds model and work; the first stage has not begun. Errors: model_build's, memory.
scree_status scree_simulation_open(const scree_case *c, int threads, scree_simulation *s,
                                   scree_error *error) SCREE_MUST_USE;
void scree_simulation_close(scree_simulation *s);

/// Begins the stage in state.stage.index (a new stage), or takes it up again after a restart.
scree_status scree_stage_enter(scree_simulation *s, bool restart, scree_error *error) SCREE_MUST_USE;

/// One step with all that hangs on it: sample when due, end of the stage. A stage that has ended stays the present one
/// until the next call, which begins the next stage, and is no step. Sets sampled, stage_ended; after the last stage
/// `stage` becomes NULL and state.stage.index the number of stages.
scree_status scree_simulation_step(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

#endif
