/// The schema table is sound, the written case reads back bit for bit, and the reference in docs/ is up to date.
#include "base/schedule.h"
#include "base/units.h"
#include "case/case.h"
#include "case/check.h"
#include "good_case.h"
#include "size/limits.h"

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check_limit(const scree_key *key, const scree_limit *limit)
{
    double value;
    if (limit->text && scree_units_parse(limit->text, key->unit ? key->unit : "1", &value, NULL))
        fail_msg("%s: limit '%s'", key->name, limit->text);
}

/// A default must be stored without a problem, in a struct that is larger than any.
static void check_default(const scree_key *key)
{
    static union {
        double align;
        char bytes[4096];
    } base, block;
    scree_arena arena = {0};
    scree_reader reader = {.arena = &arena};
    assert_int_equal(scree_problems_create(&reader.problems), SCREE_OK);
    if (key->own) memcpy(base.bytes + key->own_offset, &(char *){block.bytes}, sizeof(char *));
    scree_value_store(&reader, key, NULL, key->name, &base);
    if (scree_problems_count(reader.problems) > 0)
        fail_msg("%s: default '%s': %s", key->name, key->standard, scree_problems_get(reader.problems, 0)->message);
    scree_problems_free(reader.problems);
    scree_arena_release(&arena);
}

/// `when` must name a key that exists, and values that this key can have.
static void check_when(const scree_section *section, const scree_key *key)
{
    // Keys of species are used where there are some.
    scree_node one_species = {.kind = SCREE_NODE_MAPPING};
    scree_node species = {.kind = SCREE_NODE_LIST, .key = "species", .first = &one_species, .count = 1};
    scree_node particles = {.kind = SCREE_NODE_MAPPING, .key = "particles", .first = &species, .count = 1};
    scree_node root = {.kind = SCREE_NODE_MAPPING, .first = &particles, .count = 1};
    for (const char *when = key->when; when; when = scree_next_condition(when)) {
        char *condition = strndup(when, strcspn(when, "&"));
        scree_key one = *key;
        one.when = condition;
        scree_usage usage = scree_key_usage(&root, section, NULL, &one);
        // Of a key that depends on one that is not used itself, the usage is that of the latter.
        const scree_key *own = scree_section_find(section, condition, strcspn(condition, "="));
        if (own) usage.chooser = own;
        assert_non_null(usage.chooser);
        char *rest = strchr(condition, '=') + 1;
        for (char *value; (value = strtok_r(rest, "|", &rest));) {
            bool choice = usage.chooser->choices && scree_choice_find(usage.chooser->choices, value);
            bool standard = usage.chooser->standard && strcmp(usage.chooser->standard, value) == 0;
            if (!choice && !standard) fail_msg("%s: only with '%s'", key->name, key->when);
        }
        free(condition);
    }
}

static void check_key(const scree_section *section, const scree_key *key)
{
    size_t length = strlen(key->meaning);
    assert_true(length > 8 && key->meaning[length - 1] == '.');
    assert_ptr_equal(scree_section_find(section, key->name, strlen(key->name)), key); // names are unique
    check_limit(key, &key->least);
    check_limit(key, &key->most);
    if (key->when) check_when(section, key);
    bool number = key->type == SCREE_KEY_NUMBER || key->type == SCREE_KEY_VECTOR || key->type == SCREE_KEY_PAIRS ||
                  key->type == SCREE_KEY_TENSOR || key->type == SCREE_KEY_SCHEDULE;
    assert_int_equal(key->unit != NULL, number);
    if (number) {
        double one;
        assert_int_equal(scree_units_parse(scree_units_example(key->unit)[0] == '0' && strcmp(key->unit, "1") == 0
                                               ? "0.3"
                                               : scree_units_example(key->unit),
                                           key->unit, &one, NULL),
                         SCREE_OK);
        assert_string_not_equal(scree_units_quantity(key->unit), "a value");
    }
    if (number || key->type == SCREE_KEY_INTEGER) assert_true(key->least.text && key->most.text);
    if (key->type == SCREE_KEY_VECTOR && key->standard) assert_string_equal(key->standard, "[0, 0]");
    if (key->type == SCREE_KEY_PAIRS && key->standard) assert_string_equal(key->standard, "[]");
    if (key->type == SCREE_KEY_TENSOR) assert_string_equal(key->standard, "{}");
    for (const scree_choice *choice = key->choices; choice && choice->name; choice++)
        if (strlen(choice->meaning) < 9) fail_msg("%s: %s says little: '%s'", key->name, choice->name, choice->meaning);
    bool value = key->type < SCREE_KEY_VECTOR;
    if (value && key->standard) check_default(key);
}

