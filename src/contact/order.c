/// Counting sort by the first id; the few contacts of one body are then put in order by insertion. Of a part, which has
/// few of all ids, a sort by comparison: nothing here is as long as the sample is large.
#include "contact/order.h"
#include "state/plates.h"

#include "contact/surfaces.h"

#include <stdlib.h>

/// Contact number k of all pairs, then all wall pairs, then all element pairs, of which `touching` tells which touch;
/// false when it does not touch.
static bool reference_get(const scree_state *state, const scree_work *work, const uint8_t *touching, size_t k,
                          contact_reference *r)
{
    const scree_pair_list *pairs = &work->pairs;
    if (k < pairs->count) {
        uint32_t a = pairs->first[k], b = pairs->second[k];
        *r = (contact_reference){state->id[a], state->id[b], (uint32_t)k};
        return contact_pair_is_there(state, work, k);
    }
    k -= pairs->count;
    if (k >= work->wall_pairs.count) {
        k -= work->wall_pairs.count;
        *r = (contact_reference){state->id[work->primitive_pairs.body[k]],
                                 SCREE_PRIMITIVE_ID + work->primitive_pairs.wall[k], (uint32_t)k};
        return touching[k];
    }
    uint32_t body = work->wall_pairs.body[k], wall = work->wall_pairs.wall[k];
    *r = (contact_reference){state->id[body], SCREE_WALL_ID + wall, (uint32_t)k};
    return contact_plate_is_there(state, work, k);
}

/// Puts list[k] in its place among list[begin .. k - 1], which are in order.
static void insert(contact_reference *list, size_t begin, size_t k)
{
    contact_reference r = list[k];
    for (; k > begin && list[k - 1].second > r.second; k--) list[k] = list[k - 1];
    list[k] = r;
}

static int compare(const void *a, const void *b)
{
    const contact_reference *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return (p->second > q->second) - (p->second < q->second);
}

static scree_status order_part(const scree_state *state, const scree_work *work, const uint8_t *touching,
                               size_t candidates, contact_reference **list, size_t *count, scree_error *error)
{
    contact_reference r;
    *count = 0;
    for (size_t k = 0; k < candidates; k++) *count += reference_get(state, work, touching, k, &r);
    scree_status status = scree_allocate(list, *count, sizeof **list, error);
    if (status) return status;
    for (size_t k = 0, at = 0; k < candidates; k++)
        if (reference_get(state, work, touching, k, &r)) (*list)[at++] = r;
    if (*count > 0) qsort(*list, *count, sizeof **list, compare);
    return SCREE_OK;
}

static scree_status order_whole(const scree_state *state, const scree_work *work, const uint8_t *touching,
                                size_t candidates, contact_reference **list, size_t *count, scree_error *error)
{
    contact_reference r;
    size_t *begin;
    scree_status status = scree_allocate(&begin, state->id_count + 2, sizeof *begin, error);
    if (status) return status;
    // begin[id + 2] counts, begin[id + 1] becomes the place where the contacts of id are put, and in the end their end.
    for (size_t k = 0; k < candidates; k++)
        if (reference_get(state, work, touching, k, &r)) begin[r.first + 2]++;
    for (size_t id = 0; id < state->id_count; id++) begin[id + 2] += begin[id + 1];
    *count = begin[state->id_count + 1];
    if (!(status = scree_allocate(list, *count, sizeof **list, error)))
        for (size_t k = 0; k < candidates; k++)
            if (reference_get(state, work, touching, k, &r)) (*list)[begin[r.first + 1]++] = r;
    for (size_t id = 0; id < state->id_count && !status; id++)
        for (size_t k = begin[id]; k < begin[id + 1]; k++) insert(*list, begin[id], k);
    scree_release(&begin);
    return status;
}

scree_status contact_order(const scree_state *state, const scree_work *work, contact_reference **list, size_t *count,
                           scree_error *error)
{
    const size_t candidates = work->pairs.count + work->wall_pairs.count + work->primitive_pairs.count;
    uint8_t *touching = NULL;
    *list = NULL;
    scree_status status = scree_allocate(&touching, work->primitive_pairs.count, sizeof *touching, error);
    if (status) return status;
    contact_primitives_mark(state, work, touching);
    status = state->part ? order_part(state, work, touching, candidates, list, count, error)
                         : order_whole(state, work, touching, candidates, list, count, error);
    scree_release(&touching);
    return status;
}
