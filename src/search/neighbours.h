/// Neighbour list with a skin on a cell grid: linear cost, polydisperse, sorted along a space-filling curve.
#ifndef SCREE_SEARCH_NEIGHBOURS_H
#define SCREE_SEARCH_NEIGHBOURS_H

#include "state/work.h"

/// Rebuilds the list if a body may have moved more than half the skin (or work->valid is false): re-sorts the rows
/// along the curve, finds all pairs with |x_i - x_j| < R_i + R_j + skin, carries the histories of touching pairs over
/// by id (from the old list, or from state->contact when there is none), and does the same for body-wall pairs. Called
/// after every drift. The largest |v| of any body times dt is subtracted from work->budget (search/moved.h); walls are
/// watched here. Pairs are ordered along the curve by the lower of their rows, touching pairs first; wall pairs by row,
/// then wall. Behind the last pair there are 16 more entries that may be read (row 0). After a rebuild
/// state->contact means nothing: its rows are in the list. Positions that are not finite raise SCREE_FLAG_NAN with the
/// smallest such id. Errors: memory; the histories are safe then, and the call can be repeated.
scree_status scree_neighbours_refresh(const scree_model *model, scree_state *state, scree_work *work,
                                      scree_error *error) SCREE_MUST_USE;

/// Whether pairs that are held, or, where the state is a part, bodies that sleep, have changed in this process since the
/// list was made: it is due then in all of them.
bool scree_neighbours_are_due(const scree_state *state, const scree_work *work);

/// Forces a rebuild at the next refresh; histories are kept (they must have been saved if `work` is about to go).
void scree_neighbours_invalidate(scree_work *work);

/// Frees the list and what making it needs, when the bodies have become much fewer. Histories must have been saved.
void scree_neighbours_release(scree_work *work);

/// Empty work with the default skin of `model`, to be used with `threads` threads. Errors: memory.
scree_status scree_work_create(scree_work *work, const scree_model *model, int threads,
                               scree_error *error) SCREE_MUST_USE;
/// Frees everything but contact_scratch, which contact/ owns.
void scree_work_destroy(scree_work *work);

#endif
