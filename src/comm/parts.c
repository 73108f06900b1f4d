/// Parts of a sample: who has which body, and how bodies and what belongs to two of them (comm/pair_sets.h) go from one
/// process to another.
///
/// Bodies move when a list is made: each to the process in whose part of space it lies. Space is cut (comm/zoltan.c)
/// when a state is spread, by bodies, and anew, by costs, when that pays (comm/balance.h). Between two lists a body
/// stays where it is, however it moves. For tests bodies go anywhere, at every list, from a seed.
#include "comm/parts.h"

#include "base/checksum.h"
#include "comm/comm.h"
#include "state/periodic.h"
#include "state/row_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

scree_status scree_parts_open(scree_work *work, scree_error *error)
{
    if (work->parts) return SCREE_OK;
    const size_t size = (size_t)scree_comm_size();
    scree_status status = scree_allocate(&work->parts, 1, sizeof *work->parts, error);
    if (!status) status = scree_allocate(&work->parts->send, size, sizeof *work->parts->send, error);
    if (!status) status = scree_allocate(&work->parts->receive, size, sizeof *work->parts->receive, error);
    const char *seed = getenv("SCREE_RANDOM_PARTS");
    if (!status) scree_balance_begin(&work->parts->balance, false);
    if (!status && seed) work->parts->seed = strtoull(seed, NULL, 10);
    return status;
}

void scree_parts_destroy(scree_work *work)
{
    scree_parts *parts = work->parts;
    if (!parts) return;
    void *const arrays[] = {&parts->sent, &parts->sent_to, &parts->send, &parts->receive,
                            &parts->out,  &parts->in,      &parts->own};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_release(&work->parts);
}

void scree_parts_forget_ghosts(scree_work *work)
{
    work->ghosts.count = work->ghosts.away = 0;
    work->parts->sent_count = 0;
    memset(work->parts->send, 0, (size_t)scree_comm_size() * sizeof *work->parts->send);
    memset(work->parts->receive, 0, (size_t)scree_comm_size() * sizeof *work->parts->receive);
}

// ---- who has which body ------------------------------------------------------------------------------------------

static int at_random(const scree_parts *parts, uint32_t id)
{
    const uint64_t draw = scree_checksum_word(scree_checksum_word(parts->seed, parts->draws), id);
    return (int)(draw % (uint64_t)scree_comm_size());
}

void scree_parts_choose(const scree_state *state, scree_parts *parts, int32_t *to)
{
    parts->draws++;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        to[row] = parts->seed ? at_random(parts, state->id[row]) : scree_comm_part_of(place);
    }
}

scree_status scree_parts_cut(const scree_state *state, scree_parts *parts, const float *weight, scree_error *error)
{
    scree_vector *place;
    // Where there are no bodies nobody asks for the parts.
    if (parts->seed || scree_state_total(state) == 0) return SCREE_OK;
    scree_status status = scree_allocate(&place, state->count + 1, sizeof *place, error);
    for (size_t row = 0; row < state->count && !status; row++) scree_body_position(state, row, place[row]);
    if (!status) status = scree_comm_cut((const double(*)[3])place, weight, state->count, state->dimension, error);
    parts->cuts++;
    scree_release(&place);
    return status;
}

/// By what they cost, while the last list holds.
static scree_status cut_anew(const scree_state *state, scree_work *work, scree_error *error)
{
    float *weight = NULL;
    scree_status status = scree_balance_weights(&work->parts->balance, state, work, &weight, error);
    if (!status) status = scree_parts_cut(state, work->parts, weight, error);
    scree_balance_begin(&work->parts->balance, true);
    scree_release(&weight);
    return status;
}

// ---- rows --------------------------------------------------------------------------------------------------------

void scree_parts_count_marks(scree_state *state)
{
    memset(state->marked, 0, sizeof state->marked);
    for (size_t row = 0; row < state->count; row++) state->marked[state->mark[row]]++;
}

void scree_parts_move_element(const scree_body_array *list, size_t arrays, size_t from, size_t to)
{
    for (size_t k = 0; k < arrays && from != to; k++) {
        unsigned char *array = *(unsigned char **)list[k].pointer;
        memcpy(array + to * list[k].size, array + from * list[k].size, list[k].size);
    }
}

void scree_parts_keep_rows(scree_state *state, const scree_body_array *list, size_t arrays, const int32_t *to)
{
    const int here = scree_comm_rank();
    size_t kept = 0;
    for (size_t row = 0; row < state->count; row++)
        if (to[row] == here) scree_parts_move_element(list, arrays, row, kept++);
    // The sums of a ghost that takes a row are clear.
    for (size_t k = 0; k < arrays && kept < state->count; k++)
        memset(*(unsigned char **)list[k].pointer + kept * list[k].size, 0, (state->count - kept) * list[k].size);
    state->count = kept;
}

