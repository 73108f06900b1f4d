/// The step: a list of passes that is made when a stage begins.
#ifndef SCREE_RUN_STEP_H
#define SCREE_RUN_STEP_H

#include "run/simulation_data.h"

/// Puts the passes of the stage that has begun into s->passes.
void scree_step_compile(scree_simulation *s);

/// One step. Errors: a pass's, the guard's.
scree_status scree_step(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// The passes of one phase alone, to see what they cost.
scree_status scree_step_phase(scree_simulation *s, scree_phase phase, scree_error *error) SCREE_MUST_USE;

#endif
