/// The one field table: drives snapshots, checkpoints, comparison, ParaView files and the documentation of body data.
/// A new per-body quantity is one row here and one member of `scree_state`.
#ifndef SCREE_STATE_FIELDS_H
#define SCREE_STATE_FIELDS_H

#include "state/state.h"

typedef enum scree_field_type { SCREE_FIELD_DOUBLE, SCREE_FIELD_INT64, SCREE_FIELD_UINT32 } scree_field_type;
typedef enum scree_field_role { SCREE_FIELD_STATE, SCREE_FIELD_DERIVED } scree_field_role;

typedef struct scree_field {
    const char *name;
    scree_field_type type;
    int components;
    const char *unit; ///< udunits text, "1" for none
    scree_field_role role;
    bool snapshot; ///< written into snapshots and ParaView files
    const char *meaning;
    size_t array_offset; ///< of the array pointer in scree_state
    size_t stride;       ///< bytes from one body to the next
    size_t offset;       ///< bytes from the start of a body's element to the first component
} scree_field;

extern const scree_field scree_fields[];
extern const size_t scree_field_count;

/// Address of component 0 of `field` of the body in `row`.
const void *scree_field_get(const scree_state *state, const scree_field *field, size_t row);
void *scree_field_get_mutable(scree_state *state, const scree_field *field, size_t row);

#endif