/// Arrays with one element a body: those of the declarations, and what a cell in motion keeps beside the rows.
static size_t list_arrays(const scree_state *state, scree_work *work, scree_body_array list[SCREE_BODY_ARRAYS + 1])
{
    size_t arrays = scree_body_arrays(state, list);
    if (scree_periodic_is_whole(state))
        list[arrays++] = (scree_body_array){&work->relative, sizeof *work->relative, false, true};
    return arrays;
}

/// Room for `count` bodies in all of them.
static scree_status reserve_rows(scree_state *state, scree_work *work, size_t count, scree_error *error)
{
    scree_status status = scree_store_reserve_bodies(state, count, false, error);
    if (status || !scree_periodic_is_whole(state) || count < work->relative_capacity) return status;
    const size_t room = count + count / 8 + 16;
    status = scree_reallocate(&work->relative, work->relative_capacity, room, sizeof *work->relative, error);
    if (!status) work->relative_capacity = room;
    return status;
}

// ---- what belongs to two bodies ----------------------------------------------------------------------------------

void scree_parts_ends(const scree_state *state, const scree_pair_set *set, const int32_t *to, size_t k, int32_t end[2])
{
    uint32_t id[2];
    scree_pair_set_ids(set, k, id);
    for (int i = 0; i < 2; i++) {
        const uint32_t row = id[i] < SCREE_PRIMITIVE_ID ? scree_state_row_of(state, id[i]) : SCREE_NO_ROW;
        end[i] = row == SCREE_NO_ROW ? SCREE_PARTS_NOBODY : to[row];
        if (id[i] >= SCREE_PRIMITIVE_ID) end[i] = end[0];
    }
}

void scree_parts_keep_pairs(const scree_pair_set *set, const int32_t *ends)
{
    const int here = scree_comm_rank();
    size_t kept = 0;
    for (size_t k = 0; k < *set->count; k++)
        if (ends[2 * k] == here || ends[2 * k + 1] == here) scree_parts_move_element(set->list, set->arrays, k, kept++);
    *set->count = kept;
}

// ---- from one process to another ---------------------------------------------------------------------------------

/// Elements that go: `index` in the order of the processes, send[r] to process r, and receive[r] that come from it.
typedef struct journey {
    uint32_t *index;
    size_t *send, *receive;
    size_t leaving, arriving;
    unsigned char *in; ///< what has come, of each array all elements
} journey;

static void journey_destroy(journey *j)
{
    void *const arrays[] = {&j->index, &j->send, &j->receive, &j->in};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
}

static scree_status journey_open(journey *j, size_t most, scree_error *error)
{
    const size_t size = (size_t)scree_comm_size();
    scree_status status = scree_allocate(&j->index, most + 1, sizeof *j->index, error);
    if (!status) status = scree_allocate(&j->send, size, sizeof *j->send, error);
    if (!status) status = scree_allocate(&j->receive, size, sizeof *j->receive, error);
    return status;
}

/// Element k goes to the processes ends[2 k] and ends[2 k + 1], which may be one, or this one, for which it stays.
static void journey_plan(journey *j, const int32_t *ends, size_t count)
{
    const int here = scree_comm_rank(), size = scree_comm_size();
    for (int pass = 0; pass < 2; pass++) {
        for (size_t k = 0; k < 2 * count; k++) {
            const int r = ends[k];
            if (r == here || (k % 2 && ends[k - 1] == r)) continue;
            if (pass == 0)
                j->send[r]++;
            else
                j->index[j->send[r]++] = (uint32_t)(k / 2);
        }
        // Counts become places, then ends of places become counts again.
        size_t sum = 0, before = 0;
        for (int r = 0; r < size; r++) {
            const size_t value = j->send[r];
            j->send[r] = pass == 0 ? sum : value - before;
            sum += value;
            before = value;
        }
        if (pass == 0) j->leaving = sum;
    }
}

/// Sends what leaves of `count` elements, array by array, and receives what comes. `ends`: see journey_plan.
static scree_status journey_make(journey *j, const int32_t *ends, size_t count, const scree_body_array *list,
                                 size_t arrays, scree_error *error)
{
    journey_plan(j, ends, count);
    j->arriving = scree_parts_trade(j->send, j->receive);
    unsigned char *out;
    size_t widest = 1, bytes = 1;
    for (size_t k = 0; k < arrays; k++) {
        widest = list[k].size > widest ? list[k].size : widest;
        bytes += list[k].size * j->arriving;
    }
    scree_status status = scree_allocate(&j->in, bytes, 1, error);
    if (!status) status = scree_allocate(&out, widest * j->leaving + 1, 1, error);
    if (status) return status;
    unsigned char *in = j->in;
    for (size_t k = 0; k < arrays; in += list[k++].size * j->arriving) {
        const size_t size = list[k].size;
        const unsigned char *array = *(unsigned char **)list[k].pointer;
        for (size_t e = 0; e < j->leaving; e++) memcpy(out + e * size, array + j->index[e] * size, size);
        (void)scree_comm_deliver(out, j->send, in, j->receive, size);
    }
    scree_release(&out);
    return SCREE_OK;
}

