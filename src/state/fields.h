/// The one field table: drives snapshots, checkpoints, comparison, ParaView files and the documentation of body data.
/// A new per-body quantity is one row here and one member of `scree_state`. A second table of the same form,
/// `scree_members`, names everything else that a checkpoint holds: contacts, boundary loop, walls, single values.
///
/// Some fields exist in one dimension only (scree_field_exists), and vectors have as many components as the dimension.
#ifndef SCREE_STATE_FIELDS_H
#define SCREE_STATE_FIELDS_H

#include "state/state.h"

typedef enum scree_field_type {
    SCREE_FIELD_DOUBLE,
    SCREE_FIELD_INT64,
    SCREE_FIELD_UINT64,
    SCREE_FIELD_FLOAT,
    SCREE_FIELD_INT32,
    SCREE_FIELD_UINT32,
    SCREE_FIELD_UINT8
} scree_field_type;

typedef enum scree_field_role { SCREE_FIELD_STATE, SCREE_FIELD_DERIVED } scree_field_role;

/// What a field has one element of. Bodies, contacts, loop, hull, drive and membrane are arrays that the state points
/// to; walls and the single values lie inside the state itself.
typedef enum scree_field_rows {
    SCREE_ROWS_BODIES,
    SCREE_ROWS_CONTACTS,
    SCREE_ROWS_BOOKING, ///< as many as contacts where the law books them beside the history, else none
    SCREE_ROWS_ROLLING, ///< as many as contacts where there is resistance to rolling, else none
    SCREE_ROWS_LOOP,
    SCREE_ROWS_HULL_NODES,
    SCREE_ROWS_HULL_TRIANGLES,
    SCREE_ROWS_DRIVE,
    SCREE_ROWS_MEMBRANE,
    SCREE_ROWS_WALLS,
    SCREE_ROWS_SURFACES, ///< walls of the case: as many as there can be
    SCREE_ROWS_ONE
} scree_field_rows;

/// Numbers of components that depend on the dimension: d of a vector; 1 in 2D and 3 in 3D of a spin or torque.
enum { SCREE_VECTOR = -1, SCREE_AXIAL_VECTOR = -2 };

typedef struct scree_field {
    const char *name; ///< in scree_members with its group: "walls/position"
    scree_field_type type;
    int components;   ///< or SCREE_VECTOR, SCREE_AXIAL_VECTOR
    const char *unit; ///< udunits text, "1" for none
    scree_field_role role;
    bool snapshot; ///< written as it is into snapshots and ParaView files
    const char *meaning;
    size_t array_offset; ///< of the array pointer (bodies, contacts, loop) or of the first element in scree_state
    size_t stride;       ///< bytes from one element to the next
    size_t offset;       ///< bytes from the start of an element to the first component
    scree_field_rows rows;
    int only_dimension; ///< 2 or 3: exists in this dimension only; 0: in both
} scree_field;

/// Per body.
extern const scree_field scree_fields[];
extern const size_t scree_field_count;

/// Everything else; role is always SCREE_FIELD_STATE.
extern const scree_field scree_members[];
extern const size_t scree_member_count;

/// Address of component 0 of `field` of the body (or contact, vertex of the loop, wall) in `row`.
const void *scree_field_get(const scree_state *state, const scree_field *field, size_t row);
void *scree_field_get_mutable(scree_state *state, const scree_field *field, size_t row);

/// Whether states of this dimension have it.
bool scree_field_exists(const scree_field *field, int dimension);

/// Number of components in a dimension: resolves SCREE_VECTOR and SCREE_AXIAL_VECTOR.
int scree_components(int components, int dimension);

/// Bytes of one component.
size_t scree_field_size(scree_field_type type);

/// Number of elements that `state` has of what `field` describes.
size_t scree_field_rows_count(const scree_state *state, const scree_field *field);

#endif
