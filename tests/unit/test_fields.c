/// The tables of fields: names, units, places, and that nothing of a state is missing from them.
#include "measure/delaunay_boundary.h"
#include "model/law.h"
#include "state/persistent.h"
#include "state/plates.h"
#include "testing.h"

#include "io/array.h"
#include "io_sample.h"

#include <stdio.h>
#include <udunits2.h>

static size_t all_count(void)
{
    return scree_field_total();
}
static const scree_field *all(size_t k)
{
    return scree_field_at(k);
}

static void every_name_is_unique_and_explained(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < all_count(); k++) {
        assert_true(strlen(all(k)->name) > 1);
        assert_true(strlen(all(k)->meaning) > 3);
        // Laws may remember the same thing: a state is of one of them.
        for (size_t j = 0; j < k; j++)
            if (all(k)->only_dimension + all(j)->only_dimension != 5 && (!all(k)->law || all(k)->law == all(j)->law))
                assert_string_not_equal(all(k)->name, all(j)->name);
    }
}

static void every_unit_is_known_to_udunits(void **unused)
{
    (void)unused;
    ut_set_error_message_handler(ut_ignore);
    ut_system *system = ut_read_xml(NULL);
    assert_non_null(system);
    for (size_t k = 0; k < all_count(); k++) {
        ut_unit *unit = ut_parse(system, all(k)->unit, UT_ASCII);
        if (!unit) fail_msg("'%s' has the unit '%s'", all(k)->name, all(k)->unit);
        ut_free(unit);
    }
    ut_free_system(system);
}

/// Fills each component of each field with a number of its own, in every row; none may overwrite another.
static void fill_and_read(scree_state *filled)
{
    for (int reading = 0; reading < 2; reading++) {
        unsigned char value = 0;
        for (size_t k = 0; k < all_count(); k++)
            for (size_t row = 0; row < scree_field_rows_count(filled, all(k)); row++) {
                if (!scree_field_exists(all(k), filled->dimension)) continue;
                size_t size = (size_t)scree_components(all(k)->components, filled->dimension);
                size *= scree_field_size(all(k)->type);
                unsigned char *bytes = scree_field_get_mutable(filled, all(k), row);
                for (size_t b = 0; b < size; b++, value = (unsigned char)(value * 5 + 1)) {
                    if (!reading) bytes[b] = value;
                    if (reading && bytes[b] != value) fail_msg("'%s' row %zu was overwritten", all(k)->name, row);
                }
            }
    }
}

static void fields_do_not_overlap(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_state state;
        if (dimension == 2) {
            assert_int_equal(sample_state(&state, 5, 1, NULL), SCREE_OK);
            assert_int_equal(sample_loop(&state, 4, NULL), SCREE_OK);
        } else {
            assert_int_equal(scree_state_create(&state, 3, 5, NULL), SCREE_OK);
        }
        assert_int_equal(sample_contacts(&state, 3, NULL), SCREE_OK);
        fill_and_read(&state);
        scree_state_destroy(&state);
    }
}

static void fields_lie_where_their_names_say(void **unused)
{
    (void)unused;
    scree_state state;
    assert_int_equal(sample_state(&state, 5, 1, NULL), SCREE_OK);
    assert_int_equal(sample_loop(&state, 4, NULL), SCREE_OK);
    assert_int_equal(sample_contacts(&state, 3, NULL), SCREE_OK);
    const struct {
        const char *name;
        const void *place;
    } expected[] = {
        {"id", &state.id[2]},
        {"position", &state.row[2].x},
        {"radius", &state.row[2].radius},
        {"mass", &state.row[2].mass},
        {"material", &state.row[2].material},
        {"scheme_velocity", &state.row[2].vx},
        {"scheme_spin", &state.row[2].spin},
        {"angle", &state.angle[2]},
        {"reference", state.reference[2]},
        {"force_sum", &state.sum[2].fx},
        {"torque_sum", &state.sum[2].torque},
        {"coordination", &state.sum[2].contacts},
        {"rebuild", state.rebuild[2]},
        {"contacts/second", &state.contact[2].second},
        {"contacts/tangential_displacement", state.contact[2].history.value},
        {"contacts/tangential_damping_force", state.contact[2].history.value + 3},
        {"boundary/force_y", &scree_loop_of(&state)->fy[2]},
        {"boundary/loaded", &scree_loop_of(&state)->loaded[2]},
        {"walls/normal", scree_plates(&state)[2].normal},
        {"walls/active", &scree_plates(&state)[2].active},
    };
    for (size_t e = 0; e < sizeof expected / sizeof *expected; e++) {
        const void *found = NULL;
        for (size_t k = 0; k < all_count(); k++)
            if (strcmp(all(k)->name, expected[e].name) == 0 && scree_field_is_here(&state, all(k)))
                found = scree_field_get(&state, all(k), 2);
        if (found != expected[e].place) fail_msg("'%s' lies elsewhere", expected[e].name);
    }
    scree_state_destroy(&state);
}

