/// Search for pairs in a filled cell grid: a range of rows at a time, into buffers of its own.
#ifndef SCREE_SEARCH_PAIR_SEARCH_H
#define SCREE_SEARCH_PAIR_SEARCH_H

#include "search/cell_grid.h"

typedef struct scree_row_pair {
    uint32_t first, second; ///< rows with id[first] < id[second]; for a wall its index is second
} scree_row_pair;

typedef struct scree_pair_buffer {
    scree_row_pair *pair;
    size_t count, capacity;
} scree_pair_buffer;

/// What the search of one range of rows finds.
typedef struct scree_pair_chunk {
    scree_pair_buffer touching; ///< |x_i - x_j| < R_i + R_j
    scree_pair_buffer near;     ///< the others with |x_i - x_j| < R_i + R_j + skin
    scree_pair_buffer wall;     ///< distance < R + skin
    scree_pair_buffer element;  ///< the same of the walls of the case
    uint64_t candidates;        ///< slots looked at
    uint64_t carried;           ///< histories of this chunk of the old list
} scree_pair_chunk;

/// Refills `chunk` with the pairs found from rows [begin, end): each pair of bodies of one level from the lower row, of
/// different levels from the body of the lower level, in the order of these rows. Errors: memory.
typedef scree_status scree_pair_search(const scree_cell_grid *grid, const scree_state *state, size_t begin, size_t end,
                                       scree_pair_chunk *chunk, scree_error *error);

/// The search compiled for `instruction_set` (0: best of this machine; 2, 3, 4: x86-64-v2, v3, v4). All find the same.
scree_pair_search *scree_pair_search_get(int instruction_set);

void scree_pair_chunk_destroy(scree_pair_chunk *chunk);

#if defined(__x86_64__)
scree_pair_search scree_pair_search_v2, scree_pair_search_v3, scree_pair_search_v4;
#else
scree_pair_search scree_pair_search_v0;
#endif

#endif