static size_t check_section(const scree_section *section)
{
    size_t keys = 0;
    assert_true(section->meaning[strlen(section->meaning) - 1] == '.');
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        check_key(section, key);
        keys++;
        for (size_t k = 0; k < key->section_count; k++) keys += check_section(&key->sections[k]);
    }
    return keys;
}

static void every_key_is_documented_and_its_default_valid(void **state)
{
    (void)state;
    assert_true(check_section(scree_schema()) > 60);
    assert_true(scree_schema_is_whole());
}

/// Same bits of every member that the schema knows.
static void compare_section(const scree_section *section, const char *a, const char *b);

/// The section of an element that has been read.
static const scree_section *section_of(const scree_key *list, const char *element)
{
    const scree_key *kind = &list->sections[0].keys[0];
    int value;
    if (list->section_count == 1) return list->sections;
    memcpy(&value, scree_key_member(kind, element), sizeof value);
    for (const scree_choice *choice = kind->choices; choice->name; choice++)
        for (size_t i = 0; choice->value == value && i < list->section_count; i++)
            if (strcmp(list->sections[i].name, choice->name) == 0) return &list->sections[i];
    fail_msg("%s: %d is no kind of element", list->name, value);
    return NULL;
}

static void compare_list(const scree_key *key, const char *a, const char *b)
{
    int64_t count_a, count_b;
    const char *list_a, *list_b;
    memcpy(&count_a, scree_key_block(key, a) + key->count_offset, sizeof count_a);
    memcpy(&count_b, scree_key_block(key, b) + key->count_offset, sizeof count_b);
    memcpy(&list_a, scree_key_member(key, a), sizeof list_a);
    memcpy(&list_b, scree_key_member(key, b), sizeof list_b);
    assert_int_equal(count_a, count_b);
    for (size_t i = 0; i < (size_t)count_a; i++) {
        const char *x = list_a + i * key->element_size, *y = list_b + i * key->element_size;
        if (key->type == SCREE_KEY_PAIRS) assert_memory_equal(x, y, key->element_size);
        const scree_section *section = key->section_count > 0 ? section_of(key, x) : NULL;
        if (section) assert_ptr_equal(section, section_of(key, y));
        if (section) compare_section(section, x, y);
    }
}

static void compare_section(const scree_section *section, const char *a, const char *b)
{
    static const size_t sizes[] = {
        [SCREE_KEY_NUMBER] = sizeof(double),     [SCREE_KEY_INTEGER] = sizeof(int64_t),
        [SCREE_KEY_FLAG] = sizeof(bool),         [SCREE_KEY_CHOICE] = sizeof(int),
        [SCREE_KEY_VECTOR] = 3 * sizeof(double), [SCREE_KEY_TENSOR] = 9 * sizeof(double),
    };
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        const char *x = scree_key_member(key, a), *y = scree_key_member(key, b);
        if (key->type == SCREE_KEY_TEXT || key->type == SCREE_KEY_WORD) {
            char *text_a, *text_b;
            memcpy(&text_a, x, sizeof text_a);
            memcpy(&text_b, y, sizeof text_b);
            if (!text_a != !text_b || (text_a && strcmp(text_a, text_b) != 0)) fail_msg("%s differs", key->name);
        } else if (key->type == SCREE_KEY_SECTION) {
            compare_section(key->sections, x, y);
        } else if (key->type == SCREE_KEY_SCHEDULE) {
            for (size_t k = 0; k < (key->components > 0 ? key->components : 1); k++)
                if (!scree_schedule_is_same((const scree_schedule *)(const void *)x + k,
                                            (const scree_schedule *)(const void *)y + k))
                    fail_msg("%s differs", key->name);
        } else if (key->type == SCREE_KEY_LIST || key->type == SCREE_KEY_PAIRS) {
            compare_list(key, a, b);
        } else if (key->type != SCREE_KEY_PATHS && key->type != SCREE_KEY_VALUES &&
                   memcmp(x, y, sizes[key->type]) != 0) {
            fail_msg("%s differs", key->name);
        }
    }
}

