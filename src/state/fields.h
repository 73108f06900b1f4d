/// All fields of a run, those of the state itself and those that modules declare, as one list: it drives snapshots,
/// checkpoints, checks, ParaView files and the documentation. A new quantity is one row where it belongs.
#ifndef SCREE_STATE_FIELDS_H
#define SCREE_STATE_FIELDS_H

#include "state/state.h"

/// The fields by number: first those of the state itself, then those of the modules in the order of their table.
size_t scree_field_total(void);
const scree_field *scree_field_at(size_t index);

/// Those of the state itself, as an array.
const scree_field *scree_own_fields(size_t *count);

/// Whether states of this dimension have it.
bool scree_field_exists(const scree_field *field, int dimension);

/// Whether this state has it: what contacts remember depends on their law, too.
bool scree_field_is_here(const scree_state *state, const scree_field *field);

/// Whether it is of contacts that follow several laws, each of which may declare it in another place, or not at all: it
/// is no array then.
bool scree_field_is_shared(const scree_state *state, const scree_field *field);

/// The declaration of a shared field by the law of contact `row`, or by the law with this number; NULL: none.
const scree_field *scree_field_of_contact(const scree_state *state, const scree_field *field, size_t row);
const scree_field *scree_field_of_law(const scree_state *state, const scree_field *field, int number);

/// Of its values in files: of a shared field one that holds those of all laws.
scree_field_type scree_field_stored_type(const scree_state *state, const scree_field *field);

/// The same for what checkpoints hold.
bool scree_field_is_stored(const scree_state *state, const scree_field *field);

/// Whether its elements lie behind a pointer, not in the struct of its owner itself.
static inline bool scree_field_is_array(const scree_field *field)
{
    return field->rows != SCREE_ROWS_ONE && field->rows != SCREE_ROWS_FIXED;
}

/// The list of contacts whose law a field is of, where it is of one.
static inline scree_list scree_field_list(const scree_field *field)
{
    return field->rows == SCREE_ROWS_CONTACTS ? SCREE_LIST_CONTACTS : SCREE_LIST_PERSISTENT;
}

/// What number `row` of a list remembers that physics depends on, as its law declares it; returns how many numbers.
enum { SCREE_CHECKSUM_VALUES = 16 };
size_t scree_remembered_values(const scree_state *state, scree_list list, size_t row,
                               double value[SCREE_CHECKSUM_VALUES]);

/// Whether there is the array of a field of bodies or contacts: the same in all parts of a sample.
bool scree_field_is_made(const scree_state *state, const scree_field *field);

/// Number of elements that `state` has of what `field` describes.
size_t scree_field_rows_count(const scree_state *state, const scree_field *field);

/// Address of component 0 of `field` of the body (or contact, row of a group) in `row`.
const void *scree_field_get(const scree_state *state, const scree_field *field, size_t row);
void *scree_field_get_mutable(scree_state *state, const scree_field *field, size_t row);

/// Address of the pointer to the array of a field, or of the first element of one that lies in its owner's struct.
void *scree_field_array(const scree_state *state, const scree_field *field);

/// Makes the arrays of a group of `module` hold at least `rows`; what they hold stays. Errors: memory, the group is as
/// it was then.
scree_status scree_group_reserve(scree_state *state, const scree_module *module, const scree_group *group, size_t rows,
                                 scree_error *error) SCREE_MUST_USE;

/// Number of rows of a group. Setting it does not make room.
void scree_group_set_count(scree_state *state, const scree_module *module, const scree_group *group, size_t rows);

#endif
