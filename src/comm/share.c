/// All but bodies and pairs of them follows from the declarations of fields, as in a checkpoint: values, groups, and
/// which arrays there are. The others begin with an empty state, so that nothing is left in it of what was there. What
/// is derived as one value is among it, since a step may be half done; modules derive anew what is of the bodies here.
#include "comm/comm.h"
#include "comm/parts.h"
#include "state/fields.h"
#include "state/store.h"

#include <string.h>

/// Bytes of what a field has in a row.
static size_t size_of(const scree_state *state, const scree_field *field)
{
    return (size_t)scree_components(field->components, state->dimension) * scree_field_size(field->type);
}

static scree_status share_values(scree_state *state, const scree_field *field, size_t rows, scree_error *error)
{
    const size_t size = size_of(state, field);
    unsigned char *packed;
    scree_status status = scree_allocate(&packed, rows * size + 1, 1, error);
    if (status) return status;
    for (size_t row = 0; row < rows; row++) memcpy(packed + row * size, scree_field_get(state, field, row), size);
    scree_comm_share(packed, rows * size);
    for (size_t row = 0; row < rows; row++)
        memcpy(scree_field_get_mutable(state, field, row), packed + row * size, size);
    scree_release(&packed);
    return SCREE_OK;
}

static scree_status share_group(scree_state *state, const scree_field *field, scree_error *error)
{
    uint64_t rows = scree_field_rows_count(state, field);
    scree_status status = SCREE_OK;
    if (field->group->pairs) return SCREE_OK;
    scree_comm_share(&rows, sizeof rows);
    if (rows > scree_field_rows_count(state, field)) {
        status = scree_group_reserve(state, field->owner, field->group, rows, error);
        if (!status) scree_group_set_count(state, field->owner, field->group, rows);
    }
    return status ? status : share_values(state, field, rows, error);
}

/// Whether there is an array of bodies or contacts.
static scree_status share_presence(scree_state *state, const scree_field *field, scree_error *error)
{
    uint8_t made = scree_field_is_made(state, field);
    scree_comm_share(&made, sizeof made);
    if (!made || scree_field_is_made(state, field)) return SCREE_OK;
    if (field->rows == SCREE_ROWS_BODIES) return scree_state_begin_field(state, field, error);
    scree_status status = scree_state_reserve_contacts(state, 1, error);
    if (status || scree_field_is_made(state, field)) return status;
    return scree_allocate(scree_field_array(state, field), state->contact_capacity, field->stride, error);
}

static scree_status share_field(scree_state *state, const scree_field *field, scree_error *error)
{
    if (!scree_field_exists(field, state->dimension)) return SCREE_OK;
    switch (field->rows) {
    case SCREE_ROWS_ONE:
        return share_values(state, field, 1, error);
    case SCREE_ROWS_FIXED:
        return share_values(state, field, field->fixed, error);
    case SCREE_ROWS_GROUP:
        return field->role == SCREE_FIELD_STATE ? share_group(state, field, error) : SCREE_OK;
    case SCREE_ROWS_BODIES:
    case SCREE_ROWS_CONTACTS:
        break;
    }
    return share_presence(state, field, error);
}

/// Modules by their slots: addresses differ.
static void share_law(scree_remembered_law *law)
{
    int64_t said[2] = {-1, law->option};
    for (int m = 0; m < SCREE_MODULE_COUNT && law->law; m++)
        if (scree_modules[m] == law->law) said[0] = m;
    scree_comm_share(said, sizeof said);
    *law = (scree_remembered_law){said[0] < 0 ? NULL : scree_modules[said[0]], (unsigned)said[1]};
}

static void share_laws(scree_state *state)
{
    scree_comm_share(&state->pair_laws, sizeof state->pair_laws);
    for (int list = 0; list < SCREE_LISTS; list++) share_law(&state->law[list]);
    for (int k = 0; k < state->pair_laws; k++) share_law(&state->pair_law[k]);
}

/// A state without bodies, in which time has been spent.
static scree_status empty(scree_state *state, scree_error *error)
{
    const scree_time_spent spent = state->spent;
    const uint64_t changes = state->changes;
    const int dimension = state->dimension;
    scree_state_destroy(state);
    scree_status status = scree_state_create(state, dimension, 0, error);
    // With room, so that an array that is there is no null pointer: whether one is there steers what all do.
    if (!status) status = scree_store_reserve_bodies(state, 0, false, error);
    state->spent = spent;
    state->changes = changes + 1;
    return status;
}

scree_status scree_parts_share(scree_state *state, scree_error *error)
{
    scree_status status = scree_comm_rank() > 0 ? empty(state, error) : SCREE_OK;
    if (!status) share_laws(state);
    for (size_t k = 0; k < scree_field_total() && !status; k++) status = share_field(state, scree_field_at(k), error);
    return status;
}
