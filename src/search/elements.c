/// Bodies near the walls of the case. Cost: linear in the bodies, each a search in the trees of the meshes.
#include "search/search.h"
#include "shape/container.h"

/// The body that elements are found for, and where they go.
typedef struct collector {
    scree_pair_buffer *buffer;
    uint32_t row;
    size_t first; ///< of this body in the buffer
    scree_error *error;
} collector;

/// Puts an element in its place among those of the body.
static scree_status collect(void *context, size_t element)
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
    for (; at > c->first && buffer->pair[at - 1].second > element; at--) buffer->pair[at] = buffer->pair[at - 1];
    buffer->pair[at] = (scree_row_pair){c->row, (uint32_t)element};
    return SCREE_OK;
}

scree_status scree_elements_search(const scree_container *container, const scree_state *state, size_t begin, size_t end,
                                   double skin, scree_pair_buffer *buffer, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t row = begin; container && row < end && !status; row++) {
        collector c = {buffer, (uint32_t)row, buffer->count, error};
        scree_vector place;
        scree_body_place(state, row, place);
        status = scree_container_near(container, place, state->row[row].radius + skin, collect, &c);
    }
    return status;
}
