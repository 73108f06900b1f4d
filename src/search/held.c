/// From ids to rows and back.
///
/// Images. A member joins the nearest ghosts of its two bodies: with the fractional coordinates f, those whose
/// difference is within half a cell in each periodic direction. That is unique, whatever whole lattice vectors bodies
/// were put back by, as long as no member is longer than half the width of the cell, which is checked. A ghost that the
/// search for near pairs did not need is made here, so ghosts reach as far as the longest member.
///
/// Parts. A member lies with the processes of both bodies until one of them finds the nearest ghost among its own and
/// those that others offered: by the rule of these (search/ghosts.c) only one does, which keeps the member.
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

/// The pair that is longest, as a share of half of the cell along one lattice vector.
typedef struct longest_pair {
    double share, first, second, length, width, direction;
} longest_pair;

/// Of the pairs of this process.
static longest_pair find_longest(const scree_state *state, const scree_work *work, const scree_held_buffer *buffer)
{
    longest_pair longest = {0};
    double width[3];
    scree_periodic_widths(work->ghosts.lattice_inverse, width);
    for (size_t p = 0; p < buffer->count; p++) {
        const scree_held_pair *pair = &buffer->pair[p];
        scree_vector from, branch;
        scree_body_position(state, pair->first, from);
        scree_body_position(state, pair->second, branch);
        for (int k = 0; k < 3; k++) branch[k] -= from[k];
        const double length = scree_length(branch);
        for (int k = 0; k < state->dimension; k++)
            if (scree_periodic_repeats(scree_cell(state), k) && length / (0.5 * width[k]) > longest.share)
                longest = (longest_pair){length / (0.5 * width[k]),
                                         state->id[pair->first],
                                         state->id[pair->second],
                                         length,
                                         width[k],
                                         k + 1};
    }
    return longest;
}

/// A member whose bodies are farther apart than half the cell has two shortest ways.
static scree_status check_lengths(const scree_state *state, const scree_work *work, const scree_held_buffer *buffer,
                                  scree_error *error)
{
    if (!scree_cell(state)->directions) return SCREE_OK;
    longest_pair longest = find_longest(state, work, buffer);
    double share = longest.share;
    scree_comm_maximum(state, &share, 1);
    if (!(share >= 1)) return SCREE_OK;
    if (longest.share < share) longest = (longest_pair){0};
    scree_comm_maximum(state, &longest.share, sizeof longest / sizeof longest.share);
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: bodies %.0f and %.0f, which are held together, are %.4g m apart, more than half "
                           "of the periodic cell, %.4g m wide along lattice vector %.0f: try a larger cell",
                           (unsigned long long)state->step, longest.first, longest.second, longest.length,
                           longest.width, longest.direction);
}

/// Ghosts of bodies of other processes, by their ids.
typedef struct away_ghosts {
    struct away_ghost {
        uint32_t id, row;
    } * ghost;
    size_t count;
} away_ghosts;

static int compare_away(const void *a, const void *b)
{
    const struct away_ghost *p = a, *q = b;
    return p->id != q->id ? (p->id < q->id ? -1 : 1) : (p->row > q->row) - (p->row < q->row);
}

static scree_status find_away(const scree_state *state, const scree_work *work, away_ghosts *away, scree_error *error)
{
    const size_t first = scree_row_count(state, work) - work->ghosts.away;
    *away = (away_ghosts){NULL, work->ghosts.away};
    scree_status status = scree_allocate(&away->ghost, away->count + 1, sizeof *away->ghost, error);
    if (status) return status;
    for (size_t k = 0; k < away->count; k++)
        away->ghost[k] = (struct away_ghost){state->id[first + k], (uint32_t)(first + k)};
    qsort(away->ghost, away->count, sizeof *away->ghost, compare_away);
    return SCREE_OK;
}

