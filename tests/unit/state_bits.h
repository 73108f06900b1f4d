/// Every bit of every field that is kept of a state, bodies by id: what a restart, other threads or another order of
/// rows must leave the same. Stricter than the state checksum, which holds the physics alone. Contacts must have been
/// saved.
#ifndef SCREE_TESTS_STATE_BITS_H
#define SCREE_TESTS_STATE_BITS_H

#include "base/checksum.h"
#include "state/fields.h"

static inline uint64_t field_bits(const scree_state *state, const scree_field *field, uint64_t bits)
{
    size_t rows = scree_field_rows_count(state, field);
    size_t size = (size_t)scree_components(field->components, state->dimension) * scree_field_size(field->type);
    if (!scree_field_exists(field, state->dimension) || field->role == SCREE_FIELD_DERIVED) return bits;
    bits = scree_checksum_word(bits, rows);
    size_t id = 0;
    for (size_t k = 0; k < rows; k++) {
        size_t row = field->rows == SCREE_ROWS_BODIES ? scree_next_by_id(state, &id) : k;
        bits = scree_checksum_bytes(bits, scree_field_get(state, field, row), size);
    }
    return bits;
}

static inline uint64_t state_bits(const scree_state *state)
{
    uint64_t bits = 0;
    for (size_t k = 0; k < scree_field_total(); k++) bits = field_bits(state, scree_field_at(k), bits);
    return bits;
}

#endif
