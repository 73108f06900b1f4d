/// Life and order of the state.
#include "state/row_table.h"
#include "state/store.h"

#include <stddef.h>
#include <string.h>

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

/// Makes row_of_id reach to `count` ids; new ones are of no body yet.
static scree_status reserve_ids(scree_state *state, size_t count, bool exactly, scree_error *error)
{
    size_t wanted = count + 1, more = state->id_capacity + state->id_capacity / 8 + 16;
    if (!exactly && wanted < more) wanted = more;
    if (count + 1 > state->id_capacity) {
        scree_status status =
            scree_reallocate(&state->row_of_id, state->id_count, wanted, sizeof *state->row_of_id, error);
        if (status) return status;
        state->id_capacity = wanted;
    }
    for (; state->id_count < count; state->id_count++) state->row_of_id[state->id_count] = SCREE_NO_ROW;
    return SCREE_OK;
}

/// Bodies with the next ids in the rows from state->count on, for which there is room.
static void add_rows(scree_state *state, scree_mark mark, size_t more)
{
    for (size_t k = 0; k < more; k++) {
        size_t row = state->count++, id = state->next_id++;
        state->id[row] = (uint32_t)id;
        state->row_of_id[id] = (uint32_t)row;
        state->mark[row] = (uint8_t)mark;
    }
    state->marked[mark] += more;
    state->changes++;
}

scree_status scree_state_make_bodies(scree_state *state, size_t count, scree_error *error)
{
    scree_status status = scree_store_reserve_bodies(state, count, true, error);
    if (!status) status = reserve_ids(state, count, true, error);
    if (status) {
        scree_state_destroy(state);
        return status;
    }
    state->force_quantum = state->torque_quantum = 1.0;
    add_rows(state, SCREE_MARK_GRAIN, count);
    return SCREE_OK;
}

void scree_state_destroy(scree_state *state)
{
    scree_row_table_end(state);
    void *const others[] = {&state->row_of_id, &state->contact, &state->last_force, &state->rolling,
                            &state->contact_law};
    scree_body_array list[SCREE_BODY_ARRAYS];
    size_t arrays = scree_body_arrays(state, list);
    for (size_t k = 0; k < arrays; k++) scree_release(list[k].pointer);
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) scree_release(others[k]);
    scree_store_close(state);
    memset(state, 0, sizeof *state);
}

scree_status scree_state_predict(scree_state *state, scree_error *error)
{
    if (state->predicted) return SCREE_OK;
    return scree_allocate(&state->predicted, state->row_capacity, sizeof *state->predicted, error);
}

scree_status scree_state_begin_form(scree_state *state, scree_error *error)
{
    if (state->form) return SCREE_OK;
    scree_status status = scree_allocate(&state->form, state->row_capacity, sizeof *state->form, error);
    if (status || state->reference_angle) return status;
    return scree_allocate(&state->reference_angle, state->body_capacity, sizeof *state->reference_angle, error);
}

scree_status scree_state_ask_for_moments(scree_state *state, bool wanted, scree_error *error)
{
    if (!wanted) scree_release(&state->moment);
    if (!wanted || state->moment) return SCREE_OK;
    return scree_allocate(&state->moment, state->row_capacity,
                          scree_moment_size(state->dimension) * sizeof *state->moment, error);
}

scree_status scree_state_ask_for_stretches(scree_state *state, scree_error *error)
{
    if (state->stretch) return SCREE_OK;
    return scree_allocate(&state->stretch, state->row_capacity,
                          scree_stretch_size(state->dimension) * sizeof *state->stretch, error);
}

scree_status scree_state_append(scree_state *state, scree_mark mark, size_t more, scree_error *error)
{
    scree_body_array list[SCREE_BODY_ARRAYS];
    if (state->next_id >= SCREE_PRIMITIVE_ID || more >= SCREE_PRIMITIVE_ID - state->next_id)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu bodies were there so far: there can be no %zu more",
                               state->next_id, more);
    scree_status status = scree_store_reserve_bodies(state, state->count + more, false, error);
    if (!status) status = reserve_ids(state, state->next_id + more, false, error);
    if (status) return status;
    // Bodies that were there before, and ghosts, may have left something behind.
    size_t arrays = scree_body_arrays(state, list);
    for (size_t k = 0; k < arrays; k++)
        memset(*(unsigned char **)list[k].pointer + state->count * list[k].size, 0, more * list[k].size);
    add_rows(state, mark, more);
    return SCREE_OK;
}

