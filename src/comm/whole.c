/// From parts to the whole in process 0, and back. The rows of process 0 stay the first ones of its arrays, and those
/// of the others come in behind them, so no array is there twice. The others keep what they have.
///
/// There are two ways back. Where the whole was only looked at process 0 drops what the others have. Else they drop
/// what they have, and get all anew: what is not about bodies from the declarations (share.c), bodies and pairs as from
/// any rows, of which each is with one process, whichever (scree_parts_spread). A preparation and a file in ranges
/// begin with the latter.
#include "comm/comm.h"
#include "comm/directory.h"
#include "comm/parts.h"
#include "comm/traffic.h"
#include "state/row_table.h"

#include <stdio.h>
#include <string.h>

/// The list is void; contacts are in the state.
static void forget_list(scree_state *state, scree_work *work)
{
    scree_parts_forget_ghosts(work);
    state->changes++;
    work->valid = false;
    work->clear_rows = 0;
}

bool scree_parts_are_whole(const scree_work *work)
{
    return !work->parts || work->parts->whole;
}

// ---- to process 0 ------------------------------------------------------------------------------------------------

/// In process 0 the elements of the others come in behind its own ones, which are the first of `all`.
static void collect(scree_parts *parts, const void *own, void *all, const size_t *counts, size_t size)
{
    size_t none[SCREE_PROCESSES] = {0}, send[SCREE_PROCESSES] = {0};
    const bool root = scree_comm_rank() == 0;
    if (!root) send[0] = counts[scree_comm_rank()];
    (void)scree_comm_deliver(own, send, all, root ? counts : none, size);
    for (int r = 0; r < scree_comm_size(); r++) parts->gathered += counts[r] * size;
}

/// The elements whose first body is here, of those that lie with both: process 0 keeps no others, the others send them.
static scree_status gather_pairs(scree_state *state, scree_work *work, const scree_pair_set *set, scree_error *error)
{
    const bool root = scree_comm_rank() == 0;
    size_t counts[SCREE_PROCESSES], chosen = 0;
    unsigned char *packed = NULL;
    uint32_t *index;
    scree_status status = scree_allocate(&index, *set->count + 1, sizeof *index, error);
    if (status) return status;
    for (size_t k = 0; k < *set->count; k++)
        if (scree_pair_set_counts(state, set, k)) index[chosen++] = (uint32_t)k;
    const size_t total = scree_parts_count(chosen, counts);
    if (root) {
        for (size_t k = 0; k < chosen; k++) scree_parts_move_element(set->list, set->arrays, index[k], k);
        *set->count = chosen;
        status = scree_pair_set_reserve(state, set, total + 1, error);
    }
    for (size_t a = 0; a < set->arrays && !status; a++) {
        const size_t size = set->list[a].size;
        unsigned char *array = *(unsigned char **)set->list[a].pointer;
        if (!root) status = scree_allocate(&packed, chosen + 1, size, error);
        for (size_t k = 0; k < chosen && packed; k++) memcpy(packed + k * size, array + index[k] * size, size);
        collect(work->parts, root ? array : packed, array, counts, size);
        scree_release(&packed);
    }
    scree_release(&index);
    if (status || !root) return status;
    *set->count = total;
    scree_pair_set_sort(set);
    return SCREE_OK;
}

static scree_status gather_rows(scree_state *state, scree_work *work, scree_error *error)
{
    const bool root = scree_comm_rank() == 0;
    size_t counts[SCREE_PROCESSES];
    scree_body_array list[SCREE_BODY_ARRAYS];
    scree_status status = SCREE_OK;
    const size_t total = scree_parts_count(state->count, counts);
    if (root) status = scree_store_reserve_bodies(state, total, true, error);
    const size_t arrays = scree_body_arrays(state, list);
    for (size_t a = 0; a < arrays && !status; a++) {
        void *array = *(void **)list[a].pointer;
        collect(work->parts, array, array, counts, list[a].size);
    }
    if (root) state->count = total;
    return status;
}

