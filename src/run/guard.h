/// Guards: what stops a run that has left physics.
#ifndef SCREE_RUN_GUARD_H
#define SCREE_RUN_GUARD_H

#include "run/simulation_data.h"

/// Of a part: what any process has flagged, all have. Without an alarm, and where no pass flags bodies behind the
/// contact forces (`late`), nothing has been flagged but what all know.
void scree_guard_join(const scree_state *state, scree_work *work, bool late);

/// Looks at the flags that kernels and integrators raised in this step.
scree_status scree_guard_step(const scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Looks at the energy ledger and at escaped bodies; called at samples.
scree_status scree_guard_sample(const scree_simulation *s, double relative_residual, scree_error *error) SCREE_MUST_USE;

#endif
