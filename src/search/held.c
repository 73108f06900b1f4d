/// From ids to rows and back.
///
/// Images. A member joins the nearest ghosts of its two bodies: with the fractional coordinates f, those whose
/// difference is within half a cell in each periodic direction. That is unique, whatever whole lattice vectors bodies
/// were put back by, as long as no member is longer than half the width of the cell, which is checked. A ghost that the
/// search for near pairs did not need is made here, so ghosts reach as far as the longest member.
///
/// Cost: n log n in the members, at rebuilds; a bisection for each pair that the search finds.
#include "search/held.h"

#include "comm/comm.h"
#include "search/ghosts.h"
#include "state/periodic.h"
#include "state/persistent.h"

#include <stdlib.h>

bool scree_held_changed(const scree_state *state, const scree_held_buffer *buffer)
{
    return scree_persistent(state)->changes != buffer->changes;
}

void scree_held_drop(const scree_state *state, scree_pair_buffer *buffer)
{
    size_t kept = 0;
    if (scree_persistent(state)->count == 0) return;
    for (size_t k = 0; k < buffer->count; k++) {
        scree_row_pair pair = buffer->pair[k];
        if (scree_persistent_find(state, state->id[pair.first], state->id[pair.second]) == SIZE_MAX)
            buffer->pair[kept++] = pair;
    }
    buffer->count = kept;
}

/// A member whose bodies are farther apart than half the cell has two shortest ways.
static scree_status check_length(const scree_state *state, const scree_persistent_member *member, const double width[3],
                                 scree_error *error)
{
    scree_vector branch;
    scree_persistent_branch(state, member, branch);
    double length = scree_length(branch);
    for (int k = 0; k < state->dimension; k++)
        if (scree_periodic_repeats(scree_cell(state), k) && length >= 0.5 * width[k])
            return scree_error_set(error, SCREE_ERROR_GUARD,
                                   "step %llu: bodies %u and %u, which are held together, are %.4g m apart, more than "
                                   "half of the periodic cell, %.4g m wide along lattice vector %d: try a larger cell",
                                   (unsigned long long)state->step, member->first, member->second, length, width[k],
                                   k + 1);
    return SCREE_OK;
}

/// Rows of the two bodies of a member, one of them that of a ghost where they are across a face.
static scree_status find_rows(scree_state *state, scree_work *work, const double width[3], uint32_t number,
                              scree_held_pair *pair, scree_error *error)
{
    const scree_persistent_member *member = &scree_persistent(state)->member[number];
    const uint32_t first = scree_state_row_of(state, member->first), second = scree_state_row_of(state, member->second);
    *pair = (scree_held_pair){first, second, number};
    if (!scree_cell(state)->directions) return SCREE_OK;
    int shift[3];
    bool ghost_is_second;
    scree_status status = check_length(state, member, width, error);
    if (status || !scree_ghosts_nearest(state, work, first, second, shift, &ghost_is_second)) return status;
    return scree_ghosts_row(work, (uint32_t)state->count, ghost_is_second ? second : first, shift,
                            ghost_is_second ? &pair->second : &pair->first, error);
}

static uint32_t lower_row(const scree_held_pair *pair)
{
    return pair->first < pair->second ? pair->first : pair->second;
}

static int compare(const void *a, const void *b)
{
    const scree_held_pair *p = a, *q = b;
    uint32_t one = lower_row(p), other = lower_row(q);
    if (one != other) return one < other ? -1 : 1;
    return p->member < q->member ? -1 : p->member > q->member;
}

static scree_status reserve(scree_held_buffer *buffer, size_t count, scree_error *error)
{
    if (count <= buffer->capacity) return SCREE_OK;
    scree_release(&buffer->pair);
    buffer->capacity = 0;
    scree_status status = scree_allocate(&buffer->pair, count + count / 8, sizeof *buffer->pair, error);
    if (!status) buffer->capacity = count + count / 8;
    return status;
}

scree_status scree_held_find(const scree_model *model, scree_state *state, scree_work *work, scree_held_buffer *buffer,
                             scree_error *error)
{
    const scree_persistent_list *list = scree_persistent(state);
    double width[3];
    buffer->count = 0;
    buffer->changes = list->changes;
    if (list->count == 0) return SCREE_OK;
    if (!scree_model_holds(model))
        return scree_error_set(error, SCREE_ERROR_INPUT, "law %s cannot hold bodies together",
                               scree_modules[model->laws[0].law]->name);
    scree_status status = reserve(buffer, list->count, error);
    const size_t ghosts = work->ghosts.count;
    scree_periodic_widths(work->ghosts.lattice_inverse, width);
    for (uint32_t k = 0; k < list->count && !status; k++)
        status = find_rows(state, work, width, k, &buffer->pair[k], error);
    if (!status && work->ghosts.count > ghosts) status = scree_comm_begin(state, work, error);
    if (status) return status;
    buffer->count = list->count;
    qsort(buffer->pair, buffer->count, sizeof *buffer->pair, compare);
    return SCREE_OK;
}

scree_status scree_held_list(const scree_state *state, const scree_held_buffer *buffer, scree_pair_list *pairs,
                             scree_error *error)
{
    pairs->held_changes = buffer->changes;
    if (buffer->count > pairs->own_capacity) {
        pairs->own_capacity = 0;
        scree_release(&pairs->own);
        scree_status status = scree_allocate(&pairs->own, buffer->count + buffer->count / 8, sizeof *pairs->own, error);
        if (status) return status;
        pairs->own_capacity = buffer->count + buffer->count / 8;
    }
    for (size_t k = 0; k < buffer->count; k++) {
        const scree_held_pair *pair = &buffer->pair[k];
        const scree_persistent_member *member = &scree_persistent(state)->member[pair->member];
        pairs->first[k] = pair->first;
        pairs->second[k] = pair->second;
        pairs->history[k] = member->history;
        if (pairs->last_force) pairs->last_force[k] = member->last_force;
        if (pairs->rolling) pairs->rolling[k] = member->rolling;
        for (int i = 0; i < SCREE_MEMBER_CONSTANTS; i++) pairs->own[k].value[i] = member->constant[i];
    }
    return SCREE_OK;
}

void scree_held_collect(scree_state *state, const scree_work *work)
{
    const scree_pair_list *pairs = &work->pairs;
    for (size_t k = 0; k < scree_pairs_held(pairs); k++) {
        size_t number = scree_persistent_find(state, state->id[pairs->first[k]], state->id[pairs->second[k]]);
        if (number == SIZE_MAX) continue;
        scree_persistent_member *member = &scree_persistent(state)->member[number];
        if (member->added > work->pairs.held_changes) continue; // ended, and held anew
        member->history = pairs->history[k];
        if (pairs->last_force) member->last_force = pairs->last_force[k];
        if (pairs->rolling) member->rolling = pairs->rolling[k];
    }
}
