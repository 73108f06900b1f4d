/// Life and order of the state.
#include "state/store.h"

#include <stddef.h>
#include <string.h>

/// An array with one element a body.
typedef struct body_array {
    void *array; ///< address of the pointer
    size_t size; ///< bytes of an element
} body_array;

enum { BODY_ARRAYS = 10 };

/// The arrays that bodies of the state's dimension have; those that move with the rows.
static size_t body_arrays(scree_state *state, body_array arrays[BODY_ARRAYS])
{
    const body_array both[] = {
        {&state->row, sizeof *state->row},
        {&state->sum, sizeof *state->sum},
        {&state->id, sizeof *state->id},
        {&state->species, sizeof *state->species},
        {&state->reference, sizeof *state->reference},
        {&state->sampled_velocity, sizeof *state->sampled_velocity},
        {&state->rebuild, sizeof *state->rebuild},
    };
    size_t count = sizeof both / sizeof *both;
    memcpy(arrays, both, sizeof both);
    if (state->dimension == 3) {
        arrays[count++] = (body_array){&state->turn, sizeof *state->turn};
        arrays[count++] = (body_array){&state->torque, sizeof *state->torque};
    } else {
        arrays[count++] = (body_array){&state->angle, sizeof *state->angle};
    }
    return count;
}

scree_status scree_state_open(scree_state *state, int dimension, scree_error *error)
{
    memset(state, 0, sizeof *state);
    state->dimension = dimension;
    scree_status status = scree_store_open(state, error);
    if (status) scree_state_destroy(state);
    return status;
}

scree_status scree_state_create(scree_state *state, int dimension, size_t count, scree_error *error)
{
    scree_status status = scree_state_open(state, dimension, error);
    return status ? status : scree_state_make_bodies(state, count, error);
}

scree_status scree_state_make_bodies(scree_state *state, size_t count, scree_error *error)
{
    scree_status status = SCREE_OK;
    body_array arrays[BODY_ARRAYS];
    size_t array_count = body_arrays(state, arrays);
    // One element more than there are bodies, so that an empty state has arrays too.
    for (size_t k = 0; k < array_count && !status; k++)
        status = scree_allocate(arrays[k].array, count + 1, arrays[k].size, error);
    if (!status) status = scree_allocate(&state->row_of_id, count + 1, sizeof *state->row_of_id, error);
    if (status) {
        scree_state_destroy(state);
        return status;
    }
    state->count = state->grains = count;
    state->row_capacity = count + 1;
    state->force_quantum = state->torque_quantum = 1.0;
    for (size_t row = 0; row < count; row++) state->id[row] = state->row_of_id[row] = (uint32_t)row;
    return SCREE_OK;
}

void scree_state_destroy(scree_state *state)
{
    void *const others[] = {&state->row_of_id, &state->contact, &state->booking, &state->rolling, &state->foreseen};
    body_array arrays[BODY_ARRAYS];
    size_t array_count = body_arrays(state, arrays);
    for (size_t k = 0; k < array_count; k++) scree_release(arrays[k].array);
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) scree_release(others[k]);
    scree_store_close(state);
    memset(state, 0, sizeof *state);
}

scree_status scree_state_foresee(scree_state *state, scree_error *error)
{
    if (state->foreseen) return SCREE_OK;
    return scree_allocate(&state->foreseen, state->row_capacity, sizeof *state->foreseen, error);
}

scree_status scree_state_append(scree_state *state, size_t more, scree_error *error)
{
    body_array arrays[BODY_ARRAYS];
    size_t array_count = body_arrays(state, arrays), old = state->count, count = old + more;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < array_count && !status; k++)
        status = scree_reallocate(arrays[k].array, old, count + 1, arrays[k].size, error);
    if (!status) status = scree_reallocate(&state->row_of_id, old, count + 1, sizeof *state->row_of_id, error);
    if (status) return status;
    for (size_t row = old; row < count; row++) state->id[row] = state->row_of_id[row] = (uint32_t)row;
    state->count = count;
    state->row_capacity = count + 1;
    scree_release(&state->foreseen);
    return SCREE_OK;
}