#define EXCEPT(member) memset(covered + offsetof(scree_state, member), 1, sizeof(((scree_state *)0)->member))

/// Marks the bytes of a struct that the fields of `owner` speak of, with the array pointers and counts of groups.
static void mark_fields(const scree_module *owner, unsigned char *covered)
{
    for (size_t k = 0; k < all_count(); k++) {
        const scree_field *field = all(k);
        size_t size = (size_t)scree_components(field->components, 3) * scree_field_size(field->type);
        if (field->owner != owner) continue;
        if (field->group) memset(covered + field->group->count_offset, 1, sizeof(size_t));
        if (field->group) memset(covered + field->group->capacity_offset, 1, sizeof(size_t));
        if (scree_field_is_array(field)) memset(covered + field->array_offset, 1, sizeof(void *));
        if (field->rows == SCREE_ROWS_ONE) memset(covered + field->array_offset, 1, size);
        for (size_t w = 0; w < field->fixed; w++)
            memset(covered + field->array_offset + w * field->stride + field->offset, 1, size);
    }
}

/// A new member that is in no table and not in this list is found here.
static void no_member_of_the_state_is_missing(void **unused)
{
    (void)unused;
    static unsigned char covered[sizeof(scree_state)];
    memset(covered, 1, offsetof(scree_state, count)); // the dimension is of the case, `part` of comm/parts.c
    EXCEPT(count);                                    // lengths and the inverse of `id` follow from the arrays
    EXCEPT(row_of_id);
    EXCEPT(rows);
    EXCEPT(contact_count);
    EXCEPT(contact_capacity);
    EXCEPT(marked); // counts of `mark`
    EXCEPT(changes);
    EXCEPT(total); // of a part, told by comm/parts.c
    EXCEPT(body_capacity);
    EXCEPT(row_capacity);
    EXCEPT(id_count);
    EXCEPT(id_capacity);
    EXCEPT(law); // of the model
    EXCEPT(pair_law);
    memset(covered + offsetof(scree_state, pair_laws), 1,
           offsetof(scree_state, own) - offsetof(scree_state, pair_laws));
    EXCEPT(spent); // kept by checkpoints, but no part of what is computed
    EXCEPT(own);   // of the modules
    mark_fields(NULL, covered);
    for (size_t b = 0; b < sizeof covered; b++)
        if (!covered[b]) fail_msg("byte %zu of scree_state is in no table", b);
}

static void no_member_of_a_module_is_missing(void **unused)
{
    (void)unused;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        static unsigned char covered[1 << 16];
        assert_true(scree_modules[m]->state_size <= sizeof covered);
        memset(covered, 0, sizeof covered);
        mark_fields(scree_modules[m], covered);
        for (size_t b = 0; b < scree_modules[m]->state_size; b++)
            if (!covered[b]) fail_msg("byte %zu of the state of module %s is in no field", b, scree_modules[m]->name);
    }
}

