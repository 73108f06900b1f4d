/// Bodies that are much faster than all others have a skin of their own, so wide that their pairs last as long as those
/// of the rest: a grain that falls onto a pile does not cost the pile its list.
///
/// With v the speed of the body that SCREE_FAST others are faster than, those of them whose speed u is above 2 v have
/// the skin s u / v, at most FARTHEST s (fast.c). Pairs within R_i + R_j + (s_i + s_j) / 2, and walls within R_i + s_i,
/// are in the list; a body may move by s_i / 2 before it is made anew. None beside plates, in periodic cells, or of
/// bodies that deform. Like all of the list it changes no bit of the results. Cost: one pass over all bodies a list to
/// find them, and one more for each.
#ifndef SCREE_SEARCH_FAST_H
#define SCREE_SEARCH_FAST_H

#include "search/pair_search.h"

enum { SCREE_FAST = 16 };

typedef struct scree_fast {
    int count;
    uint32_t row[SCREE_FAST]; ///< in their order
    double skin[SCREE_FAST];  ///< m
} scree_fast;

/// Finds them; rows are those that the list will have. skin: of all others [m].
void scree_fast_find(scree_fast *fast, const scree_state *state, double skin);

/// Which of them `row` is, when it is asked for one row after the other; *next begins with 0. -1: none.
static inline int scree_fast_number(const scree_fast *fast, size_t row, int *next)
{
    while (*next < fast->count && fast->row[*next] < row) ++*next;
    return *next < fast->count && fast->row[*next] == row ? *next : -1;
}

/// Appends their pairs that are farther apart than R_i + R_j + skin, which the search does not find; `found` is what it
/// has found, in so many chunks. Errors: memory.
scree_status scree_fast_pairs(const scree_fast *fast, const scree_state *state, double skin,
                              const scree_pair_chunk *found, int chunks, scree_pair_buffer *buffer,
                              scree_error *error) SCREE_MUST_USE;

/// How far [m] each may go at least before the list must be made anew; infinite where there are none.
double scree_fast_left(const scree_fast *fast, const scree_state *state);

#endif