/// Process 0 remembers which bodies are its own.
static scree_status note_own(const scree_state *state, scree_parts *parts, scree_error *error)
{
    scree_release(&parts->own);
    scree_status status = scree_allocate(&parts->own, state->count + 1, sizeof *parts->own, error);
    if (status) return status;
    if (state->count > 0) memcpy(parts->own, state->id, state->count * sizeof *parts->own);
    parts->own_count = state->count;
    return SCREE_OK;
}

static void count_reason(scree_parts *parts, const char *what)
{
    size_t k = 0;
    parts->gathers++;
    while (k < parts->reasons && strcmp(parts->reason[k].what, what) != 0) k++;
    if (k == SCREE_GATHER_REASONS) k--;
    if (k == parts->reasons)
        (void)snprintf(parts->reason[parts->reasons++].what, sizeof parts->reason->what, "%s", what);
    parts->reason[k].count++;
}

/// Parts without a list: what belongs to two bodies lies with both of them.
static scree_status unlist(scree_state *state, scree_work *work, scree_error *error)
{
    if (!work->valid) return SCREE_OK;
    scree_status status = scree_parts_migrate(state, work, error);
    if (!status) forget_list(state, work);
    return status;
}

scree_status scree_parts_gather(scree_state *state, scree_work *work, const char *what, scree_error *error)
{
    scree_pair_set set[SCREE_PAIR_SETS];
    size_t sets = 0;
    scree_status status = unlist(state, work, error);
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_GATHERS);
    const bool root = scree_comm_rank() == 0;
    if (!status && root) status = note_own(state, work->parts, error);
    if (!status) status = scree_pair_sets_list(state, work, set, &sets, error);
    for (size_t k = 0; k < sets && !status; k++) status = gather_pairs(state, work, &set[k], error);
    if (!status) status = gather_rows(state, work, error);
    (void)scree_traffic_for(before);
    if (!status && root) status = scree_row_table_leave(state, error);
    if (status) return status;
    if (root) {
        scree_parts_count_marks(state);
        state->part = false;
        forget_list(state, work);
    }
    work->parts->whole = true;
    count_reason(work->parts, what);
    return SCREE_OK;
}

// ---- back --------------------------------------------------------------------------------------------------------

/// Arrays become as long as what is in them.
static scree_status shrink(scree_state *state, const scree_pair_set *set, size_t sets, scree_error *error)
{
    scree_status status = scree_store_shrink(state, error);
    for (size_t k = 0; k < sets && !status; k++)
        if (set[k].group) status = scree_group_shrink(state, set[k].owner, set[k].group, error);
    return status;
}

static scree_status drop_pairs(const scree_state *state, const scree_pair_set *set, const int32_t *to,
                               scree_error *error)
{
    int32_t *ends;
    scree_status status = scree_allocate(&ends, 2 * *set->count + 1, sizeof *ends, error);
    if (status) return status;
    for (size_t k = 0; k < *set->count; k++) scree_parts_ends(state, set, to, k, ends + 2 * k);
    scree_parts_keep_pairs(set, ends);
    scree_release(&ends);
    return SCREE_OK;
}

/// Process 0 has its own bodies alone again, and the pairs of which one is among them.
static scree_status drop_others(scree_state *state, scree_work *work, scree_error *error)
{
    scree_parts *parts = work->parts;
    scree_body_array list[SCREE_BODY_ARRAYS];
    scree_pair_set set[SCREE_PAIR_SETS];
    size_t sets = 0;
    int32_t *to = NULL;
    scree_status status = scree_allocate(&to, state->count + 1, sizeof *to, error);
    if (!status) status = scree_pair_sets_list(state, work, set, &sets, error);
    if (!status) {
        for (size_t row = 0; row < state->count; row++) to[row] = SCREE_PARTS_NOBODY;
        for (size_t k = 0; k < parts->own_count; k++) to[scree_state_row_of(state, parts->own[k])] = 0;
    }
    for (size_t k = 0; k < sets && !status; k++) status = drop_pairs(state, &set[k], to, error);
    if (!status) {
        scree_parts_keep_rows(state, list, scree_body_arrays(state, list), to);
        scree_parts_count_marks(state);
        status = scree_row_table_begin(state, 0, error);
    }
    if (!status) status = shrink(state, set, sets, error);
    scree_release(&to);
    scree_release(&parts->own);
    return status;
}

