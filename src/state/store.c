/// The store of the state: the structs of the modules and the arrays that they declare.
#include "state/store.h"

#include "state/fields.h"

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
