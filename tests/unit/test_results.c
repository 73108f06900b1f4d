/// What runs tell: names, units and reference of all columns and results, and those of modules in a case.
#include "testing.h"

#include "base/units.h"
#include "case/templates.h"
#include "io/result_names.h"
#include "run/columns.h"
#include "run/sample.h"
#include "run_fixture.h"
#include "state/case_walls.h"

#include <math.h>
#include <string.h>

enum { MOST = 1024 };

/// All declared rows of columns, or of results; those that cannot be measured have a module that concludes them.
static size_t gather(bool columns, const scree_result *row[MOST])
{
    size_t count = 0, own = columns ? SCREE_SAMPLE_COUNT : scree_run_results_count;
    for (size_t k = 0; k < own; k++) row[count++] = columns ? &scree_sample_columns[k] : &scree_run_results[k];
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_results *set = columns ? &scree_modules[m]->columns : &scree_modules[m]->results;
        assert_true(set->count == 0 || set->measure || (!columns && scree_modules[m]->conclude));
        for (size_t k = 0; k < set->count; k++) row[count++] = &set->row[k];
        assert_true(count < MOST);
    }
    return count;
}

/// Each name once, in a form that a sweep can give, with a unit that is one.
static void names_are_given_once(void **state)
{
    const scree_result *row[MOST];
    (void)state;
    for (int columns = 0; columns < 2; columns++) {
        size_t count = gather(columns, row);
        for (size_t i = 0; i < count; i++) {
            double value;
            char one[64];
            assert_true(row[i]->meaning[0] && row[i]->name[strspn(row[i]->name, "abcdefghijklmnopqrstuvwxyz_")] == 0);
            (void)snprintf(one, sizeof one, "1 %s", row[i]->unit && strcmp(row[i]->unit, "1") != 0 ? row[i]->unit : "");
            if (row[i]->unit) assert_int_equal(scree_units_parse(one, row[i]->unit, &value, NULL), SCREE_OK);
            for (size_t k = 0; k < i; k++) assert_string_not_equal(row[i]->name, row[k]->name);
        }
    }
}

/// The reference page has a line for each.
static void the_reference_lists_all(void **state)
{
    static char text[1 << 18];
    const scree_result *row[MOST];
    size_t missing = 0;
    (void)state;
    FILE *file = fopen(SCREE_SOURCE_DIR "/docs/output.md", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    for (int columns = 1; columns >= 0; columns--) {
        size_t count = gather(columns, row);
        for (size_t i = 0; i < count; i++) {
            char line[512];
            (void)snprintf(line, sizeof line, "\n| `%s%s` | %s | %s |\n", row[i]->name[0] == '_' ? "NAME" : "",
                           row[i]->name, row[i]->unit ? row[i]->unit : "", row[i]->meaning);
            if (strstr(text, line)) continue;
            print_error("docs/output.md lacks this row of the %s:%s", columns ? "columns" : "results", line);
            missing++;
        }
    }
    assert_int_equal(missing, 0);
}

static void results_of_walls_are_found_by_their_ending(void **state)
{
    const scree_module *module;
    (void)state;
    assert_string_equal(scree_result_name_find("big_drum_torque_x", &module)->unit, "N m");
    assert_ptr_equal(module, scree_modules[SCREE_SLOT_case_walls]);
    assert_non_null(scree_result_name_find("top_exerted_force_x", &module));
    assert_ptr_equal(module, scree_modules[SCREE_SLOT_prescribed]);
    assert_null(scree_result_name_find("_work", &module));
    assert_null(scree_result_name_find("drum_wrk", &module));
    assert_string_equal(scree_result_name_find("phi", &module)->unit, "1");
    assert_null(module);
}

/// Each wall has seven columns; their values are those of the state, and a wall whose
/// column would have the name of another is refused.
static void columns_of_walls_follow_the_case(void **state)
{
    (void)state;
    const char *const overrides[] = {"particles.count=150", "stages.relax.duration=60 ms", "measure.samples=4"};
    scree_case *c = case_read(scree_template_text("hopper"), overrides, 3);
    scree_columns bare;
    scree_simulation s;
    scree_error error;
    int64_t walls = c->config.wall_count;
    c->config.wall_count = 0;
    check(scree_columns_create(&c->config, &bare, &error), &error);
    c->config.wall_count = walls;
    simulation_open(c, 1, &s);
    assert_true(walls == 3 && s.columns.count == bare.count + 30);
    assert_true(scree_columns_find(&s.columns, "floor_work") < s.columns.count);
    assert_int_equal(scree_columns_find(&bare, "floor_work"), bare.count);
    scree_columns_destroy(&bare);
    simulation_finish(&s);
    const scree_surface_load *load = scree_case_walls(&s.state)->load;
    assert_true(load[1].force[0] != 0 || load[1].force[2] != 0 || load[0].force[2] != 0);
    for (int w = 0; w < 2; w++) {
        const char *const of[2][3] = {{"funnel_force_x", "funnel_force_z", "funnel_torque_z"},
                                      {"silo_force_x", "silo_force_z", "silo_torque_z"}};
        assert_true(scree_sample_get(&s, of[w][0]) == load[w].force[0]);
        assert_true(scree_sample_get(&s, of[w][1]) == load[w].force[2]);
        assert_true(scree_sample_get(&s, of[w][2]) == load[w].torque[2]);
    }
    assert_true(isnan(scree_sample_get(&s, "floor")));
    scree_simulation_close(&s);
    char *kept = c->config.walls[2].name;
    c->config.walls[2].name = "stiffness";
    assert_int_equal(scree_columns_create(&c->config, &bare, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "two columns of series.csv would be called 'stiffness_work'"));
    c->config.walls[2].name = kept;
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_given_once),
        cmocka_unit_test(the_reference_lists_all),
        cmocka_unit_test(results_of_walls_are_found_by_their_ending),
        cmocka_unit_test(columns_of_walls_follow_the_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
