/// Ghosts of bodies of other processes lie in the order of these, and each process has kept which of its bodies they
/// are of, in the same order (comm/parts.h): so a note names a body by its place in that list. Cost: one number each to
/// each process for a plan, and a message to each neighbour for what is sent.
#include "comm/ghost_rows.h"

#include "comm/comm.h"
#include "comm/parts.h"
#include "comm/traffic.h"

#include <string.h>

size_t scree_ghost_rows_shown(const scree_work *work)
{
    return work && work->parts ? work->parts->sent_count : 0;
}

uint32_t scree_ghost_rows_body(const scree_work *work, size_t k)
{
    return work->parts->sent[k].parent;
}

size_t scree_ghost_rows_seen(const scree_state *state, const scree_work *work)
{
    return state->part ? work->ghosts.away : 0;
}

size_t scree_ghost_rows_first(const scree_state *state, const scree_work *work)
{
    return state->part ? scree_row_count(state, work) - work->ghosts.away : state->count;
}

void scree_ghost_rows_tell(const scree_state *state, const scree_work *work, const void *shown, void *seen, size_t size)
{
    if (!state->part) return;
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_SAMPLES);
    (void)scree_comm_deliver(shown, work->parts->send, seen, work->parts->receive, size);
    (void)scree_traffic_for(before);
}

/// The process whose ghosts number `k` belongs to.
static int process_of(const size_t begin[SCREE_PROCESSES], size_t k)
{
    int low = 0, high = scree_comm_size();
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (begin[middle] <= k)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/// Puts the notes into the order of the processes that they go to, `place`: what each of these knows the body by.
static scree_status sort_notes(const scree_state *state, const scree_work *work, const uint32_t *about, size_t count,
                               scree_ghost_notes *notes, uint32_t *place, scree_error *error)
{
    size_t begin[SCREE_PROCESSES], next[SCREE_PROCESSES];
    const size_t first = scree_ghost_rows_first(state, work);
    int32_t *to;
    scree_status status = scree_allocate(&to, count + 1, sizeof *to, error);
    if (status) return status;
    (void)scree_parts_begins(work->parts->receive, begin);
    for (size_t k = 0; k < count; k++) notes->send[to[k] = process_of(begin, about[k] - first)]++;
    (void)scree_parts_begins(notes->send, next);
    for (size_t k = 0; k < count; k++) {
        const size_t at = next[to[k]]++;
        notes->note[at] = (uint32_t)k;
        place[at] = (uint32_t)(about[k] - first - begin[to[k]]);
    }
    scree_release(&to);
    return SCREE_OK;
}

/// From places in the lists of ghosts that others have to rows.
static void find_rows(const scree_parts *parts, scree_ghost_notes *notes)
{
    size_t begin[SCREE_PROCESSES], k = 0;
    (void)scree_parts_begins(parts->send, begin);
    for (int r = 0; r < scree_comm_size(); r++)
        for (size_t end = k + notes->receive[r]; k < end; k++)
            notes->row[k] = parts->sent[begin[r] + notes->row[k]].parent;
}

scree_status scree_ghost_notes_open(const scree_state *state, const scree_work *work, const uint32_t *about,
                                    size_t count, scree_ghost_notes *notes, scree_error *error)
{
    const size_t size = (size_t)scree_comm_size();
    *notes = (scree_ghost_notes){0};
    if (!state->part) return SCREE_OK;
    notes->leaving = count;
    uint32_t *place = NULL;
    scree_status status = scree_allocate(&notes->send, size, sizeof *notes->send, error);
    if (!status) status = scree_allocate(&notes->receive, size, sizeof *notes->receive, error);
    if (!status) status = scree_allocate(&notes->note, count + 1, sizeof *notes->note, error);
    if (!status) status = scree_allocate(&place, count + 1, sizeof *place, error);
    if (!status) status = sort_notes(state, work, about, count, notes, place, error);
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_SAMPLES);
    if (!status) {
        notes->arriving = scree_parts_trade(notes->send, notes->receive);
        status = scree_allocate(&notes->row, notes->arriving + 1, sizeof *notes->row, error);
    }
    if (!status) {
        (void)scree_comm_deliver(place, notes->send, notes->row, notes->receive, sizeof *place);
        find_rows(work->parts, notes);
    }
    (void)scree_traffic_for(before);
    scree_release(&place);
    return status;
}

scree_status scree_ghost_notes_send(const scree_ghost_notes *notes, const void *note, void *arrived, size_t size,
                                    scree_error *error)
{
    unsigned char *out;
    if (!notes->send) return SCREE_OK;
    scree_status status = scree_allocate(&out, notes->leaving + 1, size, error);
    if (status) return status;
    for (size_t k = 0; k < notes->leaving; k++)
        memcpy(out + k * size, (const unsigned char *)note + notes->note[k] * size, size);
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_SAMPLES);
    (void)scree_comm_deliver(out, notes->send, arrived, notes->receive, size);
    (void)scree_traffic_for(before);
    scree_release(&out);
    return SCREE_OK;
}

void scree_ghost_notes_close(scree_ghost_notes *notes)
{
    scree_release(&notes->note);
    scree_release(&notes->row);
    scree_release(&notes->send);
    scree_release(&notes->receive);
}
