/// Rows of a part by their ids: all that are here are found, others are not, and the array comes back with the whole;
/// arrays of a part are as long as the part.
#include "testing.h"

#include "base/memory.h"
#include "state/row_table.h"
#include "state/store.h"

enum { ALL = 5000, EVERY = 7 };

/// A part with every seventh body of a sample, rows in another order than ids.
static void make_part(scree_state *state)
{
    size_t kept = 0;
    assert_int_equal(scree_state_create(state, 2, ALL, NULL), SCREE_OK);
    for (size_t id = 0; id < ALL; id++)
        if (id % EVERY == 3) state->id[kept++] = (uint32_t)id;
    state->count = kept;
    for (size_t row = 0; row < kept / 2; row++) {
        const uint32_t id = state->id[row];
        state->id[row] = state->id[kept - 1 - row];
        state->id[kept - 1 - row] = id;
    }
}

static void bodies_are_found_by_id(void **unused)
{
    scree_state state;
    size_t next = 0, seen = 0;
    (void)unused;
    make_part(&state);
    assert_int_equal(scree_row_table_begin(&state, 0, NULL), SCREE_OK);
    assert_null(state.row_of_id);
    for (size_t id = 0; id < ALL + 10; id++) {
        const uint32_t row = scree_state_row_of(&state, id);
        if (id % EVERY != 3 || id >= ALL)
            assert_int_equal(row, SCREE_NO_ROW);
        else
            assert_int_equal(state.id[row], id);
    }
    uint32_t before = 0;
    for (uint32_t row; (row = scree_next_by_id(&state, &next)) != SCREE_NO_ROW; before = state.id[row], seen++)
        assert_true(seen == 0 || state.id[row] > before);
    assert_int_equal(seen, state.count);
    scree_state_destroy(&state);
}

static void ghosts_are_known_until_it_is_made_anew(void **unused)
{
    scree_state state;
    (void)unused;
    make_part(&state);
    assert_int_equal(scree_row_table_begin(&state, 1000, NULL), SCREE_OK);
    for (uint32_t k = 0; k < 1000; k++) scree_state_set_row(&state, EVERY * (k % 700), 100000 + k);
    for (uint32_t k = 300; k < 1000; k++)
        assert_int_equal(scree_state_row_of(&state, EVERY * (k % 700)), 100000 + k);
    assert_int_equal(scree_row_table_begin(&state, 0, NULL), SCREE_OK);
    for (size_t id = 0; id < ALL; id += EVERY) assert_int_equal(scree_state_row_of(&state, id), SCREE_NO_ROW);
    assert_int_equal(scree_state_row_of(&state, state.id[5]), 5);
    scree_state_destroy(&state);
}

static void the_array_comes_back(void **unused)
{
    scree_state state;
    (void)unused;
    make_part(&state);
    assert_int_equal(scree_row_table_begin(&state, 0, NULL), SCREE_OK);
    // The others have come from other processes.
    for (size_t id = 0; id < ALL; id++)
        if (id % EVERY != 3) state.id[state.count++] = (uint32_t)id;
    assert_int_equal(scree_row_table_leave(&state, NULL), SCREE_OK);
    assert_null(state.rows);
    for (size_t id = 0; id < ALL; id++) assert_int_equal(state.id[state.row_of_id[id]], id);
    scree_state_destroy(&state);
}

/// What is left of most bodies, and of their contacts, takes no more memory than they need.
static void arrays_become_short(void **unused)
{
    scree_state state;
    size_t before, after;
    (void)unused;
    make_part(&state);
    assert_int_equal(scree_state_reserve_contacts(&state, 3 * ALL, NULL), SCREE_OK);
    state.contact_count = 40;
    state.contact[39].first = 12345;
    scree_allocation_statistics(&before, NULL);
    assert_int_equal(scree_store_shrink(&state, NULL), SCREE_OK);
    scree_allocation_statistics(&after, NULL);
    const size_t room = state.count + state.count / 8 + 16;
    assert_int_equal(state.body_capacity, room);
    assert_int_equal(state.row_capacity, room);
    assert_true(state.contact_capacity < 64);
    assert_true(5 * after < before + 5 * ALL * sizeof *state.row_of_id);
    for (size_t row = 0; row < state.count; row++) assert_int_equal(state.id[row] % EVERY, 3);
    assert_int_equal(state.contact[39].first, 12345);
    assert_int_equal(scree_store_reserve_bodies(&state, ALL, false, NULL), SCREE_OK);
    assert_true(state.body_capacity > ALL && state.row_capacity > ALL);
    scree_state_destroy(&state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_are_found_by_id),
        cmocka_unit_test(ghosts_are_known_until_it_is_made_anew),
        cmocka_unit_test(the_array_comes_back),
        cmocka_unit_test(arrays_become_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
