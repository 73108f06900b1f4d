/// Limits of stability of the specimen of a run (stability.c).
#ifndef SCREE_RUN_STABILITY_H
#define SCREE_RUN_STABILITY_H

#include "run/simulation_data.h"

/// A stage begins, or bonds or contacts have changed: the next step is preceded by a check.
void scree_stability_ask(scree_simulation *s, bool stage_begins);

/// Before a step: checks what has been asked for, if bonds hold or particles deform. Errors: SCREE_ERROR_GUARD above a
/// limit, unless the case says `guard.stability: warn`: then s->warning says it; memory.
scree_status scree_stability_check(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

#endif
