/// The store of the state: the structs of the modules, the arrays that they declare, and those of bodies.
///
/// Growth. Arrays of bodies are made as large as they must be. When one more does not fit they grow by an eighth, so a
/// body that is appended costs a constant number of copies, eight, however many there are.
#include "state/store.h"

#include "state/fields.h"

#include <assert.h>
#include <string.h>

static int slot_of(const scree_module *module)
{
    int slot = 0;
    while (scree_modules[slot] != module) slot++;
    return slot;
}

scree_status scree_store_open(scree_state *state, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->state_size > 0)
            status = scree_allocate(&state->own[m], 1, scree_modules[m]->state_size, error);
    return status;
}

void scree_store_close(scree_state *state)
{
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        if (!state->own[m]) continue;
        // Several fields may lie in one array; the first of them releases it.
        for (size_t k = 0; k < scree_modules[m]->field_count; k++)
            if (scree_field_is_array(&scree_modules[m]->fields[k]))
                scree_release(scree_field_array(state, &scree_modules[m]->fields[k]));
        scree_release(&state->own[m]);
    }
}

/// Puts the array that a field lies in on the list, unless another field of it is there.
static size_t list_array(const scree_state *state, const scree_field *field, scree_body_array *list, size_t count)
{
    if (field->rows != SCREE_ROWS_BODIES || !scree_field_exists(field, state->dimension)) return count;
    if (field->owner && !state->own[slot_of(field->owner)]) return count;
    void *pointer = scree_field_array(state, field), *array;
    for (size_t k = 0; k < count; k++)
        if (list[k].pointer == pointer) return count;
    memcpy(&array, pointer, sizeof array);
    if (field->optional && !array) return count;
    assert(count < SCREE_BODY_ARRAYS);
    list[count] = (scree_body_array){pointer, field->stride, field->ghosts != SCREE_GHOSTS_NONE, field->optional};
    return count + 1;
}

size_t scree_body_arrays(const scree_state *state, scree_body_array list[SCREE_BODY_ARRAYS])
{
    size_t count = 0, fields;
    const scree_field *own = scree_own_fields(&fields);
    for (size_t k = 0; k < fields; k++) count = list_array(state, &own[k], list, count);
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->field_count; k++)
            count = list_array(state, &scree_modules[m]->fields[k], list, count);
    return count;
}

/// Grows the arrays with or without room for ghosts from their capacity to `wanted`.
static scree_status grow(scree_state *state, bool ghosts, size_t capacity, size_t wanted, scree_error *error)
{
    scree_body_array list[SCREE_BODY_ARRAYS];
    size_t arrays = scree_body_arrays(state, list);
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < arrays && !status; k++)
        if (list[k].ghosts == ghosts) status = scree_reallocate(list[k].pointer, capacity, wanted, list[k].size, error);
    // After a failure some arrays are larger than the capacity says, and the next call copies no more than it says.
    return status;
}

scree_status scree_store_reserve_bodies(scree_state *state, size_t count, bool exactly, scree_error *error)
{
    size_t wanted = count + 1, more = state->body_capacity + state->body_capacity / 8 + 16;
    if (!exactly && wanted < more) wanted = more;
    scree_status status = SCREE_OK;
    if (count + 1 > state->body_capacity) {
        status = grow(state, false, state->body_capacity, wanted, error);
        if (!status) state->body_capacity = wanted;
    }
    if (!status && count + 1 > state->row_capacity) {
        status = grow(state, true, state->row_capacity, wanted, error);
        if (!status) state->row_capacity = wanted;
    }
    return status;
}

/// From `capacity` elements to those that the `count` ones need; leaves what is no longer.
static scree_status cut(void *array, size_t *capacity, size_t count, size_t size, scree_error *error)
{
    const size_t wanted = count + count / 8 + 16;
    if (wanted >= *capacity) return SCREE_OK;
    scree_status status = scree_reallocate(array, *capacity, wanted, size, error);
    if (!status) *capacity = wanted;
    return status;
}