/// Row of the ghost of the body with this id that is the nearest one of the body in `row`.
static uint32_t nearest_away(const scree_state *state, const scree_work *work, const away_ghosts *away, uint32_t row,
                             uint32_t id)
{
    size_t low = 0, high = away->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (away->ghost[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < away->count && away->ghost[low].id == id; low++) {
        int shift[3];
        bool of_second;
        if (!scree_ghosts_nearest(state, work, row, away->ghost[low].row, shift, &of_second))
            return away->ghost[low].row;
    }
    return SCREE_NO_ROW;
}

/// Rows of the two bodies of a member, one of them that of a ghost where they are across a face or one is away; it has
/// none where another process evaluates them.
static scree_status find_rows(scree_state *state, scree_work *work, const away_ghosts *away, uint32_t number,
                              scree_held_pair *pair, scree_error *error)
{
    const scree_persistent_member *member = &scree_persistent(state)->member[number];
    const uint32_t first = scree_state_row_of(state, member->first), second = scree_state_row_of(state, member->second);
    *pair = (scree_held_pair){first, second, number};
    int shift[3];
    bool ghost_is_second;
    if (first == SCREE_NO_ROW)
        pair->first = nearest_away(state, work, away, second, member->first);
    else if (second == SCREE_NO_ROW)
        pair->second = nearest_away(state, work, away, first, member->second);
    else if (scree_cell(state)->directions && scree_ghosts_nearest(state, work, first, second, shift, &ghost_is_second))
        return scree_ghosts_row(state, work, ghost_is_second ? second : first, shift,
                                ghost_is_second ? &pair->second : &pair->first, error);
    return SCREE_OK;
}

/// The pairs of all members that are evaluated here. Of a part these are the members that stay.
static scree_status find_pairs(scree_state *state, scree_work *work, scree_held_buffer *buffer, scree_error *error)
{
    scree_persistent_list *list = scree_persistent(state);
    away_ghosts away = {0};
    size_t kept = 0;
    scree_status status = state->part ? find_away(state, work, &away, error) : SCREE_OK;
    for (size_t k = 0; k < list->count && !status; k++) {
        scree_held_pair *pair = &buffer->pair[kept];
        list->member[kept] = list->member[k];
        list->member[kept].added = 0; // before this list, whatever another process has counted
        status = find_rows(state, work, &away, (uint32_t)kept, pair, error);
        kept += !status && pair->first != SCREE_NO_ROW && pair->second != SCREE_NO_ROW;
    }
    scree_release(&away.ghost);
    if (!status) buffer->count = list->count = kept;
    return status;
}

/// Bodies that have moved so far in one step that no ghost of them came near hold no pair.
static scree_status check_all_are_found(const scree_state *state, scree_error *error)
{
    const scree_persistent_list *list = scree_persistent(state);
    int64_t found = (int64_t)list->count;
    if (!state->part) return SCREE_OK;
    scree_comm_add(state, &found, 1);
    if ((size_t)found == list->total) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: of %zu pairs of bodies that are held together %zu have flown apart within a "
                           "step: try a smaller integrator.step",
                           (unsigned long long)state->step, list->total, list->total - (size_t)found);
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
    buffer->count = 0;
    buffer->changes = list->changes;
    if (scree_persistent_total(state) == 0) return SCREE_OK;
    if (!scree_model_holds(model))
        return scree_error_set(error, SCREE_ERROR_INPUT, "law %s cannot hold bodies together",
                               scree_modules[model->laws[0].law]->name);
    scree_status status = reserve(buffer, list->count, error);
    const size_t ghosts = work->ghosts.count;
    if (!status) status = find_pairs(state, work, buffer, error);
    if (!status && work->ghosts.count > ghosts) status = scree_comm_begin(state, work, error);
    if (!status) status = check_all_are_found(state, error);
    if (!status) status = check_lengths(state, work, buffer, error);
    if (status) return status;
    if (buffer->count > 0) qsort(buffer->pair, buffer->count, sizeof *buffer->pair, compare);
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
