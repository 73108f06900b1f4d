/// What belongs to two bodies and goes with them from process to process: what contacts remember, and groups of
/// modules whose rows are of pairs (module/field.h). The first array of a set begins each element with the two ids.
#ifndef SCREE_COMM_PAIR_SETS_H
#define SCREE_COMM_PAIR_SETS_H

#include "state/store.h"
#include "state/work.h"

typedef struct scree_pair_set {
    scree_body_array list[4]; ///< one element a pair; all processes have the same ones
    size_t arrays;
    size_t *count, *total; ///< elements that are here, of all processes; total NULL: nobody asks
    const scree_module *owner;
    const scree_group *group; ///< NULL: contacts
} scree_pair_set;

enum { SCREE_PAIR_SETS = 4 }; ///< at most

/// The sets of a state. Errors: memory.
scree_status scree_pair_sets_list(scree_state *state, const scree_work *work, scree_pair_set set[SCREE_PAIR_SETS],
                                  size_t *sets, scree_error *error) SCREE_MUST_USE;

/// Room for `count` elements. Errors: memory.
scree_status scree_pair_set_reserve(scree_state *state, const scree_pair_set *set, size_t count,
                                    scree_error *error) SCREE_MUST_USE;

/// Ids of the bodies of element `k`; of a wall the second is what contacts have of it.
void scree_pair_set_ids(const scree_pair_set *set, size_t k, uint32_t id[2]);

/// Whether the first body of element `k` is here: elements lie with both of their bodies where there is no list, and
/// count where this says so.
bool scree_pair_set_counts(const scree_state *state, const scree_pair_set *set, size_t k);

/// Puts the rows of a group into the order of their ids; contacts have none.
void scree_pair_set_sort(const scree_pair_set *set);

#endif