double scree_state_time(const scree_state *state)
{
    return state->stage.first_time + (double)(state->step - state->stage.first_step) * state->tick;
}

/// array[k] <- array[order[k]] for elements of `size` bytes, through `scratch`.
static void permute_array(void *array, size_t size, const uint32_t *order, size_t count, unsigned char *scratch)
{
    const unsigned char *bytes = array;
    for (size_t k = 0; k < count; k++) memcpy(scratch + k * size, bytes + order[k] * size, size);
    memcpy(array, scratch, count * size);
}

size_t scree_state_widest(const scree_state *state)
{
    scree_state view = *state;
    body_array arrays[BODY_ARRAYS];
    size_t widest = sizeof *state->foreseen, array_count = body_arrays(&view, arrays);
    for (size_t k = 0; k < array_count; k++)
        if (arrays[k].size > widest) widest = arrays[k].size;
    return widest;
}

scree_status scree_state_permute(scree_state *state, const uint32_t *order, scree_error *error)
{
    unsigned char *scratch;
    if (state->count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&scratch, state->count, scree_state_widest(state), error);
    if (status) return status;
    body_array arrays[BODY_ARRAYS];
    size_t array_count = body_arrays(state, arrays);
    for (size_t k = 0; k < array_count; k++)
        permute_array(*(void **)arrays[k].array, arrays[k].size, order, state->count, scratch);
    if (state->foreseen) permute_array(state->foreseen, sizeof *state->foreseen, order, state->count, scratch);
    scree_release(&scratch);
    for (size_t row = 0; row < state->count; row++) state->row_of_id[state->id[row]] = (uint32_t)row;
    return SCREE_OK;
}

scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error)
{
    if (count <= state->contact_capacity) return SCREE_OK;
    size_t old = state->contact_count, capacity = count + count / 8 + 16;
    scree_status status = scree_reallocate(&state->contact, old, capacity, sizeof *state->contact, error);
    if (!status && state->booking)
        status = scree_reallocate(&state->booking, old, capacity, sizeof *state->booking, error);
    if (!status && state->rolling)
        status = scree_reallocate(&state->rolling, old, capacity, sizeof *state->rolling, error);
    if (!status) state->contact_capacity = capacity;
    return status;
}

scree_status scree_state_reserve_rows(scree_state *state, size_t count, scree_error *error)
{
    if (count <= state->row_capacity) return SCREE_OK;
    size_t before = state->row_capacity, capacity = count + count / 8 + 16;
    scree_status status = scree_reallocate(&state->row, before, capacity, sizeof *state->row, error);
    if (!status) status = scree_reallocate(&state->sum, before, capacity, sizeof *state->sum, error);
    if (!status) status = scree_reallocate(&state->id, before, capacity, sizeof *state->id, error);
    if (!status && state->dimension == 3) {
        status = scree_reallocate(&state->turn, before, capacity, sizeof *state->turn, error);
        if (!status) status = scree_reallocate(&state->torque, before, capacity, sizeof *state->torque, error);
    }
    if (!status && state->foreseen)
        status = scree_reallocate(&state->foreseen, before, capacity, sizeof *state->foreseen, error);
    // After a failure some arrays are larger than the capacity says, and the next call copies no more than it says.
    if (!status) state->row_capacity = capacity;
    return status;
}

void scree_state_release_contacts(scree_state *state)
{
    scree_release(&state->contact);
    scree_release(&state->booking);
    scree_release(&state->rolling);
    state->contact_count = state->contact_capacity = 0;
}

scree_status scree_state_add_booking(scree_state *state, scree_error *error)
{
    if (state->booking) return SCREE_OK;
    return scree_allocate(&state->booking, state->contact_capacity, sizeof *state->booking, error);
}

scree_status scree_state_add_rolling(scree_state *state, scree_error *error)
{
    if (state->rolling) return SCREE_OK;
    return scree_allocate(&state->rolling, state->contact_capacity, sizeof *state->rolling, error);
}

_Static_assert(sizeof(scree_row) == 64 && sizeof(scree_sum_row) == 32, "hot rows have fixed sizes");
_Static_assert(sizeof(scree_contact_memory) == 8 + sizeof(scree_history), "no padding in contact memory");
