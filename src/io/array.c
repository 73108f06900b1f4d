/// Packing: from the structs of a state and a contact table to plain arrays and back.
#include "io/array.h"

#include <stddef.h>
#include <string.h>

void scree_array_destroy(scree_array *array)
{
    scree_release(&array->data);
}

scree_status scree_array_allocate(scree_array *array, scree_error *error)
{
    return scree_allocate(&array->data, array->rows, (size_t)array->components * scree_field_size(array->type), error);
}

scree_array scree_array_of_field(const scree_state *state, const scree_field *field)
{
    return (scree_array){.name = field->name,
                         .type = scree_field_stored_type(state, field),
                         .rows = scree_field_rows_count(state, field),
                         .components = scree_components(field->components, state->dimension),
                         .single = field->rows == SCREE_ROWS_ONE,
                         .unit = field->unit,
                         .meaning = field->meaning};
}

/// A value of one type as one of another: the same, or single precision as double and back.
static void convert(const void *from, scree_field_type from_type, void *to, scree_field_type to_type, size_t components)
{
    for (size_t k = 0; k < components && from_type != to_type; k++) {
        const bool narrow = to_type == SCREE_FIELD_FLOAT;
        const double number = narrow ? ((const double *)from)[k] : (double)((const float *)from)[k];
        if (narrow)
            ((float *)to)[k] = (float)number;
        else
            ((double *)to)[k] = number;
    }
    if (from_type == to_type) memcpy(to, from, components * scree_field_size(from_type));
}

/// Between the array and where the law of each contact has the field; zero of laws that have none of it.
static void copy_shared(const scree_array *array, const scree_field *field, scree_state *state, bool to_state)
{
    const size_t components = (size_t)array->components, size = components * scree_field_size(array->type);
    unsigned char *packed = array->data;
    for (size_t k = 0; k < array->rows; k++, packed += size) {
        const scree_field *declared = scree_field_of_contact(state, field, k);
        if (!declared) continue;
        void *value = scree_field_get_mutable(state, declared, k);
        if (to_state)
            convert(packed, array->type, value, declared->type, components);
        else
            convert(value, declared->type, packed, array->type, components);
    }
}

/// Rows of bodies one after the other, in the order of ids or as they lie; begin with *at = 0.
static size_t next_row(const scree_state *state, bool by_id, size_t *at)
{
    return by_id ? scree_next_by_id(state, at) : (*at)++;
}

scree_status scree_array_from_field(const scree_state *state, const scree_field *field, bool by_id, scree_array *array,
                                    scree_error *error)
{
    *array = scree_array_of_field(state, field);
    scree_status status = scree_array_allocate(array, error);
    if (status) return status;
    if (scree_field_is_shared(state, field)) {
        copy_shared(array, field, (scree_state *)(uintptr_t)state, false);
        return SCREE_OK;
    }
    by_id = by_id && field->rows == SCREE_ROWS_BODIES;
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    unsigned char *target = array->data;
    size_t at = 0;
    const unsigned char *first = array->rows > 0 ? scree_field_get(state, field, 0) : NULL;
    for (size_t k = 0; k < array->rows; k++, target += size)
        memcpy(target, first + field->stride * next_row(state, by_id, &at), size);
    return SCREE_OK;
}

scree_status scree_array_send(const scree_route *route, scree_array *array, scree_error *error)
{
    if (!route) return SCREE_OK;
    scree_array range = *array;
    range.rows = route->rows;
    range.begin = route->begin;
    range.total = route->total;
    scree_status status = scree_array_allocate(&range, error);
    if (!status) status = scree_route_move(route, array->data, range.data, scree_array_row_size(array), error);
    scree_array_destroy(array);
    *array = range;
    return status;
}

void scree_array_to_field(const scree_array *array, const scree_field *field, scree_state *state)
{
    if (scree_field_is_shared(state, field)) {
        copy_shared(array, field, state, true);
        return;
    }
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    const unsigned char *source = array->data;
    unsigned char *first = array->rows > 0 ? scree_field_get_mutable(state, field, 0) : NULL;
    for (size_t k = 0; k < array->rows; k++, source += size) memcpy(first + field->stride * k, source, size);
}

