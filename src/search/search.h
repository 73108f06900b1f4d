/// Private to search/ (and its tests): everything that the neighbour list needs besides the list itself.
#ifndef SCREE_SEARCH_SEARCH_H
#define SCREE_SEARCH_SEARCH_H

#include "search/fast.h"
#include "search/held.h"
#include "search/pair_search.h"
#include "state/plates.h"
#include "state/work.h"

/// Entries behind the last one that kernels may read ahead; they hold row 0 and zero histories.
#define SCREE_PAIR_PADDING 16

struct scree_search {
    scree_cell_grid grid;
    scree_pair_chunk *chunk; ///< one a thread
    int chunks;
    scree_pair_chunk ghosts;           ///< pairs with ghosts of a periodic cell
    scree_held_buffer held;            ///< pairs of the persistent list
    scree_fast fast;                   ///< bodies with skins of their own
    bool listed;                       ///< the list in `work` is whole and holds the contact histories
    size_t bodies;                     ///< in the list
    uint64_t changes;                  ///< of the state, when it was made
    scree_wall wall[SCREE_WALL_COUNT]; ///< as they were at the last rebuild
    uint64_t surface_ticks;            ///< of the walls of the case, then
    // histories on their way to the new list: entries of state->contact by the lower of their two rows
    uint32_t *entry_begin; ///< bodies + 1
    uint32_t *entry;
    size_t entry_begin_capacity, entry_capacity;
    uint8_t *part; ///< of each pair, while the list is put in another order (search/sections.c)
    size_t part_capacity;
};

/// Appends the bodies of rows [begin, end) with the elements of the walls of the case that are closer than R + skin, by
/// row, then element; of fast ones with their own. `wall_set` may be NULL. Errors: memory.
scree_status scree_primitives_search(const scree_wall_set *wall_set, const scree_state *state, size_t begin, size_t end,
                                     double skin, const scree_fast *fast, scree_pair_buffer *buffer,
                                     scree_error *error) SCREE_MUST_USE;

/// Says how many pairs each section of the list has: the held ones, those of each law, and those of each that sleep.
void scree_pair_sections_cut(const scree_model *model, const scree_state *state, scree_work *work);

/// Puts the pairs that were found into their sections: those of bodies, then those with ghosts, in each part. Those
/// that are held are there.
void scree_pair_sections_fill(const scree_model *model, const scree_state *state, scree_work *work);

/// Puts the pairs of the list into other sections where bodies have fallen asleep or woken since it was made. Cost: 2 ns
/// a pair, 50 ns one that changes its section. Errors: memory; the list is as it was then.
scree_status scree_pair_sections_renew(const scree_model *model, const scree_state *state, scree_work *work,
                                       scree_error *error) SCREE_MUST_USE;

/// Frees the lists of pairs and of wall pairs.
void scree_pair_lists_destroy(scree_work *work);

/// Copies the rows of the list that are not zero to state->contact (last_force, rolling), with ids. Errors: memory.
scree_status scree_histories_collect(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Sorts the entries of state->contact by rows, for scree_history_find. Entries with unknown ids are left out.
scree_status scree_histories_index(scree_search *search, const scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Number in state->contact of a pair of ids with the lower row `row` (the body's, for a wall); contact_count if there
/// is none.
static inline size_t scree_history_find(const scree_search *search, const scree_state *state, uint32_t row,
                                        uint32_t first, uint32_t second)
{
    for (uint32_t k = search->entry_begin[row]; k < search->entry_begin[row + 1]; k++) {
        const scree_contact_memory *memory = &state->contact[search->entry[k]];
        if (memory->first == first && memory->second == second) return search->entry[k];
    }
    return state->contact_count;
}

#endif
