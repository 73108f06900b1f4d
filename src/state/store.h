/// Begin and end of the structs that modules keep in a state (module/module.h).
#ifndef SCREE_STATE_STORE_H
#define SCREE_STATE_STORE_H

#include "state/state.h"

/// Zeroed structs for all modules that have one. Errors: memory; close releases what there is.
scree_status scree_store_open(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Releases them with the arrays of their fields.
void scree_store_close(scree_state *state);

#endif
