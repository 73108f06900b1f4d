/// Forces on trial: what contacts would exert, without a step of their memory.
#ifndef SCREE_CONTACT_TRIAL_H
#define SCREE_CONTACT_TRIAL_H

#include "state/work.h"

/// Sets the quanta and fills the sums, moments and virial of the state as scree_contact_forces does, but leaves what
/// contacts remember, what is known of walls, and the ledger as they are. Errors: memory; forces beyond the quanta.
/// Cost: an evaluation, and three copies of the memory.
scree_status scree_contact_try(const scree_model *model, scree_state *state, scree_work *work,
                               scree_error *error) SCREE_MUST_USE;

#endif
