/// Selections: grains under a name, for what acts on some of them. A kind of selection is a module with this face; it
/// has one function, which says what belongs to it.
///
/// A selection is found once, when a stage begins that needs it first, from what the sample is like then; who belongs
/// to it is state from then on (one bit a body) and stays as the bodies move. Bodies that come later belong to none
/// that has been found. Bodies of a membrane never do.
#ifndef SCREE_SELECTION_SELECTION_H
#define SCREE_SELECTION_SELECTION_H

#include "case/config.h"
#include "state/state.h"

struct scree_node;

/// One of the first two functions.
typedef struct scree_selection_kind {
    /// Sets chosen[row], which is 0, to 1 for all bodies that belong to it; what is no grain is left out afterwards.
    /// own: its struct in the config. Errors: what makes the question meaningless; memory.
    scree_status (*choose)(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                           scree_error *error);
    /// Made of other selections: whether a body belongs to it that is in those of `member` among those of `parts`, one
    /// bit each.
    bool (*combine)(uint32_t member, uint32_t parts);
    /// How many bodies it has, where the case says so. NULL: that hangs on the sample.
    size_t (*number)(const void *own);
} scree_selection_kind;

/// State of the module `selections`.
typedef struct scree_selections {
    uint32_t *member;  ///< a body: bit k: it belongs to selection k of the case; NULL until one has been found
    uint64_t resolved; ///< bit k: selection k has been found
} scree_selections;

static inline scree_selections *scree_selections_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_selections];
}

/// Finds selection `index` of the case, if it has not been found yet. Errors: SCREE_ERROR_INPUT with the field when it
/// has no body, or makes no sense here; memory.
scree_status scree_selection_resolve(const scree_model *model, scree_state *state, int64_t index,
                                     scree_error *error) SCREE_MUST_USE;

/// Whether the body in `row` belongs to selection `index`, which has been found.
static inline bool scree_selection_has(const scree_state *state, int64_t index, size_t row)
{
    return scree_selections_of(state)->member[row] >> index & 1;
}

/// The names that a selection is made of, in the case; NULL: it is not made of others (combination.c).
const struct scree_node *scree_selection_parts(const scree_config_selection *selection);

#endif