static char *written(const scree_case *c)
{
    char *text = NULL;
    size_t length;
    scree_error error;
    FILE *file = open_memstream(&text, &length);
    assert_int_equal(scree_case_write(c, file, &error), SCREE_OK);
    fclose(file);
    return text;
}

static scree_case *parsed(const char *text, const char *const *overrides, size_t count)
{
    scree_case_options options = {.overrides = overrides, .override_count = count};
    scree_case *c;
    scree_problems *problems;
    if (scree_case_parse(text, strlen(text), "test.yaml", &options, &c, &problems))
        fail_msg("%s: %s", scree_problems_get(problems, 0)->field, scree_problems_get(problems, 0)->message);
    return c;
}

/// Writes what `text` with `overrides` resolves to, reads it again, and compares configs and texts.
static void check_round_trip(const char *text, const char *const *overrides, size_t count)
{
    scree_case *first = parsed(text, overrides, count);
    char *once = written(first);
    scree_case *second = parsed(once, NULL, 0);
    compare_section(scree_schema(), (const char *)&first->config, (const char *)&second->config);
    char *twice = written(second);
    assert_string_equal(once, twice);
    free(once);
    free(twice);
    scree_case_free(first);
    scree_case_free(second);
}

/// A list within an element of a list.
static const char case_with_bodies[] =
    "dimension: 3\n"
    "materials: [{name: quartz, young_modulus: 30 MPa, density: 2650 kg/m3, friction: 0.45}]\n"
    "particles: {shape: sphere, material: quartz, count: 3, distribution: equal, radius: 1 mm}\n"
    "stages:\n"
    "  - stage: prepare\n"
    "    method: bodies\n"
    "    bodies:\n"
    "      - {position: [1 mm, 2 mm, 3 mm], velocity: [4 m/s, 5 m/s, 6 m/s], spin: [7 rad/s, 8 rad/s, 9 rad/s]}\n"
    "      - {position: [5 mm, 5 mm, 5 mm]}\n"
    "      - {position: [5 mm, 8 mm, 0.3 cm], radius: 1 mm, material: quartz}\n"
    "  - {stage: relax, duration: 1 s, boundary: plates}\n";

static void written_cases_read_back_the_same(void **state)
{
    (void)state;
    const char *text = good_case();
    static const char *const singles[] = {
        "contact.law=hertz_brilliantov",
        "particles.radius_min=0.1 \u00b5m",
        "title=\"quotes\" \\ and: colons # and \u00e9, [brackets]",
        "title=- ",
        "title=a: b",
        "title=a # b",
        "title=yes",
        "title=.5 ",
        "materials.0.poisson_ratio=-0.0",
        "gravity=[1e-3 m/s2, -9.81 m/s2]",
        "measure.windows=[]",
        "boundary.lateral=plates",
        "integrator.step=auto",
        "seed=9007199254740992",
        "stages.0.width=1.23456789012345678 cm",
        "stages.0.method=gas",
        "stages.1.name=press",
        "stages.2.name=load", // which the path in the quick section does not know
    };
    static const char *const together[] = {
        "contact.law=hertz_brilliantov", "contact.friction_exponent=51", "particles.distribution=equal",
        "particles.radius=0.3 mm",       "stages.0.method=gas",          "stages.0.solid_fraction=12.3 %",
    };
    for (size_t i = 0; i < scree_template_count(); i++)
        check_round_trip(scree_template_text(scree_template_name(i)), NULL, 0);
    for (size_t i = 0; i < sizeof singles / sizeof *singles; i++) check_round_trip(text, singles + i, 1);
    check_round_trip(text, together, sizeof together / sizeof *together);
    check_round_trip(case_with_bodies, NULL, 0);
    check_round_trip(case_with_bodies, &(const char *){"stages.0.bodies.1.velocity=[1e-3 m/s, 0, 2 mm/s]"}, 1);
}