/// The same inside the arrays of structures: every byte of an element belongs to exactly one field.
static void no_member_of_an_element_is_missing(void **unused)
{
    (void)unused;
    const struct {
        size_t offset, size;
        int dimension; ///< 0: both
        size_t unused; ///< bytes that only fill up
    } arrays[] = {{offsetof(scree_state, row), sizeof(scree_row), 0, 0},
                  {offsetof(scree_state, sum), sizeof(scree_sum_row), 0, 0},
                  {offsetof(scree_state, turn), sizeof(scree_turn_row), 3, 0},
                  {offsetof(scree_state, torque), sizeof(scree_torque_row), 3, 8},
                  {offsetof(scree_state, contact), sizeof(scree_contact_memory), 0, sizeof(scree_history)}};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            if (arrays[a].dimension && arrays[a].dimension != dimension) continue;
            size_t bytes = arrays[a].unused;
            for (size_t k = 0; k < all_count(); k++) {
                if (all(k)->owner || all(k)->array_offset != arrays[a].offset || !scree_field_is_array(all(k)) ||
                    all(k)->law)
                    continue;
                if (!scree_field_exists(all(k), dimension)) continue;
                bytes += (size_t)scree_components(all(k)->components, dimension) * scree_field_size(all(k)->type);
                assert_int_equal(all(k)->stride, arrays[a].size);
            }
            assert_int_equal(bytes, arrays[a].size);
        }
}

/// Where the values of a row lie in a list of contacts.
typedef struct memory_row {
    size_t array, first, size;
} memory_row;

enum { HISTORY, LAST_FORCE, ROLLING, LAST_ROLLING, CONSTANT, MEMORY_ROWS };

#define HELD(member_, type)                                                                                            \
    {                                                                                                                  \
        offsetof(scree_persistent_list, member), offsetof(scree_persistent_member, member_), sizeof(type)              \
    }
static const memory_row memory_rows_of[SCREE_LISTS][MEMORY_ROWS] = {
    {{offsetof(scree_state, contact), offsetof(scree_contact_memory, history), sizeof(double)},
     {offsetof(scree_state, last_force), 0, sizeof(float)},
     {offsetof(scree_state, rolling), offsetof(scree_rolling, value), sizeof(double)},
     {offsetof(scree_state, rolling), offsetof(scree_rolling, last), sizeof(float)},
     {SIZE_MAX, 0, 1}},
    {HELD(history.value, double), HELD(last_force.value, float), HELD(rolling.value, double), HELD(rolling.last, float),
     HELD(constant, double)},
};

/// Number of values of a row that the fields of a law speak of; no two of the same one.
static int number_used(const scree_state *state, scree_list list, int which)
{
    const memory_row *row = &memory_rows_of[list][which];
    const scree_module *law = state->law[list].law;
    int used[4] = {0};
    for (size_t k = 0; k < law->field_count; k++) {
        const scree_field *field = &law->fields[k];
        if (!scree_field_is_here(state, field) || scree_field_list(field) != list) continue;
        if (field->array_offset != row->array) continue;
        if (field->offset < row->first || field->offset >= row->first + 4 * row->size) continue;
        assert_int_equal(scree_field_size(field->type), row->size);
        size_t at = (field->offset - row->first) / row->size;
        assert_int_equal((field->offset - row->first) % row->size, 0);
        for (int c = scree_components(field->components, state->dimension); c-- > 0;) {
            assert_true(at + (size_t)c < 4);
            if (used[at + (size_t)c]++) fail_msg("'%s' lies on another value", field->name);
        }
    }
    return used[0] + used[1] + used[2] + used[3];
}

/// What a law declares lies in the rows that its traits ask for, each of them has something in it, and no two fields
/// are the same value.
static void memory_is_what_the_traits_say(void **unused)
{
    (void)unused;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (unsigned option = 0; scree_modules[m]->law && option < scree_modules[m]->law->option_count; option++)
            for (int dimension = 2; dimension <= 3; dimension++) {
                const scree_law_traits *traits = &scree_modules[m]->law->traits[option];
                if (traits->areas && dimension == 3) continue; // of polygons, in the plane
                const scree_list list = traits->holds ? SCREE_LIST_PERSISTENT : SCREE_LIST_CONTACTS;
                scree_state state = {.dimension = dimension};
                state.law[list] = (scree_remembered_law){scree_modules[m], option};
                assert_true(number_used(&state, list, HISTORY) > 0);
                assert_true((number_used(&state, list, LAST_FORCE) > 0) == traits->keeps_last_force[dimension - 2]);
                assert_true((number_used(&state, list, ROLLING) > 0) == traits->rolling);
                assert_true((number_used(&state, list, CONSTANT) > 0) == traits->holds);
                // Dashpots of all that rolls, or of nothing: constant torques have none.
                const int last = number_used(&state, list, LAST_ROLLING);
                assert_true(last == 0 || last == number_used(&state, list, ROLLING));
            }
}