/// Why the body with this id cannot be taken out; NULL: it can.
static const char *why_not(const scree_state *state, uint32_t id)
{
    if (scree_state_row_of(state, id) == SCREE_NO_ROW) return "there is none with this id";
    const char *why = NULL;
    for (int m = 0; m < SCREE_MODULE_COUNT && !why; m++)
        if (scree_modules[m]->keeps) why = scree_modules[m]->keeps(state, id);
    return why;
}

/// Marks in row_of_id the bodies that are about to go: rows stay below it.
#define GOING UINT32_C(0x80000000)

static bool is_going(const scree_state *state, size_t id)
{
    uint32_t row = scree_state_row_of(state, id);
    return row != SCREE_NO_ROW && (row & GOING);
}

scree_status scree_state_check_removal(scree_state *state, const uint32_t *ids, size_t count, scree_error *error)
{
    const char *why = NULL;
    size_t seen = 0, named = 0;
    for (; seen < count; seen++)
        if ((why = why_not(state, ids[seen]))) break;
    for (; !why && named < count; named++) {
        if (is_going(state, ids[named])) why = "it is named twice";
        if (why) break;
        state->row_of_id[ids[named]] |= GOING;
    }
    for (size_t k = 0; k < named; k++) state->row_of_id[ids[k]] &= ~GOING;
    if (!why) return SCREE_OK;
    uint32_t id = ids[seen < count ? seen : named];
    return scree_error_set(error, SCREE_ERROR_INPUT, "body %u cannot be taken out: %s", id, why);
}

/// Drops what the contact memory has of bodies that are going; the order stays.
static void forget_contacts(scree_state *state)
{
    size_t kept = 0;
    for (size_t k = 0; k < state->contact_count; k++) {
        if (is_going(state, state->contact[k].first) || is_going(state, state->contact[k].second)) continue;
        state->contact[kept] = state->contact[k];
        if (state->last_force) state->last_force[kept] = state->last_force[k];
        if (state->rolling) state->rolling[kept] = state->rolling[k];
        if (state->contact_law) state->contact_law[kept] = state->contact_law[k];
        kept++;
    }
    state->contact_count = kept;
}

/// Takes one row out; the last one moves into it.
static void remove_row(scree_state *state, const scree_body_array *list, size_t arrays, size_t row)
{
    size_t last = --state->count;
    uint32_t id = state->id[row], moved = state->id[last];
    state->marked[state->mark[row]]--;
    for (size_t k = 0; k < arrays; k++) {
        unsigned char *array = *(unsigned char **)list[k].pointer, *from = array + last * list[k].size;
        if (row != last) memcpy(array + row * list[k].size, from, list[k].size);
        memset(from, 0, list[k].size); // the sums of a ghost that takes this row are clear
    }
    state->row_of_id[moved] = (uint32_t)row | (state->row_of_id[moved] & GOING);
    state->row_of_id[id] = SCREE_NO_ROW;
}

scree_status scree_state_remove(scree_state *state, const uint32_t *ids, size_t count, scree_error *error)
{
    scree_status status = scree_state_check_removal(state, ids, count, error);
    if (status || count == 0) return status;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < count && scree_modules[m]->forget; k++) scree_modules[m]->forget(state, ids[k]);
    for (size_t k = 0; k < count; k++) state->row_of_id[ids[k]] |= GOING;
    forget_contacts(state);
    scree_body_array list[SCREE_BODY_ARRAYS];
    size_t arrays = scree_body_arrays(state, list);
    for (size_t k = 0; k < count; k++) remove_row(state, list, arrays, state->row_of_id[ids[k]] & ~GOING);
    state->changes++;
    return SCREE_OK;
}

static scree_status refuse_id(const scree_state *state, size_t row, size_t limit, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_INPUT, "row %zu: %u (accepted: ids below %zu, each at most once)", row,
                           state->id[row], limit);
}

scree_status scree_state_find_rows(scree_state *state, scree_error *error)
{
    const size_t limit = state->next_id < SCREE_PRIMITIVE_ID ? state->next_id : SCREE_PRIMITIVE_ID;
    size_t bad = 0, ids = 0;
    for (; bad < state->count && state->id[bad] < limit; bad++)
        if (state->id[bad] >= ids) ids = (size_t)state->id[bad] + 1;
    if (bad < state->count) return refuse_id(state, bad, limit, error);
    state->id_count = 0;
    scree_status status = reserve_ids(state, ids, true, error);
    if (status) return status;
    memset(state->marked, 0, sizeof state->marked);
    for (size_t row = 0; row < state->count; row++) {
        uint32_t id = state->id[row];
        if (state->row_of_id[id] != SCREE_NO_ROW) return refuse_id(state, row, limit, error);
        state->row_of_id[id] = (uint32_t)row;
        if (state->mark[row] < SCREE_MARKS) state->marked[state->mark[row]]++;
    }
    state->changes++;
    return SCREE_OK;
}

