/// Sweeps: expansion of the grid, names, problems with their places; statistics against tables; averaged curves; the
/// tables of statements that are built in.
#include "testing.h"

#include "io_scratch.h"

#include "base/units.h"
#include "sweep/findings.h"
#include "sweep/statements.h"
#include "sweep/statistics.h"
#include "sweep/sweep.h"
#include "sweep/templates.h"

#include <math.h>

static char folder[64];

static void write_text(const char *name, const char *text)
{
    char path[128];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static scree_status read_sweep(const char *text, const scree_sweep_read_options *options, scree_sweep **sweep,
                               scree_problems **problems)
{
    char path[128];
    write_text("sweep.yaml", text);
    (void)snprintf(path, sizeof path, "%s/sweep.yaml", folder);
    return scree_sweep_read(path, options, sweep, problems);
}

static scree_sweep *good(const char *text, const scree_sweep_read_options *options)
{
    scree_sweep *sweep;
    scree_problems *problems;
    if (read_sweep(text, options, &sweep, &problems))
        fail_msg("%s: %s", scree_problems_get(problems, 0)->field, scree_problems_get(problems, 0)->message);
    return sweep;
}

static const char grid[] = "sweep: 1\n"
                           "case: biaxial\n"
                           "realisations: 2\n"
                           "seed: 7\n"
                           "set: {particles.count: 100}\n"
                           "vary:\n"
                           "  - {key: materials.0.friction, values: [0.2, 0.4, 0.6]}\n"
                           "  - name: load\n"
                           "    together:\n"
                           "      - {key: stages.compress.rate, values: [1e-2 1/s, 2e-2 1/s]}\n"
                           "      - {key: stages.confine.pressure, values: [50 kPa, 0.2 MPa]}\n"
                           "    names: [slow & low, fast]\n"
                           "measures: [phi]\n";

static void the_grid_is_the_product_of_its_dimensions(void **state)
{
    (void)state;
    scree_sweep *sweep = good(grid, NULL);
    assert_int_equal(sweep->point_count, 6);
    assert_int_equal(sweep->member_count, 12);
    assert_string_equal(sweep->point[0], "friction=0.2_slow-low");
    assert_string_equal(sweep->point[5], "friction=0.6_fast");
    assert_string_equal(sweep->folder[3], "003-friction=0.4_fast-seed=7");
    // More realisations only add members.
    assert_string_equal(sweep->folder[9], "009-friction=0.4_fast-seed=8");
    assert_int_equal(scree_member_point(sweep, 9), 3);
    for (size_t point = 0; point < 6; point++) {
        assert_int_equal(scree_point_setting(sweep, point, 0), point / 2);
        assert_int_equal(scree_point_setting(sweep, point, 1), point % 2);
    }
    char label[64];
    scree_point_label(sweep, 5, SIZE_MAX, label, sizeof label);
    assert_string_equal(label, "friction 0.6, fast");
    scree_point_label(sweep, 5, 1, label, sizeof label);
    assert_string_equal(label, "friction 0.6");
    // Names of a dimension are a parameter beside its keys; numbers are SI.
    assert_int_equal(sweep->parameter_count, 4);
    assert_string_equal(sweep->parameter[1].name, "load");
    assert_string_equal(sweep->parameter[3].unit, "Pa");
    assert_true(fabs(sweep->parameter[3].number[1] - 2e5) < 1e-6); // a conversion rounds
    scree_sweep_free(sweep);
}

static void members_have_what_the_sweep_sets(void **state)
{
    (void)state;
    const char *const overrides[] = {"particles.count=50"};
    scree_sweep_read_options options = {overrides, 1, true, 3};
    scree_sweep *sweep = good(grid, &options);
    char *text, command[2000];
    assert_int_equal(sweep->member_count, 18);
    assert_int_equal(scree_member_text(sweep, 15, &text, NULL), SCREE_OK);
    assert_non_null(strstr(text, "seed: 9"));
    assert_non_null(strstr(text, "count: 50 "));
    assert_non_null(strstr(text, "friction: 0.4"));
    assert_non_null(strstr(text, "pressure: 0.2 MPa"));
    free(text);
    scree_sweep_member_command(sweep, 15, command, sizeof command);
    assert_string_equal(command, "scree run biaxial --quick --set particles.count=100 --set materials.0.friction=0.4 "
                                 "--set 'stages.compress.rate=2e-2 1/s' --set 'stages.confine.pressure=0.2 MPa' "
                                 "--set seed=9 --set particles.count=50");
    scree_sweep_free(sweep);
}

static void alternatives_set_different_keys(void **state)
{
    (void)state;
    scree_sweep *sweep = good("case: biaxial\nvary:\n- alternatives:\n  - {name: as it is}\n"
                              "  - {name: other, set: {boundary.lateral: plates, measure.windows: [[1 %, 2 %]]}}\n",
                              NULL);
    char *text;
    assert_int_equal(sweep->point_count, 2);
    assert_string_equal(sweep->point[0], "as-it-is");
    assert_int_equal(scree_member_text(sweep, 1, &text, NULL), SCREE_OK);
    assert_non_null(strstr(text, "lateral: plates"));
    assert_non_null(strstr(text, "windows: [[1 %, 2 %]]"));
    free(text);
    scree_sweep_free(sweep);
}

/// Every problem, with its line in the sweep file and the nearest right name.
static void problems_are_told_all_at_once_with_their_places(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int line;
        const char *message;
    } wrong[] = {
        {"case: biaxil\n", 1, "there is no built-in case 'biaxil'; did you mean 'biaxial'?"},
        {"case: biaxial\nmeasurs: [phi]\n", 2, "unknown key; did you mean 'measures'?"},
        {"case: biaxial\nset:\n  particles.cout: 100\n", 3, "did you mean 'particles.count'?"},
        {"case: biaxial\nset:\n  particles.radius_min: 3 kPa\n", 3, "is a pressure; expected a length"},
        {"case: biaxial\nvary:\n- key: materials.0.friction\n  values:\n  - 0.2\n  - 99\n", 6, "'99' is too large"},
        {"case: biaxial\nvary:\n- {key: materials.0.friction}\n", 3, "'key' needs 'values'"},
        {"case: biaxial\nvary:\n- {name: nothing}\n", 3, "says nothing about what varies"},
        {"case: biaxial\nvary:\n- {key: materials.0.friction, values: [1, 2], names: [a]}\n", 3, "1 values beside 2"},
        {"case: biaxial\nvary:\n- {key: materials.0.friction, values: [0.2, 0.2]}\n", 3, "would be called '0.2'"},
        {"case: biaxial\nvary:\n- {key: seed, values: [1, 2]}\n", 3, "is varied by `realisations`"},
        {"case: biaxial\nset: {seed: 2}\n", 2, "is set by `seed` and `realisations`"},
        {"case: biaxial\ncurves: [{y: stress_ration}]\n", 2, "did you mean 'stress_ratio'?"},
        {"case: biaxial\nmeasures:\n- phi\n- peak_stres_ratio\n", 4, "did you mean 'peak_stress_ratio'?"},
        {"case: biaxial\nmeasures: [state_checksum]\n", 2, "a text has no mean"},
        {"case: rotating-drum\nmeasures: [drums_work]\n", 2, "nothing in the cases is called so"},
        {"case: biaxial\nrelations: [{x: phi, y: psi}]\nmeasures: [phi]\n", 2, "'psi' is none of the measures"},
        {"case: biaxial\nconfidence: 20 %\n", 2, "is too small"},
        {"sweep: 1\n", 1, "required, but not given"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        scree_sweep *sweep;
        scree_problems *problems;
        assert_int_equal(read_sweep(wrong[i].text, NULL, &sweep, &problems), SCREE_ERROR_INPUT);
        assert_null(sweep);
        bool found = false;
        for (size_t k = 0; k < scree_problems_count(problems); k++) {
            const scree_error *problem = scree_problems_get(problems, k);
            found |= problem->line == wrong[i].line && strstr(problem->message, wrong[i].message) &&
                     strstr(problem->file, "sweep.yaml");
        }
        if (!found)
            fail_msg("'%s': %d: %s", wrong[i].text, scree_problems_get(problems, 0)->line,
                     scree_problems_get(problems, 0)->message);
        scree_problems_free(problems);
    }
    scree_sweep *sweep;
    scree_problems *problems;
    (void)read_sweep(
        "case: biaxial\nset:\n  particles.cout: 1\nvary:\n- {key: materials.0.friction, values: [a, 0.2, b]}\n", NULL,
        &sweep, &problems);
    assert_int_equal(scree_problems_count(problems), 3);
    scree_problems_free(problems);
}

static void measures_may_be_of_a_wall(void **state)
{
    (void)state;
    scree_sweep_free(good("case: rotating-drum\nmeasures: [drum_work, restitution]\n"
                          "curves: [{x: time, y: drum_torque_z}]\n",
                          NULL));
}

static void a_case_lies_beside_its_sweep(void **state)
{
    (void)state;
    write_text("own.yaml", scree_template_text("biaxial"));
    scree_sweep *sweep = good("case: own.yaml\nvary: [{key: particles.count, values: [50, 60]}]\n", NULL);
    assert_int_equal(sweep->member_count, 2);
    assert_non_null(strstr(sweep->case_name, "/own.yaml"));
    scree_sweep_free(sweep);
}

/// Student's t for 95 %: 12.7062 (1 degree), 4.3027 (2), 2.7764 (4), from any table, four decimals: tolerance 1e-4
/// relative.
static void intervals_are_those_of_students_table(void **state)
{
    (void)state;
    static const struct {
        double value[5];
        size_t count;
        double mean, deviation, t;
    } known[] = {
        {{1, 3}, 2, 2, 1.4142135623730951, 12.7062},
        {{2, 4, 6}, 3, 4, 2, 4.3027},
        {{1, 2, 3, 4, 5}, 5, 3, 1.5811388300841898, 2.7764},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        scree_estimate e = scree_estimate_mean(known[i].value, known[i].count, 0.95);
        double half = known[i].t * known[i].deviation / sqrt((double)known[i].count);
        assert_int_equal(e.count, known[i].count);
        assert_true(fabs(e.mean - known[i].mean) < 1e-12);
        assert_true(fabs(e.deviation - known[i].deviation) < 1e-12);
        assert_true(fabs(e.half / half - 1) < 1e-4);
        assert_true(e.range[0] == known[i].value[0] && e.range[1] == known[i].value[known[i].count - 1]);
    }
    // 99 % with 2 degrees: 9.9248.
    assert_true(fabs(scree_estimate_mean(known[1].value, 3, 0.99).half / (9.9248 * 2 / sqrt(3)) - 1) < 1e-4);
}

static void what_is_not_there_is_left_out(void **state)
{
    (void)state;
    const double value[] = {NAN, 2, INFINITY, 4, 6};
    scree_estimate e = scree_estimate_mean(value, 5, 0.95), one = scree_estimate_mean(value, 2, 0.95);
    assert_int_equal(e.count, 3);
    assert_int_equal(e.of, 5);
    assert_true(e.mean == 4 && e.deviation == 2 && e.range[0] == 2 && e.range[1] == 6);
    assert_true(one.count == 1 && one.mean == 2 && isnan(one.deviation) && isnan(one.half));
    e = scree_estimate_mean(value, 1, 0.95);
    assert_true(e.count == 0 && isnan(e.mean) && isnan(e.range[0]));
}

static void curves_follow_the_last_ascent(void **state)
{
    (void)state;
    const double x[] = {NAN, 0, 1, 2, 1.5, 3, 0, 1, 2}, y[] = {9, 0, 10, 20, 99, 30, 5, 6, NAN};
    const double stage[] = {1, 2, 2, 2, 2, 2, 3, 3, 3};
    scree_curve curve;
    assert_int_equal(scree_curve_from_series(x, y, stage, 6, &curve, NULL), SCREE_OK);
    assert_int_equal(curve.count, 4);
    assert_true(scree_curve_at(&curve, 2.5) == 25);
    assert_true(scree_curve_at(&curve, 3) == 30);
    assert_true(isnan(scree_curve_at(&curve, 3.01)) && isnan(scree_curve_at(&curve, -0.01)));
    scree_curve_destroy(&curve);
    assert_int_equal(scree_curve_from_series(x, y, stage, 9, &curve, NULL), SCREE_OK);
    assert_int_equal(curve.count, 2);
    assert_true(curve.y[0] == 5 && curve.y[1] == 6);
    scree_curve_destroy(&curve);
}

/// Straight lines are interpolated exactly but for rounding: 1e-12.
static void curves_are_averaged_where_all_of_them_are(void **state)
{
    (void)state;
    double x1[] = {0, 1, 4}, y1[] = {0, 2, 8}, x2[] = {1, 2, 3, 5}, y2[] = {4, 8, 12, 20}, x[5];
    scree_curve curve[] = {{x1, y1, 3}, {x2, y2, 4}};
    scree_estimate e[5];
    scree_error error;
    assert_int_equal(scree_curves_average(curve, 2, 0.95, 5, x, e, &error), SCREE_OK);
    assert_true(x[0] == 1 && x[4] == 4);
    for (size_t k = 0; k < 5; k++) {
        assert_int_equal(e[k].count, 2);
        assert_true(fabs(e[k].mean - 3 * x[k]) < 1e-12);
        assert_true(fabs(e[k].deviation - sqrt(2) * x[k]) < 1e-12);
    }
    double far[] = {10, 11};
    scree_curve apart[] = {{x1, y1, 3}, {far, y1, 2}};
    assert_int_equal(scree_curves_average(apart, 2, 0.95, 5, x, e, &error), SCREE_ERROR_INPUT);
}

/// docs/sweeps.md names every key of a sweep file.
static void check_documented(const scree_section *section, const char *page)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        const char *found = strstr(page, key->name);
        if (!found) fail_msg("docs/sweeps.md does not have '%s'", key->name);
        for (size_t k = 0; k < key->section_count; k++) check_documented(&key->sections[k], page);
    }
}