static void packing_and_unpacking_agree(void **unused)
{
    (void)unused;
    scree_state state, copy;
    assert_int_equal(sample_state(&state, 7, 1, NULL), SCREE_OK);
    assert_int_equal(scree_state_create(&copy, 2, 7, NULL), SCREE_OK);
    for (size_t k = 0; k < scree_field_total(); k++) {
        scree_array array;
        if (scree_field_at(k)->rows != SCREE_ROWS_BODIES || !scree_field_exists(scree_field_at(k), 2)) continue;
        assert_int_equal(scree_array_from_field(&state, scree_field_at(k), false, &array, NULL), SCREE_OK);
        scree_array_to_field(&array, scree_field_at(k), &copy);
        scree_array_destroy(&array);
    }
    assert_memory_equal(state.row, copy.row, 7 * sizeof *state.row);
    assert_memory_equal(state.sum, copy.sum, 7 * sizeof *state.sum);
    assert_memory_equal(state.id, copy.id, 7 * sizeof *state.id);
    scree_array array;
    assert_int_equal(scree_array_from_field(&state, scree_field_at(0), true, &array, NULL), SCREE_OK);
    const uint32_t *id = array.data;
    for (uint32_t k = 0; k < 7; k++) assert_int_equal(id[k], k);
    scree_array_destroy(&array);
    scree_state_destroy(&state);
    scree_state_destroy(&copy);
}

/// What sorts the rows has room for the widest element, whichever that is, and moves each of them whole: under the
/// address sanitizer the last byte of the last one too.
static void permuting_moves_whole_elements(void **unused)
{
    (void)unused;
    enum { BODIES = 7 };
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_state state, before;
        assert_int_equal(scree_state_create(&state, dimension, BODIES, NULL), SCREE_OK);
        assert_int_equal(scree_state_create(&before, dimension, BODIES, NULL), SCREE_OK);
        assert_int_equal(scree_state_predict(&state, NULL), SCREE_OK);
        assert_int_equal(scree_state_predict(&before, NULL), SCREE_OK);
        uint32_t order[BODIES];
        for (size_t k = 0; k < scree_field_total(); k++) {
            const scree_field *field = scree_field_at(k);
            if (field->rows != SCREE_ROWS_BODIES || scree_field_rows_count(&state, field) == 0) continue;
            if (!scree_field_exists(field, dimension)) continue;
            assert_true(field->stride <= scree_state_widest(&state));
            for (size_t row = 0; row < BODIES && strcmp(field->name, "id") != 0; row++)
                for (size_t b = 0; b < field->stride - field->offset; b++) {
                    unsigned char value = (unsigned char)(31 * k + 7 * row + b);
                    ((unsigned char *)scree_field_get_mutable(&state, field, row))[b] = value;
                    ((unsigned char *)scree_field_get_mutable(&before, field, row))[b] = value;
                }
        }
        for (uint32_t k = 0; k < BODIES; k++) order[k] = (3 * k + 2) % BODIES;
        assert_int_equal(scree_state_permute(&state, order, NULL), SCREE_OK);
        for (size_t k = 0; k < scree_field_total(); k++) {
            const scree_field *field = scree_field_at(k);
            if (field->rows != SCREE_ROWS_BODIES || scree_field_rows_count(&state, field) == 0) continue;
            if (!scree_field_exists(field, dimension)) continue;
            for (size_t row = 0; row < BODIES; row++)
                assert_memory_equal(scree_field_get(&state, field, row), scree_field_get(&before, field, order[row]),
                                    field->stride - field->offset);
        }
        scree_state_destroy(&state);
        scree_state_destroy(&before);
    }
}