static scree_status cut_contacts(scree_state *state, scree_error *error)
{
    const scree_body_array list[] = {{.pointer = &state->last_force, .size = sizeof *state->last_force},
                                     {.pointer = &state->rolling, .size = sizeof *state->rolling},
                                     {.pointer = &state->contact_law, .size = sizeof *state->contact_law},
                                     {.pointer = &state->contact, .size = sizeof *state->contact}};
    const size_t before = state->contact_capacity;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof list / sizeof *list && !status; k++) {
        size_t capacity = before;
        if (!*(void **)list[k].pointer) continue;
        status = cut(list[k].pointer, &capacity, state->contact_count, list[k].size, error);
        if (!status) state->contact_capacity = capacity;
    }
    return status;
}

scree_status scree_store_shrink(scree_state *state, scree_error *error)
{
    scree_body_array list[SCREE_BODY_ARRAYS];
    const size_t arrays = scree_body_arrays(state, list), before[2] = {state->body_capacity, state->row_capacity};
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < arrays; k++) {
        size_t capacity = before[list[k].ghosts];
        status = cut(list[k].pointer, &capacity, state->count, list[k].size, error);
        if (status) break;
        if (list[k].ghosts)
            state->row_capacity = capacity;
        else
            state->body_capacity = capacity;
    }
    return status ? status : cut_contacts(state, error);
}

scree_status scree_state_reserve_rows(scree_state *state, size_t count, scree_error *error)
{
    if (count <= state->row_capacity) return SCREE_OK;
    size_t wanted = count + count / 8 + 16;
    scree_status status = grow(state, true, state->row_capacity, wanted, error);
    if (!status) state->row_capacity = wanted;
    return status;
}

scree_status scree_state_begin_field(scree_state *state, const scree_field *field, scree_error *error)
{
    void *array, *pointer = scree_field_array(state, field);
    memcpy(&array, pointer, sizeof array);
    if (array) return SCREE_OK;
    return scree_allocate(pointer, field->ghosts ? state->row_capacity : state->body_capacity, field->stride, error);
}

scree_status scree_group_reserve(scree_state *state, const scree_module *module, const scree_group *group, size_t rows,
                                 scree_error *error)
{
    unsigned char *own = state->own[slot_of(module)];
    size_t capacity, wanted = rows + rows / 2 + 16;
    memcpy(&capacity, own + group->capacity_offset, sizeof capacity);
    if (rows <= capacity) return SCREE_OK;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < module->field_count && !status; k++) {
        const scree_field *field = &module->fields[k];
        bool again = false; // another field of the same array came before
        for (size_t j = 0; j < k; j++) again = again || module->fields[j].array_offset == field->array_offset;
        if (field->group == group && !again)
            status = scree_reallocate(own + field->array_offset, capacity, wanted, field->stride, error);
    }
    // After a failure some arrays are larger than the capacity says, and the next call copies no more than it says.
    if (!status) memcpy(own + group->capacity_offset, &wanted, sizeof wanted);
    return status;
}

void scree_group_set_count(scree_state *state, const scree_module *module, const scree_group *group, size_t rows)
{
    unsigned char *own = state->own[slot_of(module)];
    memcpy(own + group->count_offset, &rows, sizeof rows);
}

scree_status scree_group_shrink(scree_state *state, const scree_module *module, const scree_group *group,
                                scree_error *error)
{
    unsigned char *own = state->own[slot_of(module)];
    size_t count, capacity;
    memcpy(&count, own + group->count_offset, sizeof count);
    memcpy(&capacity, own + group->capacity_offset, sizeof capacity);
    const size_t before = capacity;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < module->field_count && !status; k++) {
        const scree_field *field = &module->fields[k];
        bool again = false; // another field of the same array came before
        for (size_t j = 0; j < k; j++) again = again || module->fields[j].array_offset == field->array_offset;
        if (field->group != group || again) continue;
        capacity = before;
        status = cut(own + field->array_offset, &capacity, count, field->stride, error);
        if (!status) memcpy(own + group->capacity_offset, &capacity, sizeof capacity);
    }
    return status;
}