static void every_key_is_documented(void **state)
{
    (void)state;
    char *page = calloc(1, 1 << 16);
    FILE *file = fopen(SCREE_SOURCE_DIR "/docs/sweeps.md", "r");
    assert_non_null(file);
    assert_true(fread(page, 1, (1 << 16) - 1, file) > 1000);
    assert_int_equal(fclose(file), 0);
    check_documented(&scree_sweep_schema, page);
    free(page);
}

/// The built-in tables can be read, what they name exists, and each group is about a built-in sweep that can be read as
/// soon as its case exists.
static void built_in_statements_are_sound(void **state)
{
    (void)state;
    assert_true(scree_statement_templates_count > 0);
    for (size_t i = 0; i < scree_statement_templates_count; i++) {
        const scree_template *built_in = &scree_statement_templates[i];
        scree_arena arena = {0};
        scree_statement_table table;
        scree_problems *problems;
        const scree_findings none = {0};
        if (scree_statements_read(built_in->name, built_in->text, built_in->length, &none, &arena, &table, &problems))
            fail_msg("%s:%d: %s", built_in->name, scree_problems_get(problems, 0)->line,
                     scree_problems_get(problems, 0)->message);
        for (int64_t k = 0; k < table.case_count; k++)
            if (!scree_sweep_template(table.cases[k].name)) fail_msg("no sweep %s", table.cases[k].name);
        scree_arena_release(&arena);
    }
    for (size_t i = 0; i < scree_sweep_templates_count; i++) {
        scree_sweep *sweep;
        scree_problems *problems;
        if (scree_sweep_read(scree_sweep_templates[i].name, NULL, &sweep, &problems) == SCREE_OK) {
            assert_string_equal(sweep->config.name, scree_sweep_templates[i].name);
        } else {
            const scree_error *first = scree_problems_get(problems, 0);
            if (scree_problems_count(problems) > 1 || !strstr(first->message, "there is no built-in case"))
                fail_msg("%s:%d: %s: %s", first->file, first->line, first->field, first->message);
        }
        scree_problems_free(problems);
        scree_sweep_free(sweep);
    }
}

static int begin(void **state)
{
    (void)state;
    return scratch_create(folder) ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    scratch_destroy(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grid_is_the_product_of_its_dimensions),
        cmocka_unit_test(members_have_what_the_sweep_sets),
        cmocka_unit_test(alternatives_set_different_keys),
        cmocka_unit_test(problems_are_told_all_at_once_with_their_places),
        cmocka_unit_test(measures_may_be_of_a_wall),
        cmocka_unit_test(a_case_lies_beside_its_sweep),
        cmocka_unit_test(intervals_are_those_of_students_table),
        cmocka_unit_test(what_is_not_there_is_left_out),
        cmocka_unit_test(curves_follow_the_last_ascent),
        cmocka_unit_test(curves_are_averaged_where_all_of_them_are),
        cmocka_unit_test(every_key_is_documented),
        cmocka_unit_test(built_in_statements_are_sound),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
