/// Rows of the bodies of a part by their ids. A whole state has an array with a row for each id; a part of it would be
/// as long as the sample, so it has a table of those that are here: bodies, and for a while ghosts.
#ifndef SCREE_STATE_ROW_TABLE_H
#define SCREE_STATE_ROW_TABLE_H

#include "state/state.h"

/// Open addressing; a power of two of entries, a quarter of which at least are empty.
typedef struct scree_row_table {
    struct scree_row_entry {
        uint32_t id, row; ///< SCREE_NO_ROW: empty
    } * entry;
    size_t size;
} scree_row_table;

/// The state is a part from now on: the table takes the place of the array, with the bodies that are here and room for
/// `more` ids beside them. Called again it is made anew. Errors: memory; the state has what it had.
scree_status scree_row_table_begin(scree_state *state, size_t more, scree_error *error) SCREE_MUST_USE;

/// The state is whole again: the array is there, with the bodies that are. Errors: memory.
scree_status scree_row_table_leave(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Frees the table.
void scree_row_table_end(scree_state *state);

/// The row of an id, in the array or the table, which has room for it.
void scree_state_set_row(scree_state *state, uint32_t id, uint32_t row);

#endif
