/// A route in three steps: each key goes to a process by the id in it, where the keys are sorted; the places that they
/// have among all keys go back; from these follow the process that writes an element, and its row there.
#include "comm/ranges.h"

#include "comm/comm.h"
#include "comm/pair_sets.h"
#include "comm/parts.h"
#include "comm/traffic.h"
#include "state/fields.h"

#include <stdlib.h>
#include <string.h>

_Static_assert((int)SCREE_RANGE_SETS == (int)SCREE_PAIR_SETS, "a route for each set");

/// Files of this process since its begin, and those of them from parts.
static uint64_t files[2];

uint64_t scree_ranges_files(bool from_parts)
{
    return files[from_parts];
}

size_t scree_range_rows(size_t total)
{
    const size_t size = (size_t)scree_comm_size();
    return (total + size - 1) / size;
}

size_t scree_range_begin(size_t total, int process)
{
    const size_t begin = scree_range_rows(total) * (size_t)process;
    return begin < total ? begin : total;
}

// ---- messages ----------------------------------------------------------------------------------------------------

static scree_status open_counts(scree_route *route, size_t count, scree_error *error)
{
    const size_t size = (size_t)scree_comm_size();
    scree_status status = scree_allocate(&route->index, count + 1, sizeof *route->index, error);
    if (!status) status = scree_allocate(&route->send, size, sizeof *route->send, error);
    return status ? status : scree_allocate(&route->receive, size, sizeof *route->receive, error);
}

void scree_route_close(scree_route *route)
{
    void *const arrays[] = {&route->index, &route->place, &route->send, &route->receive};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    *route = (scree_route){0};
}

/// Returns how many come.
static size_t address(scree_route *route, const int32_t *to, size_t count)
{
    size_t end[SCREE_PROCESSES];
    for (size_t k = 0; k < count; k++)
        if (to[k] >= 0) route->send[to[k]]++;
    route->leaving = scree_parts_begins(route->send, end);
    for (size_t k = 0; k < count; k++)
        if (to[k] >= 0) route->index[end[to[k]]++] = (uint32_t)k;
    return scree_parts_trade(route->send, route->receive);
}

/// What goes out lies by processes, and so does what comes in; what stays here is copied.
static void pass(const void *out, const size_t *send, void *in, const size_t *receive, size_t size)
{
    const int here = scree_comm_rank();
    size_t from = 0, to = 0;
    (void)scree_comm_deliver(out, send, in, receive, size);
    for (int r = 0; r < here; r++) {
        from += send[r];
        to += receive[r];
    }
    memcpy((unsigned char *)in + to * size, (const unsigned char *)out + from * size, send[here] * size);
}

scree_status scree_route_to(scree_route *route, const int32_t *to, size_t count, size_t *arriving, scree_error *error)
{
    *route = (scree_route){0};
    scree_status status = open_counts(route, count, error);
    if (!status) *arriving = address(route, to, count);
    return status;
}

scree_status scree_route_pass(const scree_route *route, const void *own, void *in, size_t size, scree_error *error)
{
    unsigned char *out;
    scree_status status = scree_allocate(&out, route->leaving + 1, size, error);
    if (status) return status;
    for (size_t e = 0; e < route->leaving; e++)
        memcpy(out + e * size, (const unsigned char *)own + route->index[e] * size, size);
    pass(out, route->send, in, route->receive, size);
    scree_release(&out);
    return SCREE_OK;
}

scree_status scree_route_answer(const scree_route *route, const void *in, void *own, size_t size, scree_error *error)
{
    unsigned char *out;
    scree_status status = scree_allocate(&out, route->leaving + 1, size, error);
    if (status) return status;
    pass(in, route->receive, out, route->send, size);
    for (size_t e = 0; e < route->leaving; e++)
        memcpy((unsigned char *)own + route->index[e] * size, out + e * size, size);
    scree_release(&out);
    return SCREE_OK;
}

