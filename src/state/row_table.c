/// Cost: a multiplication and one or two looks an id; 11 to 21 bytes a body.
#include "state/row_table.h"

#include <string.h>

/// Where the search for an id begins: the upper bits of its product with 2^32 over the golden ratio (Knuth 6.4), which
/// puts ids that follow each other far apart.
static size_t begin_of(const scree_row_table *table, size_t id)
{
    return ((uint32_t)id * 2654435769U * (uint64_t)table->size) >> 32;
}

/// The entry of an id, or the empty one that it would have.
static struct scree_row_entry *entry_of(const scree_row_table *table, size_t id)
{
    size_t k = begin_of(table, id);
    while (table->entry[k].row != SCREE_NO_ROW && table->entry[k].id != id) k = (k + 1) & (table->size - 1);
    return &table->entry[k];
}

uint32_t scree_row_table_find(const struct scree_row_table *table, size_t id)
{
    return entry_of(table, id)->row;
}

void scree_state_set_row(scree_state *state, uint32_t id, uint32_t row)
{
    if (state->rows)
        *entry_of(state->rows, id) = (struct scree_row_entry){id, row};
    else
        state->row_of_id[id] = row;
}

scree_status scree_row_table_begin(scree_state *state, size_t more, scree_error *error)
{
    scree_row_table *table;
    size_t size = 16;
    while (3 * size < 4 * (state->count + more + 1)) size *= 2;
    scree_status status = scree_allocate(&table, 1, sizeof *table, error);
    if (!status) status = scree_allocate(&table->entry, size, sizeof *table->entry, error);
    if (status) {
        scree_release(&table);
        return status;
    }
    table->size = size;
    memset(table->entry, 0xff, size * sizeof *table->entry);
    scree_row_table_end(state);
    scree_release(&state->row_of_id);
    state->id_capacity = 0;
    state->rows = table;
    for (size_t row = 0; row < state->count; row++) scree_state_set_row(state, state->id[row], (uint32_t)row);
    return SCREE_OK;
}

scree_status scree_row_table_leave(scree_state *state, scree_error *error)
{
    scree_status status = scree_allocate(&state->row_of_id, state->id_count + 1, sizeof *state->row_of_id, error);
    if (status) return status;
    scree_row_table_end(state);
    state->id_capacity = state->id_count + 1;
    for (size_t id = 0; id < state->id_count; id++) state->row_of_id[id] = SCREE_NO_ROW;
    for (size_t row = 0; row < state->count; row++) state->row_of_id[state->id[row]] = (uint32_t)row;
    return SCREE_OK;
}

void scree_row_table_end(scree_state *state)
{
    if (state->rows) scree_release(&state->rows->entry);
    scree_release(&state->rows);
}
