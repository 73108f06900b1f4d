/// A packed array with its name, unit and meaning: the form in which data goes into and comes out of files. Snapshots,
/// checkpoints and ParaView files are made of these, so each of them lists arrays and knows nothing of structs.
#ifndef SCREE_IO_ARRAY_H
#define SCREE_IO_ARRAY_H

#include "comm/ranges.h"
#include "contact/contact.h"
#include "integrate/integrate.h"
#include "state/fields.h"

typedef struct scree_array {
    const char *name; ///< in files with groups: "walls/position"
    scree_field_type type;
    size_t rows;
    size_t begin, total; ///< total > 0: the rows are those from `begin` on of so many, which several processes write
    int components;
    bool single;      ///< one element: a file shows a plain value (or vector), not a table of one row
    const char *unit; ///< udunits text
    const char *meaning;
    void *data; ///< rows * components values, side by side
} scree_array;

/// Rows of all processes.
static inline size_t scree_array_total(const scree_array *array)
{
    return array->total > 0 ? array->total : array->rows;
}

/// Bytes of a row.
static inline size_t scree_array_row_size(const scree_array *array)
{
    return (size_t)array->components * scree_field_size(array->type);
}

/// Frees the data.
void scree_array_destroy(scree_array *array);

/// Allocates data (zero) for the shape that the other members describe. Errors: memory.
scree_status scree_array_allocate(scree_array *array, scree_error *error) SCREE_MUST_USE;

/// The array that `field` of `state` is, without data: shape, type, texts.
scree_array scree_array_of_field(const scree_state *state, const scree_field *field);

/// Packs `field`; bodies in id order when `by_id` is set, else in row order. Errors: memory.
scree_status scree_array_from_field(const scree_state *state, const scree_field *field, bool by_id, scree_array *array,
                                    scree_error *error) SCREE_MUST_USE;
/// From the rows that this process has, in their order, to those that it writes; without a route it writes what it has.
/// Errors: memory.
scree_status scree_array_send(const scree_route *route, scree_array *array, scree_error *error) SCREE_MUST_USE;

/// The way back, in row order; shapes must agree.
void scree_array_to_field(const scree_array *array, const scree_field *field, scree_state *state);

/// What snapshots and ParaView files show of each body, in id order (those of a part in row order): the fields with
/// snapshot = true, then what follows from them (velocity and spin at the step itself, force, torque, displacement
/// since the start of the loading stage). index < scree_body_array_count(). Errors: memory.
size_t scree_body_array_count(const scree_state *state);
scree_status scree_body_array(const scree_model *model, const scree_state *state, size_t index, scree_array *array,
                              scree_error *error) SCREE_MUST_USE;

/// The same for contacts: ids of both (walls as SCREE_WALL_ID + index) and everything else in scree_contact.
size_t scree_contact_array_count(void);
scree_status scree_contact_array(const scree_state *state, const scree_contact_table *table, size_t index,
                                 scree_array *array, scree_error *error) SCREE_MUST_USE;

/// Place of an id among ids that ascend, as files have those of bodies; `count` when it is none of them.
size_t scree_position_of_id(const uint32_t *ids, size_t count, uint32_t id);

#endif