// ---- places among all keys ---------------------------------------------------------------------------------------

typedef struct keyed {
    uint64_t key;
    size_t came; ///< in this order
} keyed;

static int ascending(const void *a, const void *b)
{
    const keyed *p = a, *q = b;
    return (p->key > q->key) - (p->key < q->key);
}

/// place[k]: of the k-th key among those of all processes, which have been sorted into these by their ids.
static scree_status sort_keys(const uint64_t *key, size_t count, uint64_t *place, size_t *total, scree_error *error)
{
    size_t counts[SCREE_PROCESSES], before = 0;
    keyed *list;
    scree_status status = scree_allocate(&list, count + 1, sizeof *list, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) list[k] = (keyed){key[k], k};
    if (count > 1) qsort(list, count, sizeof *list, ascending);
    *total = scree_parts_count(count, counts);
    for (int r = 0; r < scree_comm_rank(); r++) before += counts[r];
    for (size_t k = 0; k < count; k++) place[list[k].came] = before + k;
    scree_release(&list);
    return SCREE_OK;
}

/// The process that sorts a key: by its first id, so that the keys of one come before those of the next.
static int32_t sorter(uint64_t key, size_t ids)
{
    if (key == SCREE_ROUTE_NONE) return -1;
    const size_t size = (size_t)scree_comm_size(), id = (size_t)(key >> 32);
    return (int32_t)(id < ids ? id * size / ids : size - 1);
}

/// place[k]: of key k among those of all processes.
static scree_status find_places(const uint64_t *key, size_t count, size_t ids, uint64_t *place, size_t *total,
                                scree_error *error)
{
    scree_route route = {0};
    uint64_t *in = NULL, *found = NULL;
    int32_t *to = NULL;
    size_t arriving = 0;
    scree_status status = scree_allocate(&to, count + 1, sizeof *to, error);
    for (size_t k = 0; k < count && !status; k++) to[k] = sorter(key[k], ids);
    if (!status) status = scree_route_to(&route, to, count, &arriving, error);
    if (!status) status = scree_allocate(&in, arriving + 1, sizeof *in, error);
    if (!status) status = scree_allocate(&found, arriving + 1, sizeof *found, error);
    if (!status) status = scree_route_pass(&route, key, in, sizeof *in, error);
    if (!status) status = sort_keys(in, arriving, found, total, error);
    if (!status) status = scree_route_answer(&route, found, place, sizeof *found, error);
    void *const arrays[] = {&to, &in, &found};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_route_close(&route);
    return status;
}

// ---- routes ------------------------------------------------------------------------------------------------------

/// From the places of the own elements to the range.
static scree_status plan(scree_route *route, const uint64_t *key, const uint64_t *place, size_t count,
                         scree_error *error)
{
    const size_t rows = scree_range_rows(route->total);
    int32_t *to = NULL;
    uint32_t *out = NULL;
    scree_status status = open_counts(route, count, error);
    if (!status) status = scree_allocate(&to, count + 1, sizeof *to, error);
    if (!status) status = scree_allocate(&out, count + 1, sizeof *out, error);
    if (!status) {
        for (size_t k = 0; k < count; k++) to[k] = key[k] == SCREE_ROUTE_NONE ? -1 : (int32_t)(place[k] / rows);
        const size_t arriving = address(route, to, count);
        for (size_t e = 0; e < route->leaving; e++) out[e] = (uint32_t)(place[route->index[e]] % rows);
        status = scree_allocate(&route->place, arriving + 1, sizeof *route->place, error);
    }
    if (!status) pass(out, route->send, route->place, route->receive, sizeof *out);
    scree_release(&to);
    scree_release(&out);
    return status;
}