// ---- bodies ------------------------------------------------------------------------------------------------------

/// What follows from the state of a body; always doubles.
typedef struct body_result {
    const char *name;
    int components;
    const char *unit;
    const char *meaning;
    void (*evaluate)(const scree_model *model, const scree_state *state, size_t row, double *value);
} body_result;

/// A spin or torque: about z in 2D.
static void copy_axial(const scree_state *state, const scree_vector whole, double *value)
{
    if (state->dimension == 3)
        memcpy(value, whole, sizeof(scree_vector));
    else
        *value = whole[2];
}

static void velocity(const scree_model *model, const scree_state *state, size_t row, double *value)
{
    scree_vector whole, turning;
    scree_body_velocity(model, state, row, whole, turning);
    memcpy(value, whole, (size_t)state->dimension * sizeof *value);
}

static void spin(const scree_model *model, const scree_state *state, size_t row, double *value)
{
    scree_vector whole, turning;
    scree_body_velocity(model, state, row, whole, turning);
    copy_axial(state, turning, value);
}

static void force(const scree_model *model, const scree_state *state, size_t row, double *value)
{
    scree_vector whole, turning;
    scree_body_force(model, state, row, whole, turning);
    memcpy(value, whole, (size_t)state->dimension * sizeof *value);
}

static void torque(const scree_model *model, const scree_state *state, size_t row, double *value)
{
    scree_vector whole, turning;
    scree_body_force(model, state, row, whole, turning);
    copy_axial(state, turning, value);
}

static void displacement(const scree_model *model, const scree_state *state, size_t row, double *value)
{
    (void)model;
    scree_vector place;
    scree_body_position(state, row, place);
    for (int k = 0; k < state->dimension; k++) value[k] = place[k] - state->reference[row][k];
}

static const body_result body_results[] = {
    {"velocity", SCREE_VECTOR, "m/s", "velocity of the centre", velocity},
    {"spin", SCREE_AXIAL_VECTOR, "rad/s", "angular velocity, counter-clockwise", spin},
    {"force", SCREE_VECTOR, "N", "sum of all forces, with boundary forces and gravity", force},
    {"torque", SCREE_AXIAL_VECTOR, "N m", "sum of all torques, counter-clockwise", torque},
    {"displacement", SCREE_VECTOR, "m", "displacement since the start of the loading stage", displacement},
};
enum { BODY_RESULT_COUNT = sizeof body_results / sizeof *body_results };

/// Whether the field is one of snapshots, and is there.
static bool is_in_snapshot(const scree_state *state, const scree_field *field)
{
    if (field->rows != SCREE_ROWS_BODIES || !field->snapshot || !scree_field_exists(field, state->dimension))
        return false;
    return !field->optional || (scree_state_total(state) > 0 && scree_field_is_made(state, field));
}

/// The index-th field of bodies in snapshots, NULL when there are fewer.
static const scree_field *snapshot_field(const scree_state *state, size_t index)
{
    for (size_t k = 0; k < scree_field_total(); k++)
        if (is_in_snapshot(state, scree_field_at(k)) && index-- == 0) return scree_field_at(k);
    return NULL;
}

static size_t snapshot_field_count(const scree_state *state)
{
    size_t count = 0;
    while (snapshot_field(state, count)) count++;
    return count;
}

size_t scree_body_array_count(const scree_state *state)
{
    return snapshot_field_count(state) + BODY_RESULT_COUNT;
}

scree_status scree_body_array(const scree_model *model, const scree_state *state, size_t index, scree_array *array,
                              scree_error *error)
{
    const scree_field *field = snapshot_field(state, index);
    if (field) return scree_array_from_field(state, field, !state->part, array, error);
    const body_result *result = &body_results[index - snapshot_field_count(state)];
    *array = (scree_array){.name = result->name,
                           .type = SCREE_FIELD_DOUBLE,
                           .rows = state->count,
                           .components = scree_components(result->components, state->dimension),
                           .unit = result->unit,
                           .meaning = result->meaning};
    scree_status status = scree_array_allocate(array, error);
    if (status) return status;
    double *value = array->data;
    size_t at = 0;
    for (size_t k = 0; k < state->count; k++, value += array->components)
        result->evaluate(model, state, next_row(state, !state->part, &at), value);
    return SCREE_OK;
}

