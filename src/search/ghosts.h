/// Images of bodies across the faces of a periodic cell ("ghosts"): rows behind those of the bodies, which the pair
/// list names like any other row, so that kernels know nothing of periodicity.
#ifndef SCREE_SEARCH_GHOSTS_H
#define SCREE_SEARCH_GHOSTS_H

#include "search/pair_search.h"
#include "state/work.h"

/// Chooses the ghosts that may come closer than R_i + R_j + skin to a body while the list lives, and makes rows for
/// them, which messages fill (comm/comm.h). Rows of bodies have their final order. Errors: memory; SCREE_ERROR_GUARD
/// when the cell is narrower than two pairs of its largest bodies side by side (a pair could touch twice).
scree_status scree_ghosts_make(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// The nearest ghosts of two bodies: false when they are the bodies themselves; else the one of the second (of_second)
/// or of the first is a ghost with this shift.
bool scree_ghosts_nearest(const scree_state *state, const scree_work *work, uint32_t first, uint32_t second,
                          int shift[3], bool *of_second);

/// Row of a ghost of a body that is here. Where there is none it is made, and scree_comm_begin is due; in a part none
/// can be made any more: SCREE_NO_ROW. Errors: memory.
scree_status scree_ghosts_row(const scree_state *state, scree_work *work, uint32_t parent, const int shift[3],
                              uint32_t *row, scree_error *error) SCREE_MUST_USE;

/// Refills `chunk` with the pairs of a body and a ghost, each physical pair once. Errors: memory.
scree_status scree_ghosts_search(const scree_state *state, const scree_work *work, scree_pair_chunk *chunk,
                                 scree_error *error) SCREE_MUST_USE;

/// Deformation since the last rebuild, H H_0^-1: what bodies that do not fluctuate have followed.
void scree_ghosts_deformation(const scree_state *state, const scree_work *work, double deformation[9]);

#endif
