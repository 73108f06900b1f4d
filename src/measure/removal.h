/// Bodies that are taken out of a run.
#ifndef SCREE_MEASURE_REMOVAL_H
#define SCREE_MEASURE_REMOVAL_H

#include "state/work.h"

/// Takes the bodies with these ids out between two steps, with all that they exert: the sums of the others, the forces
/// on walls and the virial of a periodic cell lose their part, contacts and ids are forgotten (scree_state_remove), and
/// the ledger takes what they had, so that the balance of energies stays closed (scree_ledger.removed). The neighbour
/// list is made anew. Errors: SCREE_ERROR_INPUT: no such body, one twice, one that a module keeps; the state is
/// unchanged then; memory. Cost: that of a rebuild and two contact tables: take many out at once.
scree_status scree_bodies_remove(const scree_model *model, scree_state *state, scree_work *work, const uint32_t *ids,
                                 size_t count, scree_error *error) SCREE_MUST_USE;

#endif
