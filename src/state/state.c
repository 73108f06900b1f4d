/// Life, order and checksum of the state.
#include "state/state.h"

#include "base/checksum.h"

#include <string.h>

scree_status scree_state_create(scree_state *state, size_t count, scree_error *error)
{
    memset(state, 0, sizeof *state);
    scree_status status = SCREE_OK;
    struct {
        void *array;
        size_t size;
    } const arrays[] = {
        {&state->row, sizeof *state->row},
        {&state->sum, sizeof *state->sum},
        {&state->id, sizeof *state->id},
        {&state->angle, sizeof *state->angle},
        {&state->reference_x, sizeof *state->reference_x},
        {&state->reference_y, sizeof *state->reference_y},
        {&state->sampled_vx, sizeof *state->sampled_vx},
        {&state->sampled_vy, sizeof *state->sampled_vy},
        {&state->rebuild_x, sizeof *state->rebuild_x},
        {&state->rebuild_y, sizeof *state->rebuild_y},
        {&state->row_of_id, sizeof *state->row_of_id},
    };
    // One element more than there are bodies, so that an empty state has arrays too.
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays && !status; k++)
        status = scree_allocate(arrays[k].array, count + 1, arrays[k].size, error);
    if (status) {
        scree_state_destroy(state);
        return status;
    }
    state->count = count;
    state->force_quantum = state->torque_quantum = 1.0;
    for (size_t row = 0; row < count; row++) state->id[row] = state->row_of_id[row] = (uint32_t)row;
    return SCREE_OK;
}

void scree_state_destroy(scree_state *state)
{
    void *const arrays[] = {&state->row,         &state->sum,         &state->id,        &state->angle,
                            &state->reference_x, &state->reference_y, &state->rebuild_x, &state->rebuild_y,
                            &state->row_of_id,   &state->contact,     &state->loop.id,   &state->loop.loaded,
                            &state->loop.x,      &state->loop.y,      &state->loop.fx,   &state->loop.fy,
                            &state->sampled_vx,  &state->sampled_vy,  &state->foreseen};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    memset(state, 0, sizeof *state);
}

scree_status scree_state_foresee(scree_state *state, scree_error *error)
{
    if (state->foreseen) return SCREE_OK;
    return scree_allocate(&state->foreseen, state->count + 1, sizeof *state->foreseen, error);
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

scree_status scree_state_permute(scree_state *state, const uint32_t *order, scree_error *error)
{
    unsigned char *scratch;
    if (state->count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&scratch, state->count, sizeof(scree_row), error);
    if (status) return status;
    permute_array(state->row, sizeof *state->row, order, state->count, scratch);
    permute_array(state->sum, sizeof *state->sum, order, state->count, scratch);
    permute_array(state->id, sizeof *state->id, order, state->count, scratch);
    permute_array(state->angle, sizeof *state->angle, order, state->count, scratch);
    permute_array(state->reference_x, sizeof *state->reference_x, order, state->count, scratch);
    permute_array(state->reference_y, sizeof *state->reference_y, order, state->count, scratch);
    permute_array(state->sampled_vx, sizeof *state->sampled_vx, order, state->count, scratch);
    permute_array(state->sampled_vy, sizeof *state->sampled_vy, order, state->count, scratch);
    permute_array(state->rebuild_x, sizeof *state->rebuild_x, order, state->count, scratch);
    permute_array(state->rebuild_y, sizeof *state->rebuild_y, order, state->count, scratch);
    if (state->foreseen) permute_array(state->foreseen, sizeof *state->foreseen, order, state->count, scratch);
    scree_release(&scratch);
    for (size_t row = 0; row < state->count; row++) state->row_of_id[state->id[row]] = (uint32_t)row;
    return SCREE_OK;
}

scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error)
{
    if (count <= state->contact_capacity) return SCREE_OK;
    size_t capacity = count + count / 8 + 16;
    scree_status status =
        scree_reallocate(&state->contact, state->contact_count, capacity, sizeof *state->contact, error);
    if (!status) state->contact_capacity = capacity;
    return status;
}

_Static_assert(sizeof(scree_row) == 64 && sizeof(scree_sum_row) == 32, "hot rows have fixed sizes");
_Static_assert(sizeof(scree_contact_memory) == 8 + sizeof(scree_history), "no padding in contact memory");

uint64_t scree_state_checksum(const scree_state *state)
{
    uint64_t c = scree_checksum_word(state->step, state->count);
    for (size_t id = 0; id < state->count; id++) {
        size_t row = state->row_of_id[id];
        c = scree_checksum_bytes(c, &state->row[row], sizeof state->row[row]);
        c = scree_checksum_bytes(c, &state->sum[row], sizeof state->sum[row]);
        c = scree_checksum_bytes(c, &state->angle[row], sizeof(double));
        c = scree_checksum_bytes(c, &state->reference_x[row], sizeof(double));
        c = scree_checksum_bytes(c, &state->reference_y[row], sizeof(double));
        c = scree_checksum_bytes(c, &state->sampled_vx[row], sizeof(double));
        c = scree_checksum_bytes(c, &state->sampled_vy[row], sizeof(double));
    }
    const double scalars[] = {state->tick,           state->step_size,       state->kick_size,     state->force_quantum,
                              state->torque_quantum, state->largest_overlap, state->largest_speed, state->pressure};
    c = scree_checksum_bytes(c, scalars, sizeof scalars);
    c = scree_checksum_bytes(c, state->contact, state->contact_count * sizeof *state->contact);
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const scree_wall *wall = &state->wall[w];
        const double values[] = {wall->position, wall->normal[0], wall->normal[1],          wall->velocity,
                                 wall->force,    wall->shear,     wall->tangential_velocity};
        c = scree_checksum_bytes(c, values, sizeof values);
        c = scree_checksum_word(c, (uint64_t)(uint32_t)wall->active << 32 | (uint32_t)wall->material);
    }
    for (size_t k = 0; k < state->loop.count; k++) {
        c = scree_checksum_word(c, (uint64_t)state->loop.id[k] << 8 | state->loop.loaded[k]);
        c = scree_checksum_bytes(c, &state->loop.x[k], sizeof(double));
        c = scree_checksum_bytes(c, &state->loop.y[k], sizeof(double));
        c = scree_checksum_bytes(c, &state->loop.fx[k], sizeof(double));
        c = scree_checksum_bytes(c, &state->loop.fy[k], sizeof(double));
    }
    c = scree_checksum_word(scree_checksum_word(c, state->loop.updated), state->sampled_step);
    c = scree_checksum_word(c, state->evaluations);
    c = scree_checksum_bytes(c, &state->strain, sizeof state->strain);
    c = scree_checksum_bytes(c, &state->ledger, sizeof state->ledger);
    return scree_checksum_bytes(c, &state->stage, sizeof state->stage);
}
