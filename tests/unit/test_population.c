/// Bodies that come and go: ids are never given again and find their rows, every declared field follows its body, marks
/// are counted, and a body costs a constant number of allocations. The table of modules is one of this test, in which a
/// module declares fields of bodies of its own.
#include "test_module.h"
#include "testing.h"

#include "base/random.h"
#include "integrate/forced_spin.h"
#include "state/fields.h"
#include "state/store.h"

#include <string.h>

/// The struct of the module of this test, in the slot of the forced spin.
typedef struct own {
    scree_forced_spin forced;
    double *wear;
    uint8_t (*colour)[3];
    float *heat;
    double *flat; ///< 2D only
    size_t forgotten;
} own;

static const scree_field test_fields[] = {
    BODY_FIELD(wear, double, "wear", SCREE_FIELD_DOUBLE, 1, .ghosts = SCREE_GHOSTS_FOLLOW),
    BODY_FIELD(colour, uint8_t[3], "colour", SCREE_FIELD_UINT8, 2, .offset = 0),
    BODY_FIELD(colour, uint8_t[3], "shade", SCREE_FIELD_UINT8, 1, .offset = 2),
    BODY_FIELD(heat, float, "heat", SCREE_FIELD_FLOAT, 1, .optional = true),
    BODY_FIELD(flat, double, "flat", SCREE_FIELD_DOUBLE, 1, .only_dimension = 2),
};

static own *own_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_forced_spin];
}

static const char *keeps(const scree_state *state, uint32_t id)
{
    (void)state;
    return id == 3 ? "the test keeps it" : NULL;
}

static void forget(scree_state *state, uint32_t id)
{
    assert_true(scree_state_row_of(state, id) != SCREE_NO_ROW); // its row is still there
    own_of(state)->forgotten++;
}

static const scree_module test_module = {
    .name = "test",
    .meaning = "fields of bodies",
    .state_size = sizeof(own),
    .fields = test_fields,
    .field_count = sizeof test_fields / sizeof *test_fields,
    .keeps = keeps,
    .forget = forget,
};

TEST_MODULES

// ---- what each body should have ----------------------------------------------------------------------------------

enum { MOST = 4000 };

static struct {
    bool here[MOST]; ///< by id
    scree_mark mark[MOST];
    size_t given, count;
} expected;

/// Byte b of a field of a body.
static unsigned char value_of(size_t id, size_t field, size_t b)
{
    return (unsigned char)(id * 131 + field * 17 + b * 7 + 1);
}

/// Whether the values of this test are written into a field.
static bool is_filled(const scree_state *state, const scree_field *field)
{
    return field->rows == SCREE_ROWS_BODIES && scree_field_exists(field, state->dimension) &&
           scree_field_rows_count(state, field) > 0 && strcmp(field->name, "id") != 0 &&
           strcmp(field->name, "mark") != 0;
}

static size_t size_of(const scree_state *state, const scree_field *field)
{
    return (size_t)scree_components(field->components, state->dimension) * scree_field_size(field->type);
}

static void fill(scree_state *state, size_t row)
{
    for (size_t f = 0; f < scree_field_total(); f++) {
        const scree_field *field = scree_field_at(f);
        if (!is_filled(state, field)) continue;
        unsigned char *bytes = scree_field_get_mutable(state, field, row);
        for (size_t b = 0; b < size_of(state, field); b++) bytes[b] = value_of(state->id[row], f, b);
    }
}

static void assert_follows(const scree_state *state, size_t row)
{
    for (size_t f = 0; f < scree_field_total(); f++) {
        const scree_field *field = scree_field_at(f);
        if (!is_filled(state, field)) continue;
        const unsigned char *bytes = scree_field_get(state, field, row);
        for (size_t b = 0; b < size_of(state, field); b++)
            if (bytes[b] != value_of(state->id[row], f, b))
                fail_msg("'%s' of body %u is that of another", field->name, state->id[row]);
    }
}

static void assert_invariants(const scree_state *state)
{
    size_t marked[SCREE_MARKS] = {0}, seen = 0, id = 0, last = 0;
    assert_int_equal(state->count, expected.count);
    assert_int_equal(state->next_id, expected.given);
    for (size_t k = 0; k < expected.given; k++) {
        uint32_t row = scree_state_row_of(state, k);
        assert_int_equal(row != SCREE_NO_ROW, expected.here[k]);
        if (!expected.here[k]) continue;
        assert_true(row < state->count);
        assert_int_equal(state->id[row], k);
        assert_int_equal(state->mark[row], expected.mark[k]);
        assert_follows(state, row);
        marked[expected.mark[k]]++;
    }
    assert_int_equal(scree_state_row_of(state, expected.given), SCREE_NO_ROW);
    for (int m = 0; m < SCREE_MARKS; m++) assert_int_equal(state->marked[m], marked[m]);
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW; seen++) {
        assert_true(seen == 0 || state->id[row] > last);
        last = state->id[row];
    }
    assert_int_equal(seen, state->count);
}