static void units_are_kept_in_written_cases(void **state)
{
    (void)state;
    scree_case *c = parsed(good_case(), NULL, 0);
    char *text = written(c);
    assert_non_null(strstr(text, "    pressure: 100 kPa                   # Confining pressure.\n"));
    assert_non_null(strstr(text, "    rate: 1e-2 1/s "));
    assert_non_null(strstr(text, "    wall_friction: auto "));
    assert_non_null(strstr(text, "  overlap: 20 % ")); // a default
    assert_non_null(strstr(text, "windows: [[1 %, 3 %], [10 %, 15 %]] "));
    assert_null(strstr(text, "quick:"));
    assert_null(strstr(text, "damping_time")); // not used with this law
    free(text);
    scree_case_free(c);
}

static void a_full_disk_is_noticed(void **state)
{
    (void)state;
    FILE *full = fopen("/dev/full", "w");
    if (!full) skip();
    scree_case *c = parsed(good_case(), NULL, 0);
    scree_error error;
    assert_int_equal(scree_case_write(c, full, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "the case cannot be written: No space left on device"));
    scree_case_free(c);
    fclose(full);
}

/// The reference holds every key and choice, and docs/case-reference.md is what the schema says now.
static void the_reference_is_up_to_date(void **state)
{
    (void)state;
    char *text = NULL, *stored;
    size_t length;
    scree_error error;
    FILE *memory = open_memstream(&text, &length);
    assert_int_equal(scree_schema_write_manual(memory, &error), SCREE_OK);
    fclose(memory);
    for (size_t i = 0; i < scree_schema()->count; i++) {
        const scree_key *key = &scree_schema()->keys[i];
        for (size_t s = 0; s < key->section_count; s++)
            for (size_t k = 0; k < key->sections[s].count; k++) {
                char row[80];
                (void)snprintf(row, sizeof row, "| `%s` |", key->sections[s].keys[k].name);
                assert_non_null(strstr(text, row));
            }
    }
    FILE *file = fopen(SCREE_SOURCE_DIR "/docs/case-reference.md", "r");
    assert_non_null(file);
    stored = calloc(1, length + 2);
    assert_non_null(stored);
    size_t got = fread(stored, 1, length + 1, file);
    fclose(file);
    if (got != length || memcmp(stored, text, length) != 0)
        fail_msg("docs/case-reference.md is out of date: build/tests/write_case_reference > docs/case-reference.md");
    free(stored);
    free(text);
}

/// A locale with a decimal comma changes nothing (where one is installed).
static void locales_do_not_matter(void **state)
{
    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "fr_FR.UTF-8")) skip();
    check_round_trip(good_case(), NULL, 0);
    scree_case *c = parsed(good_case(), NULL, 0);
    assert_true(((const scree_size_limits *)scree_config_sizes(&c->config.particles, 0))->radius_min == 0.5e-3);
    scree_case_free(c);
    setlocale(LC_ALL, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_is_documented_and_its_default_valid),
        cmocka_unit_test(written_cases_read_back_the_same),
        cmocka_unit_test(units_are_kept_in_written_cases),
        cmocka_unit_test(a_full_disk_is_noticed),
        cmocka_unit_test(the_reference_is_up_to_date),
        cmocka_unit_test(locales_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
