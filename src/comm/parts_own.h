/// What the files of the parts of a sample share (parts.c, whole.c).
#ifndef SCREE_COMM_PARTS_OWN_H
#define SCREE_COMM_PARTS_OWN_H

#include "comm/pair_sets.h"
#include "comm/parts.h"

/// Makes work->parts, if there is none yet. Errors: memory.
scree_status scree_parts_open(scree_work *work, scree_error *error) SCREE_MUST_USE;

/// The ghosts of the last list are void.
void scree_parts_forget_ghosts(scree_work *work);

/// Cuts space anew by the places of all bodies and their weights, weight[row] (NULL: all weigh alike). Errors: memory,
/// the library's.
scree_status scree_parts_cut(const scree_state *state, scree_parts *parts, const float *weight,
                             scree_error *error) SCREE_MUST_USE;

/// to[row]: the process in whose part the body of the row lies.
void scree_parts_choose(const scree_state *state, scree_parts *parts, int32_t *to);

/// Element `from` of each array becomes element `to`.
void scree_parts_move_element(const scree_body_array *list, size_t arrays, size_t from, size_t to);

/// Leaves the rows that stay here, to[row] is this process, in their order. Ids have to be given their rows anew.
void scree_parts_keep_rows(scree_state *state, const scree_body_array *list, size_t arrays, const int32_t *to);

/// Counts bodies with each mark.
void scree_parts_count_marks(scree_state *state);

/// The processes that the two bodies of element `k` of a set are with, end[0] and end[1]; a wall is with the body. `to`
/// says it of rows; SCREE_PARTS_NOBODY of a body that is not here.
enum { SCREE_PARTS_NOBODY = -1 };
void scree_parts_ends(const scree_state *state, const scree_pair_set *set, const int32_t *to, size_t k, int32_t end[2]);

/// Leaves the elements of a set of which one end is here, in their order; ends[2 k] and ends[2 k + 1] are those of
/// element k.
void scree_parts_keep_pairs(const scree_pair_set *set, const int32_t *ends);

/// Each element goes to the processes of both of its ends, and stays nowhere else. Errors: memory.
scree_status scree_parts_move_pairs(scree_state *state, const scree_pair_set *set, const int32_t *ends,
                                    scree_error *error) SCREE_MUST_USE;

/// The body of each row goes to to[row], with its elements of the arrays, those of the state and `relative` of a cell
/// in motion. Errors: memory.
scree_status scree_parts_move_rows(scree_state *state, scree_work *work, const int32_t *to,
                                   scree_error *error) SCREE_MUST_USE;

#endif
