/// One time step of a simulation.
#ifndef SCREE_RUN_STEP_H
#define SCREE_RUN_STEP_H

#include "run/simulation.h"

/// Advances the state from n to n + 1. Leaves valid: positions, velocities, sums, walls, ledger at n + 1.
/// Errors: memory; SCREE_ERROR_GUARD with the body, the reason and what to try.
scree_status scree_step(scree_simulation *s, scree_error *error) SCREE_MUST_USE;

#endif
