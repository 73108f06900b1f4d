/// Values of a state that was read, before they are believed.
#ifndef SCREE_STATE_CHECK_H
#define SCREE_STATE_CHECK_H

#include "state/state.h"

/// Whether every value is one that a run of `model` can have: finite, in its range, ids that exist, lengths that agree.
/// row_of_id must be valid (ids are a permutation). Errors: SCREE_ERROR_IO with dataset, row and value.
scree_status scree_state_check(const scree_state *state, const scree_model *model, scree_error *error) SCREE_MUST_USE;

#endif