static uint64_t draws;
static size_t draw(size_t limit)
{
    return (size_t)(scree_random_uniform(5, SCREE_RANDOM_TEST, draws++) * (double)limit);
}

static void append(scree_state *state, size_t more)
{
    scree_mark mark = draw(4) == 0 ? SCREE_MARK_MEMBRANE : SCREE_MARK_GRAIN;
    // Images of a periodic cell lie behind the bodies and leave something there.
    for (size_t row = state->count; row < state->row_capacity; row++) state->row[row].x = state->row[row].mass = 77;
    size_t first = state->count;
    assert_int_equal(scree_state_append(state, mark, more, NULL), SCREE_OK);
    for (size_t k = 0; k < more; k++) {
        assert_true(state->row[first + k].x == 0 && state->row[first + k].mass == 0);
        assert_int_equal(state->id[first + k], expected.given);
        fill(state, first + k);
        expected.here[expected.given] = true;
        expected.mark[expected.given++] = mark;
        expected.count++;
    }
}

static void remove_some(scree_state *state, size_t count)
{
    uint32_t ids[16];
    size_t named = 0, forgotten = own_of(state)->forgotten;
    for (size_t k = 0; k < count && state->count > 8; k++) {
        uint32_t id = state->id[draw(state->count)];
        bool again = id == 3;
        for (size_t j = 0; j < named; j++) again = again || ids[j] == id;
        if (!again) ids[named++] = id;
    }
    assert_int_equal(scree_state_remove(state, ids, named, NULL), SCREE_OK);
    for (size_t k = 0; k < named; k++) expected.here[ids[k]] = false;
    expected.count -= named;
    assert_int_equal(own_of(state)->forgotten, forgotten + named);
}

static void permute(scree_state *state)
{
    uint32_t order[MOST];
    for (uint32_t k = 0; k < state->count; k++) order[k] = k;
    for (size_t k = state->count; k > 1; k--) {
        size_t j = draw(k);
        uint32_t kept = order[k - 1];
        order[k - 1] = order[j];
        order[j] = kept;
    }
    assert_int_equal(scree_state_permute(state, order, NULL), SCREE_OK);
}

static void create(scree_state *state, int dimension, size_t count)
{
    memset(&expected, 0, sizeof expected);
    assert_int_equal(scree_state_create(state, dimension, count, NULL), SCREE_OK);
    expected.given = expected.count = count;
    for (size_t row = 0; row < count; row++) {
        expected.here[row] = true;
        fill(state, row);
    }
}

static void everything_follows_its_body(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_state state;
        create(&state, dimension, 20);
        assert_null(own_of(&state)->heat);
        for (int move = 0; move < 600; move++) {
            if (move == 200) { // the optional ones come later
                assert_int_equal(scree_state_begin_field(&state, &test_fields[3], NULL), SCREE_OK);
                assert_int_equal(scree_state_predict(&state, NULL), SCREE_OK);
                for (size_t row = 0; row < state.count; row++) fill(&state, row);
            }
            size_t what = draw(4);
            if (what == 0) append(&state, 1 + draw(9));
            if (what == 1) remove_some(&state, 1 + draw(9));
            if (what == 2) permute(&state);
            if (what == 3) assert_int_equal(scree_state_reserve_rows(&state, state.count + draw(40), NULL), SCREE_OK);
            assert_invariants(&state);
        }
        assert_true(expected.given > 500 && expected.count < expected.given);
        assert_int_equal(own_of(&state)->flat == NULL, dimension == 3);
        scree_state_destroy(&state);
    }
}