scree_status scree_grains_by_id(const scree_state *state, uint32_t **rows, scree_error *error)
{
    scree_status status = scree_allocate(rows, scree_grain_count(state), sizeof **rows, error);
    size_t count = 0, id = 0;
    for (uint32_t row; !status && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;)
        if (state->mark[row] == SCREE_MARK_GRAIN) (*rows)[count++] = row;
    return status;
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
    scree_body_array list[SCREE_BODY_ARRAYS];
    size_t widest = sizeof *state->predicted, arrays = scree_body_arrays(state, list);
    for (size_t k = 0; k < arrays; k++)
        if (list[k].size > widest) widest = list[k].size;
    return widest;
}

scree_status scree_state_permute(scree_state *state, const uint32_t *order, scree_error *error)
{
    unsigned char *scratch;
    if (state->count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&scratch, state->count, scree_state_widest(state), error);
    if (status) return status;
    scree_body_array list[SCREE_BODY_ARRAYS];
    size_t arrays = scree_body_arrays(state, list);
    for (size_t k = 0; k < arrays; k++)
        permute_array(*(void **)list[k].pointer, list[k].size, order, state->count, scratch);
    scree_release(&scratch);
    for (size_t row = 0; row < state->count; row++) scree_state_set_row(state, state->id[row], (uint32_t)row);
    return SCREE_OK;
}

scree_status scree_state_reserve_contacts(scree_state *state, size_t count, scree_error *error)
{
    if (count <= state->contact_capacity) return SCREE_OK;
    size_t old = state->contact_count, capacity = count + count / 8 + 16;
    scree_status status = scree_reallocate(&state->contact, old, capacity, sizeof *state->contact, error);
    if (!status && state->last_force)
        status = scree_reallocate(&state->last_force, old, capacity, sizeof *state->last_force, error);
    if (!status && state->rolling)
        status = scree_reallocate(&state->rolling, old, capacity, sizeof *state->rolling, error);
    if (!status && state->contact_law)
        status = scree_reallocate(&state->contact_law, old, capacity, sizeof *state->contact_law, error);
    if (!status) state->contact_capacity = capacity;
    return status;
}

void scree_state_release_contacts(scree_state *state)
{
    scree_release(&state->contact);
    scree_release(&state->last_force);
    scree_release(&state->rolling);
    scree_release(&state->contact_law);
    state->contact_count = state->contact_capacity = 0;
}

void scree_state_set_laws(scree_state *state, const scree_model *model)
{
    const scree_law_use *use = &model->laws[0], *holding = &model->persistent.law;
    state->law[SCREE_LIST_CONTACTS] = (scree_remembered_law){scree_modules[use->law], use->option};
    state->law[SCREE_LIST_PERSISTENT] = (scree_remembered_law){NULL, 0};
    if (scree_model_holds(model))
        state->law[SCREE_LIST_PERSISTENT] = (scree_remembered_law){scree_modules[holding->law], holding->option};
    state->pair_laws = model->pair_laws;
    for (int k = 0; k < model->pair_laws; k++)
        state->pair_law[k] = (scree_remembered_law){scree_modules[model->laws[k + 1].law], model->laws[k + 1].option};
}

scree_status scree_state_add_contact_law(scree_state *state, scree_error *error)
{
    if (state->contact_law) return SCREE_OK;
    return scree_allocate(&state->contact_law, state->contact_capacity, sizeof *state->contact_law, error);
}

scree_status scree_state_add_last_force(scree_state *state, scree_error *error)
{
    if (state->last_force) return SCREE_OK;
    return scree_allocate(&state->last_force, state->contact_capacity, sizeof *state->last_force, error);
}

scree_status scree_state_add_rolling(scree_state *state, scree_error *error)
{
    if (state->rolling) return SCREE_OK;
    return scree_allocate(&state->rolling, state->contact_capacity, sizeof *state->rolling, error);
}

_Static_assert(sizeof(scree_row) == 64 && sizeof(scree_sum_row) == 32, "hot rows have fixed sizes");
_Static_assert(sizeof(scree_contact_memory) == 8 + sizeof(scree_history), "no padding in contact memory");
