/// Bodies near the walls of the case. Cost: linear in the bodies, each a search in the trees of the meshes.
#include "search/search.h"
#include "shape/wall_set.h"

/// The body that primitives are found for, and where they go.
typedef struct collector {
    scree_pair_buffer *buffer;
    uint32_t row;
    size_t first; ///< of this body in the buffer
    scree_error *error;
} collector;

/// Puts a primitive in its place among those of the body.
static scree_status collect(void *context, size_t primitive)
{
    collector *c = context;
    scree_pair_buffer *buffer = c->buffer;
    if (buffer->count == buffer->capacity) {
        size_t capacity = 2 * buffer->capacity + 64;
        scree_status status = scree_reallocate(&buffer->pair, buffer->count, capacity, sizeof *buffer->pair, c->error);
        if (status) return status;
        buffer->capacity = capacity;
    }
    size_t at = buffer->count++;
    for (; at > c->first && buffer->pair[at - 1].second > primitive; at--) buffer->pair[at] = buffer->pair[at - 1];
    buffer->pair[at] = (scree_row_pair){c->row, (uint32_t)primitive};
    return SCREE_OK;
}

scree_status scree_primitives_search(const scree_wall_set *wall_set, const scree_state *state, size_t begin, size_t end,
                                     double skin, const scree_fast *fast, scree_pair_buffer *buffer, scree_error *error)
{
    scree_status status = SCREE_OK;
    int next = 0;
    for (size_t row = begin; wall_set && row < end && !status; row++) {
        collector c = {buffer, (uint32_t)row, buffer->count, error};
        scree_vector position;
        scree_body_position(state, row, position);
        const int number = scree_fast_number(fast, row, &next);
        const double own = number < 0 ? skin : fast->skin[number];
        status = scree_wall_set_near(wall_set, position, state->row[row].radius + own, collect, &c);
    }
    return status;
}