/// The contact memory forgets bodies that go; the others keep their order.
static void contacts_go_with_their_bodies(void **unused)
{
    (void)unused;
    scree_state state;
    create(&state, 3, 6);
    assert_int_equal(scree_state_reserve_contacts(&state, 5, NULL), SCREE_OK);
    assert_int_equal(scree_state_add_last_force(&state, NULL), SCREE_OK);
    assert_int_equal(scree_state_add_rolling(&state, NULL), SCREE_OK);
    static const uint32_t pair[5][2] = {{0, 1}, {0, SCREE_WALL_ID}, {1, 2}, {2, 5}, {4, SCREE_PRIMITIVE_ID + 1}};
    for (size_t k = 0; k < 5; k++) {
        state.contact[k] = (scree_contact_memory){pair[k][0], pair[k][1], {{(double)k, 0, 0, 0}}};
        state.last_force[k].value[0] = (float)k;
        state.rolling[k].value[3] = (double)k;
    }
    state.contact_count = 5;
    assert_int_equal(scree_state_remove(&state, (const uint32_t[]){5, 0}, 2, NULL), SCREE_OK);
    static const size_t kept[] = {2, 4};
    assert_int_equal(state.contact_count, 2);
    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(state.contact[k].first, pair[kept[k]][0]);
        assert_int_equal(state.contact[k].second, pair[kept[k]][1]);
        assert_true(state.contact[k].history.value[0] == (double)kept[k]);
        assert_true(state.last_force[k].value[0] == (float)kept[k]);
        assert_true(state.rolling[k].value[3] == (double)kept[k]);
    }
    scree_state_destroy(&state);
}

/// What cannot be taken out is said, and nothing has changed.
static void refusals_change_nothing(void **unused)
{
    (void)unused;
    static const struct {
        uint32_t ids[3];
        const char *words;
    } bad[] = {{{0, 99, 1}, "body 99 cannot be taken out: there is none with this id"},
               {{0, 1, 0}, "body 0 cannot be taken out: it is named twice"},
               {{5, 3, 0}, "body 3 cannot be taken out: the test keeps it"},
               {{4, 2, 0}, "body 2 cannot be taken out: there is none with this id"}};
    scree_state state;
    create(&state, 2, 6);
    assert_int_equal(scree_state_remove(&state, (const uint32_t[]){2}, 1, NULL), SCREE_OK);
    expected.here[2] = false;
    expected.count--;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        scree_error error = {0};
        assert_int_equal(scree_state_remove(&state, bad[k].ids, 3, &error), SCREE_ERROR_INPUT);
        assert_string_equal(error.message, bad[k].words);
        assert_invariants(&state);
    }
    state.next_id = SCREE_PRIMITIVE_ID - 2;
    assert_int_equal(scree_state_append(&state, SCREE_MARK_GRAIN, 2, NULL), SCREE_ERROR_INPUT);
    scree_state_destroy(&state);
}

/// Bodies that come one by one: allocations as the logarithm of their number. Those that go cost none. And a state is
/// as large as its bodies as long as none came.
static void a_body_costs_a_constant(void **unused)
{
    (void)unused;
    scree_state state;
    scree_body_array list[SCREE_BODY_ARRAYS];
    create(&state, 3, 100);
    assert_int_equal(state.row_capacity, 101);
    assert_int_equal(state.body_capacity, 101);
    size_t arrays = scree_body_arrays(&state, list) + 1; // and the rows by id
    (void)scree_allocation_fail_after(0);
    for (size_t k = 0; k < 3000; k++) assert_int_equal(scree_state_append(&state, SCREE_MARK_GRAIN, 1, NULL), SCREE_OK);
    // By an eighth and 16 each: 101 grows to 3101 in 24 steps.
    uint64_t made = scree_allocation_fail_after(0);
    assert_true(made > 0 && made <= 24 * arrays);
    for (uint32_t id = 4; id < 3000; id++) assert_int_equal(scree_state_remove(&state, &id, 1, NULL), SCREE_OK);
    assert_int_equal(scree_allocation_fail_after(0), 0);
    // What went makes room for what comes.
    for (size_t k = 0; k < 100; k++) assert_int_equal(scree_state_append(&state, SCREE_MARK_GRAIN, 20, NULL), SCREE_OK);
    assert_true(scree_allocation_fail_after(0) <= 7);
    scree_state_destroy(&state);
}

/// A failed allocation leaves the state as it was, and the call can be repeated.
static void failed_appends_change_nothing(void **unused)
{
    (void)unused;
    scree_state state;
    create(&state, 2, 30);
    assert_int_equal(scree_state_begin_field(&state, &test_fields[3], NULL), SCREE_OK);
    for (size_t row = 0; row < 30; row++) fill(&state, row);
    for (uint64_t n = 1;; n++) {
        (void)scree_allocation_fail_after(n);
        scree_status status = scree_state_append(&state, SCREE_MARK_GRAIN, 50, NULL);
        (void)scree_allocation_fail_after(0);
        if (!status) break;
        assert_invariants(&state);
    }
    assert_int_equal(state.count, 80);
    scree_state_destroy(&state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_follows_its_body),   cmocka_unit_test(contacts_go_with_their_bodies),
        cmocka_unit_test(refusals_change_nothing),       cmocka_unit_test(a_body_costs_a_constant),
        cmocka_unit_test(failed_appends_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