scree_status scree_route_open(scree_route *route, const uint64_t *key, size_t count, size_t ids, scree_error *error)
{
    uint64_t *place;
    *route = (scree_route){0};
    scree_status status = scree_allocate(&place, count + 1, sizeof *place, error);
    if (status) return status;
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_FILES);
    status = find_places(key, count, ids, place, &route->total, error);
    if (!status) {
        route->begin = scree_range_begin(route->total, scree_comm_rank());
        route->rows = scree_range_begin(route->total, scree_comm_rank() + 1) - route->begin;
        status = plan(route, key, place, count, error);
    }
    (void)scree_traffic_for(before);
    scree_release(&place);
    return status;
}

scree_status scree_route_move(const scree_route *route, const void *own, void *range, size_t size, scree_error *error)
{
    unsigned char *in;
    scree_status status = scree_allocate(&in, route->rows + 1, size, error);
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_FILES);
    if (!status) status = scree_route_pass(route, own, in, size, error);
    for (size_t e = 0; e < route->rows && !status; e++)
        memcpy((unsigned char *)range + route->place[e] * size, in + e * size, size);
    (void)scree_traffic_for(before);
    scree_release(&in);
    return status;
}

static scree_status route_bodies(const scree_state *state, scree_route *route, scree_error *error)
{
    uint64_t *key;
    scree_status status = scree_allocate(&key, state->count + 1, sizeof *key, error);
    if (status) return status;
    for (size_t row = 0; row < state->count; row++) key[row] = scree_route_key(state->id[row], 0);
    status = scree_route_open(route, key, state->count, state->next_id, error);
    scree_release(&key);
    return status;
}

/// Each element is sent by one process: of a list by that which evaluates it, else by that which counts it.
static scree_status route_pairs(const scree_state *state, const scree_work *work, const scree_pair_set *set,
                                scree_route *route, scree_error *error)
{
    uint64_t *key;
    scree_status status = scree_allocate(&key, *set->count + 1, sizeof *key, error);
    if (status) return status;
    for (size_t k = 0; k < *set->count; k++) {
        uint32_t id[2];
        scree_pair_set_ids(set, k, id);
        key[k] = work->valid || scree_pair_set_counts(state, set, k) ? scree_route_key(id[0], id[1]) : SCREE_ROUTE_NONE;
    }
    status = scree_route_open(route, key, *set->count, state->next_id, error);
    scree_release(&key);
    return status;
}

scree_status scree_ranges_open(scree_state *state, scree_work *work, scree_ranges *ranges, scree_error *error)
{
    scree_pair_set set[SCREE_PAIR_SETS];
    *ranges = (scree_ranges){.part = state->part};
    files[0]++;
    if (!state->part) return SCREE_OK;
    files[1]++;
    scree_status status = scree_pair_sets_list(state, work, set, &ranges->sets, error);
    if (!status) status = route_bodies(state, &ranges->bodies, error);
    for (size_t k = 0; k < ranges->sets && !status; k++) {
        ranges->group[k] = set[k].group;
        status = route_pairs(state, work, &set[k], &ranges->set[k], error);
    }
    return status;
}

void scree_ranges_close(scree_ranges *ranges)
{
    scree_route_close(&ranges->bodies);
    for (size_t k = 0; k < ranges->sets; k++) scree_route_close(&ranges->set[k]);
}

/// Whether there may be rows: the same in all processes.
static bool has_rows(const scree_state *state, const scree_field *field)
{
    if (!scree_field_is_array(field)) return false;
    if (field->rows == SCREE_ROWS_GROUP) return field->group->pairs;
    return scree_field_is_shared(state, field) || scree_field_is_made(state, field);
}

const scree_route *scree_ranges_of(const scree_ranges *ranges, const scree_state *state, const scree_field *field)
{
    if (!ranges || !ranges->part || !has_rows(state, field)) return NULL;
    if (field->rows == SCREE_ROWS_BODIES) return &ranges->bodies;
    for (size_t k = 0; k < ranges->sets; k++)
        if (ranges->group[k] == (field->rows == SCREE_ROWS_GROUP ? field->group : NULL)) return &ranges->set[k];
    return NULL;
}
