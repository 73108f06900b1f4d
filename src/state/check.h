/// Values of a state that was read, before they are believed.
#ifndef SCREE_STATE_CHECK_H
#define SCREE_STATE_CHECK_H

#include "state/state.h"

/// What several processes know of the bodies that one of them names (comm/known.h), by ascending ids.
typedef struct scree_known_body {
    uint32_t id;
    int32_t material; ///< negative: nobody has this body
} scree_known_body;
typedef struct scree_known_bodies {
    scree_known_body *body;
    size_t count;
} scree_known_bodies;

/// Order of known bodies, for qsort and bsearch: by ids.
int scree_known_body_compare(const void *a, const void *b);

/// Whether every value is one that a run of `model` can have: finite, in its range, ids that exist, lengths that agree.
/// row_of_id must be valid (ids are a permutation). `known`: of all bodies that a part names; NULL: the state is whole.
/// Errors: SCREE_ERROR_IO with dataset, row and value.
scree_status scree_state_check(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                               scree_error *error) SCREE_MUST_USE;

/// The bodies that fields name, one after the other, as often as they do: calls `name` with each id. Ids may be any.
void scree_state_each_named(const scree_state *state, void (*name)(void *context, uint32_t id), void *context);

#endif