/// Puts what has come into the elements from `at` on.
static void journey_end(const journey *j, const scree_body_array *list, size_t arrays, size_t at)
{
    const unsigned char *in = j->in;
    if (j->arriving == 0) return; // there may be no arrays
    for (size_t k = 0; k < arrays; in += list[k++].size * j->arriving)
        memcpy(*(unsigned char **)list[k].pointer + at * list[k].size, in, list[k].size * j->arriving);
}

/// Tells the ghosts of the last list where their bodies go, and makes them known by their ids.
static scree_status tell_ghosts(scree_state *state, scree_work *work, int32_t *to, scree_error *error)
{
    const scree_parts *parts = work->parts;
    const size_t first = state->count + work->ghosts.count - work->ghosts.away;
    int32_t *out;
    scree_status status = scree_allocate(&out, parts->sent_count + 1, sizeof *out, error);
    if (!status) status = scree_row_table_begin(state, work->ghosts.away, error);
    if (status) return status;
    for (size_t k = 0; k < parts->sent_count; k++) out[k] = to[parts->sent[k].parent];
    (void)scree_comm_deliver(out, parts->send, to + first, parts->receive, sizeof *out);
    for (size_t k = 0; k < work->ghosts.away; k++)
        scree_state_set_row(state, state->id[first + k], (uint32_t)(first + k));
    scree_release(&out);
    return SCREE_OK;
}

scree_status scree_parts_move_pairs(scree_state *state, const scree_pair_set *set, const int32_t *ends,
                                    scree_error *error)
{
    const size_t count = *set->count;
    journey j = {0};
    scree_status status = journey_open(&j, 2 * count, error);
    if (!status) status = journey_make(&j, ends, count, set->list, set->arrays, error);
    if (!status) {
        scree_parts_keep_pairs(set, ends);
        status = scree_pair_set_reserve(state, set, *set->count + j.arriving, error);
    }
    if (!status) {
        journey_end(&j, set->list, set->arrays, *set->count);
        *set->count += j.arriving;
        scree_pair_set_sort(set);
    }
    journey_destroy(&j);
    return status;
}

/// Both bodies of an element are here or among the ghosts of the last list; one that is neither stays with the other.
static scree_status follow_bodies(scree_state *state, const scree_pair_set *set, const int32_t *to, scree_error *error)
{
    int32_t *ends;
    scree_status status = scree_allocate(&ends, 2 * *set->count + 1, sizeof *ends, error);
    for (size_t k = 0; k < *set->count && !status; k++) {
        int32_t *end = ends + 2 * k;
        scree_parts_ends(state, set, to, k, end);
        if (end[0] == SCREE_PARTS_NOBODY) end[0] = scree_comm_rank();
        if (end[1] == SCREE_PARTS_NOBODY) end[1] = end[0];
    }
    if (!status) status = scree_parts_move_pairs(state, set, ends, error);
    scree_release(&ends);
    return status;
}

scree_status scree_parts_move_rows(scree_state *state, scree_work *work, const int32_t *to, scree_error *error)
{
    scree_body_array list[SCREE_BODY_ARRAYS + 1];
    int32_t *ends = NULL;
    journey j = {0};
    scree_status status = reserve_rows(state, work, state->count, error);
    const size_t arrays = list_arrays(state, work, list);
    if (!status) status = scree_allocate(&ends, 2 * state->count + 1, sizeof *ends, error);
    if (!status) status = journey_open(&j, state->count, error);
    for (size_t k = 0; k < state->count && !status; k++) ends[2 * k] = ends[2 * k + 1] = to[k];
    if (!status) status = journey_make(&j, ends, state->count, list, arrays, error);
    if (!status) {
        work->parts->moved += j.leaving;
        scree_parts_keep_rows(state, list, arrays, to);
        status = reserve_rows(state, work, state->count + j.arriving, error);
    }
    if (!status) {
        journey_end(&j, list, arrays, state->count);
        state->count += j.arriving;
        scree_parts_count_marks(state);
        status = scree_row_table_begin(state, 0, error);
    }
    journey_destroy(&j);
    scree_release(&ends);
    return status;
}

scree_status scree_parts_migrate(scree_state *state, scree_work *work, scree_error *error)
{
    scree_parts *parts = work->parts;
    scree_pair_set set[SCREE_PAIR_SETS];
    size_t sets;
    int32_t *to = NULL;
    scree_status status = scree_pair_sets_list(state, work, set, &sets, error);
    if (status) return status;
    if (scree_balance_pays(&parts->balance, state, work, &parts->worst)) status = cut_anew(state, work, error);
    if (!status) status = scree_allocate(&to, scree_row_count(state, work) + 1, sizeof *to, error);
    if (status) return status;
    scree_parts_choose(state, parts, to);
    status = tell_ghosts(state, work, to, error);
    for (size_t k = 0; k < sets && !status; k++) status = follow_bodies(state, &set[k], to, error);
    if (!status) status = scree_parts_move_rows(state, work, to, error);
    scree_parts_forget_ghosts(work);
    // Rows have moved into the places of others.
    work->clear_rows = 0;
    scree_release(&to);
    return status;
}
