/// Places of all grains: see grain_places.h. Cost: O(grains); of a part, those of all processes, and to sort them.
#include "measure/grain_places.h"

#include "comm/parts.h"
#include "comm/traffic.h"
#include "state/body.h"

#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    const scree_grain_place *p = a, *q = b;
    return p->id < q->id ? -1 : p->id > q->id;
}

scree_status scree_grain_places(const scree_state *state, scree_grain_place **grain, size_t *count, scree_error *error)
{
    size_t id = 0;
    *count = 0;
    scree_status status = scree_allocate(grain, scree_grain_count(state) + 1, sizeof **grain, error);
    for (uint32_t row; !status && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_grain_place *place = &(*grain)[(*count)++];
        scree_body_position(state, row, place->position);
        place->radius = scree_body_bounding_radius(state, row);
        place->id = state->id[row];
    }
    if (status || !state->part) return status;
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_PLACES);
    status = scree_parts_collect(state, grain, count, sizeof **grain, error);
    (void)scree_traffic_for(before);
    if (!status) qsort(*grain, *count, sizeof **grain, compare);
    return status;
}
