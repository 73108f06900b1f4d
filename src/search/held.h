/// Pairs of the persistent list (state/persistent.h) in the neighbour list: its first section.
#ifndef SCREE_SEARCH_HELD_H
#define SCREE_SEARCH_HELD_H

#include "search/pair_search.h"
#include "state/work.h"

/// A member with the rows that it joins, of bodies or ghosts; first is that with the lower id.
typedef struct scree_held_pair {
    uint32_t first, second;
    uint32_t member; ///< number in the persistent list
} scree_held_pair;

typedef struct scree_held_buffer {
    scree_held_pair *pair; ///< along the curve: by the lower row, then by number
    size_t count, capacity;
    uint64_t changes; ///< of the persistent list, when this was made
} scree_held_buffer;

/// Whether members were added or removed since the list was made.
bool scree_held_changed(const scree_state *state, const scree_held_buffer *buffer);

/// Drops pairs that are held from what a search has found; the order stays.
void scree_held_drop(const scree_state *state, scree_pair_buffer *buffer);

/// Finds the rows of all members, the nearest ghosts in a periodic cell, and makes ghosts where one is missing; to be
/// called when the near pairs are found. Errors: memory; SCREE_ERROR_GUARD: a pair longer than half of the cell, or
/// longer by far than in the step before, in a part; SCREE_ERROR_INPUT: members that the law cannot hold.
scree_status scree_held_find(const scree_model *model, scree_state *state, scree_work *work, scree_held_buffer *buffer,
                             scree_error *error) SCREE_MUST_USE;

/// Puts them into the first rows of the list, which has room, with what they remember. Errors: memory.
scree_status scree_held_list(const scree_state *state, const scree_held_buffer *buffer, scree_pair_list *pairs,
                             scree_error *error) SCREE_MUST_USE;

/// Copies what held pairs remember from the list back to the members that are still there.
void scree_held_collect(scree_state *state, const scree_work *work);

#endif