/// The row of a dataset in docs/output.md.
static void format_row(const scree_array *array, const char *group, const char *rows, char *line, size_t size)
{
    static const char *const types[] = {"float64", "int64", "uint64", "float32", "int32", "uint32", "uint8"};
    char shape[32];
    if (array->single && array->components == 1)
        (void)snprintf(shape, sizeof shape, "one");
    else if (array->single)
        (void)snprintf(shape, sizeof shape, "%d", array->components);
    else if (array->components == 1)
        (void)snprintf(shape, sizeof shape, "%s", rows);
    else
        (void)snprintf(shape, sizeof shape, "%s x %d", rows, array->components);
    (void)snprintf(line, size, "\n| `%s%s` | %s | %s | %s | %s |\n", group, array->name, shape, types[array->type],
                   array->unit, array->meaning);
}

static int undocumented;

static void assert_documented(const char *manual, const scree_array *array, const char *group, const char *rows)
{
    char line[400];
    format_row(array, group, rows, line, sizeof line);
    if (strstr(manual, line)) return;
    print_error("docs/output.md lacks this row:%s", line);
    undocumented++;
}

/// The number of rows of a field, as docs/output.md writes it.
static const char *rows_symbol(const scree_field *field)
{
    static char number[16];
    (void)snprintf(number, sizeof number, "%zu", field->fixed);
    if (field->group) return field->group->symbol;
    return field->rows == SCREE_ROWS_FIXED ? number : field->rows == SCREE_ROWS_BODIES ? "n" : "c";
}

static void the_manual_lists_every_dataset(void **unused)
{
    (void)unused;
    static char manual[1 << 16];
    FILE *file = fopen(SCREE_SOURCE_DIR "/docs/output.md", "r");
    assert_non_null(file);
    assert_true(fread(manual, 1, sizeof manual - 1, file) > 1000);
    (void)fclose(file);
    scree_state state;
    scree_array array;
    scree_contact_table table = {0};
    const scree_config config = {0};
    const scree_model model = sample_model(&config);
    assert_int_equal(sample_state(&state, 1, 1, NULL), SCREE_OK);
    for (size_t k = 0; k < scree_body_array_count(&state); k++) {
        assert_int_equal(scree_body_array(&model, &state, k, &array, NULL), SCREE_OK);
        assert_documented(manual, &array, "", "n");
        scree_array_destroy(&array);
    }
    for (size_t k = 0; k < scree_contact_array_count(); k++) {
        assert_int_equal(scree_contact_array(&state, &table, k, &array, NULL), SCREE_OK);
        assert_documented(manual, &array, "contacts/", "c");
        scree_array_destroy(&array);
    }
    // Shapes in two dimensions, where a field exists in both.
    for (size_t k = 0; k < all_count(); k++) {
        state.dimension = scree_field_exists(all(k), 2) ? 2 : 3;
        array = scree_array_of_field(&state, all(k));
        if (all(k)->role == SCREE_FIELD_STATE) assert_documented(manual, &array, "", rows_symbol(all(k)));
    }
    state.dimension = 2;
    scree_state_destroy(&state);
    assert_int_equal(undocumented, 0);
}

/// What all modules could want together fits into the room that a model has for their numbers: nothing else looks.
static void numbers_of_all_modules_fit(void **unused)
{
    (void)unused;
    const scree_model model = {0};
    size_t all = 0;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) all += (scree_modules[m]->numbers_size + 15) / 16 * 16;
    print_message("%zu of %zu bytes\n", all, sizeof model.numbers);
    assert_true(all > 0 && all <= sizeof model.numbers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_name_is_unique_and_explained),
        cmocka_unit_test(every_unit_is_known_to_udunits),
        cmocka_unit_test(fields_do_not_overlap),
        cmocka_unit_test(fields_lie_where_their_names_say),
        cmocka_unit_test(no_member_of_the_state_is_missing),
        cmocka_unit_test(no_member_of_a_module_is_missing),
        cmocka_unit_test(no_member_of_an_element_is_missing),
        cmocka_unit_test(memory_is_what_the_traits_say),
        cmocka_unit_test(packing_and_unpacking_agree),
        cmocka_unit_test(permuting_moves_whole_elements),
        cmocka_unit_test(the_manual_lists_every_dataset),
        cmocka_unit_test(numbers_of_all_modules_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
