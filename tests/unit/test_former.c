/// What an earlier version has written stays what it is: cases under former names and without later keys, results under
/// former names, the finished member of a sweep (tests/stored/).
#include "testing.h"

#include "base/memory.h"
#include "case/case.h"
#include "io/summary.h"
#include "io_scratch.h"
#include "sweep/member.h"

#include <math.h>

#define STORED SCREE_SOURCE_DIR "/tests/stored/"

/// The stored case with `from` replaced by `to` in all places, as a file in the scratch folder.
static const char *changed(const char *from, const char *to)
{
    char *text;
    size_t length, found = 0;
    assert_int_equal(scree_case_text(STORED "case.yaml", &text, &length, NULL), SCREE_OK);
    FILE *file = fopen("changed.yaml", "w");
    assert_non_null(file);
    for (const char *at = text; *at;) {
        bool here = strncmp(at, from, strlen(from)) == 0;
        fputs(here ? to : (char[]){*at, 0}, file);
        at += here ? strlen(from) : 1;
        found += here;
    }
    assert_int_equal(fclose(file), 0);
    scree_release(&text);
    assert_true(found > 0);
    return "changed.yaml";
}

static scree_case *given(void)
{
    scree_case *c;
    assert_int_equal(scree_case_read(STORED "given.yaml", NULL, &c, NULL), SCREE_OK);
    return c;
}

/// Whether the file, read with a table of former names, is the given case.
static bool means_the_same(const char *path, const scree_former_key *former)
{
    scree_case *c = given(), *stored;
    assert_int_equal(scree_case_reread(path, former, &stored, NULL), SCREE_OK);
    bool same = scree_case_same(stored, c) && scree_case_same(c, stored);
    scree_case_free(stored);
    scree_case_free(c);
    return same;
}

static void a_stored_case_is_the_given_one(void **state)
{
    (void)state;
    assert_true(means_the_same(STORED "case.yaml", scree_former_keys));
    assert_true(means_the_same(STORED "given.yaml", scree_former_keys));
    // Keys that a later version has added: they take their defaults.
    assert_true(means_the_same(changed("    wall_friction: auto", "   "), NULL));
    assert_true(means_the_same(changed("  servo_gain: 1 ", "  # "), NULL));
    // Units, comments.
    assert_true(means_the_same(changed("100 kPa", "0.1 MPa"), NULL));
    assert_true(means_the_same(changed("Confining pressure.", "What confines."), NULL));
}

static void other_values_are_another_case(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"100 kPa", "101 kPa"},                       // number of a stage
        {"count: 40", "count: 41"},                   // integer
        {"windows: [[0.2 %, 0.5 %]]", "windows: []"}, // pairs
        {"windows: [[0.2 %, 0.5 %]]", "windows: [[0.2 %, 0.6 %]]"},
        {"lateral: pressure", "lateral: plates"},  // choice
        {"gravity: [0, 0]", "gravity: [0, 1e-9]"}, // vector
        {"name: stored", "name: other"},           // word
        {"title: \"\"", "title: other"},           // text
        {"paraview: no", "paraview: yes"},         // flag
        {"quartz", "basalt"},                      // name in a list
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        assert_false(means_the_same(changed(pairs[i][0], pairs[i][1]), NULL));
    // A stage more, a stage less.
    assert_false(means_the_same(
        changed("  - stage: compress", "  - {stage: confine, pressure: 1 kPa}\n  - stage: compress"), NULL));
}

/// A schema that has renamed: what is `young_modulus` now was `stiffness`, in all elements of a list; a choice and a
/// key of a section too.
static void former_names_of_keys(void **state)
{
    (void)state;
    static const scree_former_key former[] = {{"materials.*.stiffness", "young_modulus", NULL, NULL},
                                              {"boundary.sides", "lateral", "water", "pressure"},
                                              {"contact.law", "law", "mindlin", "hertz_mindlin"},
                                              {"length", "gravity", NULL, NULL},
                                              {NULL, NULL, NULL, NULL}};
    scree_case *c;
    const char *path = changed("young_modulus", "stiffness");
    assert_int_equal(scree_case_reread(path, scree_former_keys, &c, NULL), SCREE_ERROR_INPUT);
    assert_true(means_the_same(path, former));
    assert_true(means_the_same(changed("lateral: pressure", "sides: water"), former));
    assert_true(means_the_same(changed("law: hertz_mindlin", "law: mindlin"), former));
    assert_false(means_the_same(changed("lateral: pressure", "sides: plates"), former));
    // Both names at once are not guessed about.
    path = changed("    young_modulus: 30 GPa", "    stiffness: 30 GPa\n    young_modulus: 30 GPa");
    assert_int_equal(scree_case_reread(path, former, &c, NULL), SCREE_ERROR_INPUT);
}

static void former_names_of_results(void **state)
{
    (void)state;
    static const scree_former_result former[] = {
        {"peak_stress_ratio", "peak_strength"}, {"steps", "particles"}, {NULL, NULL}};
    char value[64], again[64];
    scree_error error;
    assert_int_equal(scree_result_find(STORED, "peak_strength", former, value, sizeof value, &error), SCREE_OK);
    assert_int_equal(scree_result_get(STORED, "peak_stress_ratio", again, sizeof again, &error), SCREE_OK);
    assert_string_equal(value, again);
    // The present name comes first.
    assert_int_equal(scree_result_find(STORED, "particles", former, value, sizeof value, &error), SCREE_OK);
    assert_string_equal(value, "40");
    assert_int_equal(scree_result_get(STORED, "peak_strength", value, sizeof value, &error), SCREE_ERROR_INPUT);
}

static void copy(const char *from, const char *to)
{
    char *text;
    size_t length;
    assert_int_equal(scree_case_text(from, &text, &length, NULL), SCREE_OK);
    FILE *file = fopen(to, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    scree_release(&text);
}

/// The finished member of version 0.1.0 is finished for this one.
static void a_stored_member_is_done(void **state)
{
    (void)state;
    scree_sweep *sweep;
    scree_problems *problems = NULL;
    scree_member_paths paths;
    scree_case *c;
    scree_error error;
    assert_int_equal(mkdir("members", 0777) | mkdir("members/000-seed=1", 0777), 0);
    copy(STORED "summary.json", "members/000-seed=1/summary.json");
    assert_int_equal(scree_sweep_read(STORED "sweep.yaml", NULL, &sweep, &problems), SCREE_OK);
    assert_int_equal(scree_member_find(sweep, 0, ".", &paths, &error), SCREE_OK);
    assert_int_equal(scree_member_resolve(sweep, 0, &c, &error), SCREE_OK);
    copy(STORED "case.yaml", "members/000-seed=1/case.yaml");
    assert_int_equal(scree_member_look(&paths, c, NULL, 0), SCREE_MEMBER_DONE);
    copy(changed("  every: 250 ", "  # "), "members/000-seed=1/case.yaml");
    assert_int_equal(scree_member_look(&paths, c, NULL, 0), SCREE_MEMBER_DONE);
    copy(changed("seed: 1 ", "seed: 2 "), "members/000-seed=1/case.yaml");
    assert_int_equal(scree_member_look(&paths, c, NULL, 0), SCREE_MEMBER_CHANGED);
    scree_case_free(c);
    scree_sweep_free(sweep);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(a_stored_case_is_the_given_one), IN_SCRATCH(other_values_are_another_case),
        IN_SCRATCH(former_names_of_keys),           IN_SCRATCH(former_names_of_results),
        IN_SCRATCH(a_stored_member_is_done),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