scree_status scree_parts_return(scree_state *state, scree_work *work, scree_error *error)
{
    const scree_status status = scree_comm_rank() == 0 ? drop_others(state, work, error) : SCREE_OK;
    if (status) return status;
    if (scree_comm_rank() == 0) forget_list(state, work);
    state->part = true;
    work->parts->whole = false;
    return SCREE_OK;
}

/// The ends of all elements of a set: whoever has an element need have neither body.
static scree_status find_ends(const scree_state *state, const scree_directory *directory, const scree_pair_set *set,
                              const int32_t *to, int32_t *ends, scree_error *error)
{
    const size_t count = *set->count;
    uint32_t *id;
    scree_status status = scree_allocate(&id, 2 * count + 1, sizeof *id, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) {
        uint32_t *pair = id + 2 * k;
        scree_parts_ends(state, set, to, k, ends + 2 * k);
        scree_pair_set_ids(set, k, pair);
        if (pair[1] >= SCREE_PRIMITIVE_ID) pair[1] = pair[0];
    }
    status = scree_directory_ask(directory, id, 2 * count, ends, error);
    for (size_t k = 0; k < 2 * count && !status; k++)
        if (ends[k] < 0)
            status =
                scree_error_set(error, SCREE_ERROR_IO, "a contact or bond is of body %u, which is not there", id[k]);
    scree_release(&id);
    return scree_comm_agree(status, error);
}

static scree_status spread_pairs(scree_state *state, const scree_directory *directory, const scree_pair_set *set,
                                 const int32_t *to, scree_error *error)
{
    int32_t *ends;
    int64_t total = (int64_t)*set->count;
    scree_comm_add(state, &total, 1);
    if (set->total) *set->total = (size_t)total;
    scree_status status = scree_allocate(&ends, 2 * *set->count + 1, sizeof *ends, error);
    if (!status) status = find_ends(state, directory, set, to, ends, error);
    if (!status) status = scree_parts_move_pairs(state, set, ends, error);
    scree_release(&ends);
    return status;
}

/// Where the bodies of all rows go, and who keeps track of it.
static scree_status plan(scree_state *state, scree_work *work, scree_directory *directory, int32_t **to,
                         scree_error *error)
{
    int64_t total = (int64_t)state->count;
    scree_comm_add(state, &total, 1);
    state->total = (size_t)total;
    state->id_count = state->next_id;
    scree_status status = scree_row_table_begin(state, 0, error);
    if (!status) status = scree_parts_cut(state, work->parts, NULL, error);
    scree_balance_begin(&work->parts->balance, false);
    if (!status) status = scree_allocate(to, state->count + 1, sizeof **to, error);
    if (status) return status;
    scree_parts_choose(state, work->parts, *to);
    return scree_directory_open(directory, state, *to, error);
}

scree_status scree_parts_spread(scree_state *state, scree_work *work, scree_error *error)
{
    scree_pair_set set[SCREE_PAIR_SETS];
    scree_directory directory = {0};
    size_t sets = 0;
    int32_t *to = NULL;
    scree_status status = scree_parts_open(work, error);
    if (status) return status;
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_GATHERS);
    state->part = true;
    status = plan(state, work, &directory, &to, error);
    if (!status) status = scree_pair_sets_list(state, work, set, &sets, error);
    for (size_t k = 0; k < sets && !status; k++) status = spread_pairs(state, &directory, &set[k], to, error);
    if (!status) status = scree_parts_move_rows(state, work, to, error);
    if (!status) status = shrink(state, set, sets, error);
    if (!status) forget_list(state, work);
    (void)scree_traffic_for(before);
    work->parts->whole = false;
    scree_release(&work->parts->own);
    scree_directory_close(&directory);
    scree_release(&to);
    return status;
}