// ---- contacts ----------------------------------------------------------------------------------------------------

typedef struct contact_member {
    const char *name;
    scree_field_type type;
    int components;
    const char *unit;
    const char *meaning;
    size_t offset; ///< in scree_contact
} contact_member;

/// Rows of `first` and `second` become ids when they are packed.
static const contact_member contact_members[] = {
    {"first", SCREE_FIELD_UINT32, 1, "1", "id of the first body", offsetof(scree_contact, first)},
    {"second", SCREE_FIELD_UINT32, 1, "1",
     "id of the second body; 4294967280 + index for a plate, 2147483648 + primitive for a wall of the case",
     offsetof(scree_contact, second)},
    {"normal", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "1", "unit normal n, from the second to the first",
     offsetof(scree_contact, normal)},
    {"point", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", "contact point", offsetof(scree_contact, point)},
    {"branch", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m",
     "from the centre of the second (a wall: the contact point) to that of the first", offsetof(scree_contact, branch)},
    {"tangent", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "1",
     "unit tangent t: (-n_y, n_x) in 2D, direction of the tangential force in 3D", offsetof(scree_contact, tangent)},
    {"overlap", SCREE_FIELD_DOUBLE, 1, "m", "overlap of the undeformed bodies", offsetof(scree_contact, overlap)},
    {"normal_force", SCREE_FIELD_DOUBLE, 1, "N", "force on the first along n, pushing apart: positive",
     offsetof(scree_contact, normal_force)},
    {"tangential_force", SCREE_FIELD_DOUBLE, 1, "N", "force on the first along t",
     offsetof(scree_contact, tangential_force)},
    {"slip", SCREE_FIELD_DOUBLE, 1, "m/s", "slip velocity of the first past the second, along t in 2D, magnitude in 3D",
     offsetof(scree_contact, slip)},
    {"sliding", SCREE_FIELD_UINT8, 1, "1", "1: friction is fully mobilised", offsetof(scree_contact, sliding)},
    {"bonded", SCREE_FIELD_UINT8, 1, "1", "1: a bond, which may pull", offsetof(scree_contact, bonded)},
    {"elastic_normal", SCREE_FIELD_DOUBLE, 1, "J", "elastic energy of the overlap",
     offsetof(scree_contact, elastic_normal)},
    {"elastic_tangential", SCREE_FIELD_DOUBLE, 1, "J", "elastic energy of the tangential spring",
     offsetof(scree_contact, elastic_tangential)},
};
_Static_assert(sizeof(bool) == 1, "a bool is written as one byte");

size_t scree_contact_array_count(void)
{
    return sizeof contact_members / sizeof *contact_members;
}

scree_status scree_contact_array(const scree_state *state, const scree_contact_table *table, size_t index,
                                 scree_array *array, scree_error *error)
{
    const contact_member *member = &contact_members[index];
    *array = (scree_array){.name = member->name,
                           .type = member->type,
                           .rows = table->count,
                           .components = scree_components(member->components, state->dimension),
                           .unit = member->unit,
                           .meaning = member->meaning};
    scree_status status = scree_array_allocate(array, error);
    if (status) return status;
    const size_t size = (size_t)array->components * scree_field_size(array->type);
    unsigned char *target = array->data;
    for (size_t k = 0; k < table->count; k++, target += size) {
        const scree_contact *contact = &table->contact[k];
        uint32_t first = state->id[contact->first];
        uint32_t second = scree_contact_second_id(state, contact);
        const void *source = (const unsigned char *)contact + member->offset;
        if (member->offset == offsetof(scree_contact, first)) source = &first;
        if (member->offset == offsetof(scree_contact, second)) source = &second;
        memcpy(target, source, size);
    }
    return SCREE_OK;
}

size_t scree_position_of_id(const uint32_t *ids, size_t count, uint32_t id)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (ids[middle] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && ids[low] == id ? low : count;
}
