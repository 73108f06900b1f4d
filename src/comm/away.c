/// Ghosts of bodies of other processes: who has which, and the messages that they follow with. A message to a process
/// holds what it has of our bodies in one piece; nothing is sent where there is nothing.
#include "comm/parts.h"

#include "comm/comm.h"
#include "comm/traffic.h"

#include <math.h>
#include <string.h>

void scree_parts_boxes(const scree_state *state, double (*box)[6])
{
    double own[6] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    size_t counts[SCREE_PROCESSES];
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        for (int k = 0; k < 3; k++) {
            own[k] = place[k] < own[k] ? place[k] : own[k];
            own[3 + k] = place[k] > own[3 + k] ? place[k] : own[3 + k];
        }
    }
    for (int r = 0; r < scree_comm_size(); r++) counts[r] = 1;
    scree_comm_gather(own, box, counts, sizeof own);
}

size_t scree_parts_trade(const size_t *send, size_t *receive)
{
    uint64_t mine[SCREE_PROCESSES], theirs[SCREE_PROCESSES];
    size_t sum = 0;
    for (int r = 0; r < scree_comm_size(); r++) mine[r] = send[r];
    scree_comm_trade(mine, theirs, 1);
    for (int r = 0; r < scree_comm_size(); r++) sum += receive[r] = theirs[r];
    return sum;
}

size_t scree_parts_count(size_t mine, size_t *counts)
{
    size_t said[SCREE_PROCESSES];
    for (int r = 0; r < scree_comm_size(); r++) said[r] = mine;
    return scree_parts_trade(said, counts);
}

scree_status scree_parts_collect(const scree_state *state, void *list, size_t *count, size_t size, scree_error *error)
{
    size_t counts[SCREE_PROCESSES];
    void *all, **own = list;
    if (!state->part) return SCREE_OK;
    const size_t total = scree_parts_count(*count, counts);
    scree_status status = scree_allocate(&all, total + 1, size, error);
    if (status) return status;
    scree_comm_gather(*own, all, counts, size);
    scree_release(own);
    *own = all;
    *count = total;
    return SCREE_OK;
}

void scree_parts_tell(const scree_state *state, const uint32_t *id, size_t count, double *value, size_t each)
{
    if (!state->part) return;
    for (size_t k = 0; k < count * each; k++)
        if (scree_state_row_of(state, id[k / each]) == SCREE_NO_ROW) value[k] = -INFINITY;
    scree_comm_maximum(state, value, count * each);
}

scree_status scree_parts_offer(scree_work *work, int process, const scree_ghost *ghost, scree_error *error)
{
    scree_parts *parts = work->parts;
    const size_t count = parts->sent_count, capacity = 2 * count + 64;
    scree_status status = SCREE_OK;
    if (count == parts->sent_capacity) {
        status = scree_reallocate(&parts->sent, count, capacity, sizeof *parts->sent, error);
        if (!status) parts->sent_capacity = capacity;
    }
    if (!status && count == parts->to_capacity) {
        status = scree_reallocate(&parts->sent_to, count, capacity, sizeof *parts->sent_to, error);
        if (!status) parts->to_capacity = capacity;
    }
    if (status) return status;
    parts->sent[count] = *ghost;
    parts->sent_to[count] = process;
    parts->sent_count++;
    return SCREE_OK;
}

size_t scree_parts_begins(const size_t *counts, size_t *begin)
{
    size_t sum = 0;
    for (int r = 0; r < scree_comm_size(); sum += counts[r++]) begin[r] = sum;
    return sum;
}

/// Puts the ghosts that were offered into the order of their processes.
static scree_status sort_sent(scree_parts *parts, scree_error *error)
{
    scree_ghost *sorted;
    size_t begin[SCREE_PROCESSES];
    scree_status status = scree_allocate(&sorted, parts->sent_count + 1, sizeof *sorted, error);
    if (status) return status;
    memset(parts->send, 0, (size_t)scree_comm_size() * sizeof *parts->send);
    for (size_t k = 0; k < parts->sent_count; k++) parts->send[parts->sent_to[k]]++;
    (void)scree_parts_begins(parts->send, begin);
    for (size_t k = 0; k < parts->sent_count; k++) sorted[begin[parts->sent_to[k]]++] = parts->sent[k];
    scree_release(&parts->sent);
    parts->sent = sorted;
    parts->sent_capacity = parts->sent_count + 1;
    return SCREE_OK;
}

static scree_status reserve_ghosts(scree_ghost_list *list, size_t count, scree_error *error)
{
    if (count <= list->capacity) return SCREE_OK;
    scree_status status = scree_reallocate(&list->ghost, list->count, count + count / 4, sizeof *list->ghost, error);
    if (!status) list->capacity = count + count / 4;
    return status;
}

scree_status scree_parts_link(const scree_state *state, scree_work *work, scree_error *error)
{
    scree_parts *parts = work->parts;
    scree_ghost_list *list = &work->ghosts;
    scree_status status = sort_sent(parts, error);
    if (status) return status;
    const size_t away = scree_parts_trade(parts->send, parts->receive);
    if ((status = reserve_ghosts(list, list->count + away, error))) return status;
    (void)scree_comm_deliver(parts->sent, parts->send, list->ghost + list->count, parts->receive, sizeof *list->ghost);
    for (size_t k = 0; k < away; k++, list->count++)
        list->ghost[list->count].parent = (uint32_t)(state->count + list->count);
    list->away = away;
    parts->lists++;
    parts->ghosts += away;
    return SCREE_OK;
}

// ---- messages ----------------------------------------------------------------------------------------------------

static scree_status reserve(unsigned char **buffer, size_t *capacity, size_t bytes, scree_error *error)
{
    if (bytes <= *capacity) return SCREE_OK;
    scree_release(buffer);
    *capacity = 0;
    scree_status status = scree_allocate(buffer, bytes + bytes / 4, 1, error);
    if (!status) *capacity = bytes + bytes / 4;
    return status;
}

scree_status scree_parts_reserve_messages(const scree_state *state, scree_work *work, scree_error *error)
{
    scree_parts *parts = work->parts;
    size_t widest = 1;
    for (int kind = 0; kind < SCREE_MESSAGE_KINDS; kind++) {
        const size_t bytes = scree_message_bytes(state, (scree_message_kind)kind);
        widest = bytes > widest ? bytes : widest;
    }
    const size_t most = parts->sent_count > work->ghosts.away ? parts->sent_count : work->ghosts.away;
    scree_status status = reserve(&parts->out, &parts->out_capacity, widest * most, error);
    return status ? status : reserve(&parts->in, &parts->in_capacity, widest * most, error);
}

void scree_parts_send(scree_state *state, scree_work *work, scree_message_kind kind, const scree_message_shift *shift)
{
    scree_parts *parts = work->parts;
    const size_t bytes = scree_message_bytes(state, kind);
    if (bytes == 0) return;
    size_t at = 0, row = state->count + work->ghosts.count - work->ghosts.away;
    for (int r = 0; r < scree_comm_size(); at += parts->send[r++])
        scree_message_pack(state, kind, parts->sent + at, parts->send[r], shift, parts->out + at * bytes);
    const scree_traffic_purpose before =
        scree_traffic_for(kind == SCREE_MESSAGE_STEP ? SCREE_TRAFFIC_STEPS : SCREE_TRAFFIC_LISTS);
    parts->bytes += scree_comm_deliver(parts->out, parts->send, parts->in, parts->receive, bytes);
    (void)scree_traffic_for(before);
    at = 0;
    for (int r = 0; r < scree_comm_size(); at += parts->receive[r++])
        scree_message_unpack(state, kind, row + at, parts->receive[r], parts->in + at * bytes);
    parts->steps++;
}

void scree_parts_add_back(scree_state *state, scree_work *work)
{
    scree_parts *parts = work->parts;
    const size_t bytes = scree_message_bytes(state, SCREE_MESSAGE_BACK);
    size_t at = 0, row = state->count + work->ghosts.count - work->ghosts.away;
    for (int r = 0; r < scree_comm_size(); at += parts->receive[r++])
        scree_message_collect(state, row + at, parts->receive[r], parts->out + at * bytes);
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_STEPS);
    parts->bytes += scree_comm_deliver(parts->out, parts->receive, parts->in, parts->send, bytes);
    (void)scree_traffic_for(before);
    at = 0;
    for (int r = 0; r < scree_comm_size(); at += parts->send[r++])
        scree_message_add(state, parts->sent + at, parts->send[r], parts->in + at * bytes);
    parts->steps++;
}

void scree_parts_begin_step(scree_work *work)
{
    if (work->parts_by_time) scree_balance_begin_step(&work->parts->balance);
}

void scree_parts_end_step(const scree_state *state, scree_work *work)
{
    scree_parts *parts = work->parts;
    scree_balance_end_step(&parts->balance, work->parts_by_time);
    parts->taken++;
    parts->taken_bodies += state->count;
    parts->taken_ghosts += work->ghosts.away;
    parts->needed += parts->sent_count * scree_message_bytes(state, SCREE_MESSAGE_STEP) +
                     work->ghosts.away * scree_message_bytes(state, SCREE_MESSAGE_BACK);
}
