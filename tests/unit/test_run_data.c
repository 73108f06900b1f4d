/// run.h5 as programs see it: names, datasets and attributes of a small run; steps within a stage of the same case.
#include "library_fixture.h"

#include <scree/scree.h>

static const char scratch[] = "run_data.out";

typedef struct seen {
    int groups, datasets;
    char last[64];
    double number;
    char text[64];
} seen;

static void see_name(void *user, const char *name, bool is_group)
{
    seen *s = user;
    *(is_group ? &s->groups : &s->datasets) += 1;
    (void)snprintf(s->last, sizeof s->last, "%s", name);
}

static void see_attribute(void *user, const char *name, double number, const char *text)
{
    seen *s = user;
    if (strcmp(name, "dimension") == 0) s->number = text ? NAN : number;
    if (strcmp(name, "stage") == 0) (void)snprintf(s->text, sizeof s->text, "%s", text ? text : "");
}

static void the_last_snapshot_is_the_state(void **unused)
{
    (void)unused;
    scree_error error;
    scree_view id, place;
    scree_keeper *keeper[2];
    char path[128];
    scree_case *c = case_read(LIBRARY_PAIR, (const char *const[]){"stages.relax.duration=1 ms"}, 1);
    const scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    seen found = {0};
    check(scree_run_data_visit(scratch, "snapshots", see_name, &found, &error), &error);
    assert_true(found.groups >= 1 && found.datasets == 0);
    (void)snprintf(path, sizeof path, "snapshots/%s", found.last);
    check(scree_run_data_attributes(scratch, path, see_attribute, &found, &error), &error);
    assert_true(found.number == 2);
    assert_string_equal(found.text, "relax");
    (void)snprintf(path, sizeof path, "snapshots/%s/id", found.last);
    check(scree_run_data_read(scratch, path, &id, &keeper[0], &error), &error);
    (void)snprintf(path, sizeof path, "snapshots/%s/position", found.last);
    check(scree_run_data_read(scratch, path, &place, &keeper[1], &error), &error);
    assert_true(id.count == 2 && id.components == 1 && id.type == SCREE_FIELD_UINT32 && id.stride == 4);
    assert_true(place.count == 2 && place.components == 2 && place.type == SCREE_FIELD_DOUBLE && place.stride == 16);
    assert_int_equal(((const uint32_t *)id.data)[1], 1);
    // Nothing acts on the two: they are where the case puts them.
    const double wanted[4] = {15e-3, 20e-3, 25e-3, 20e-3};
    for (int k = 0; k < 4; k++) assert_true(fabs(((const double *)place.data)[k] - wanted[k]) < 1e-15);
    assert_string_equal(place.unit, "m");
    for (int k = 0; k < 2; k++) scree_keeper_free(keeper[k]);
    assert_int_equal(scree_run_data_read(scratch, "snapshots", &id, &keeper[0], &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_run_data_visit(scratch, "none", see_name, &found, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_run_data_read("no-such-folder", "x", &id, &keeper[0], &error), SCREE_ERROR_IO);
    scree_case_free(c);
}

static void steps_stay_within_the_stage(void **unused)
{
    (void)unused;
    bool ended;
    scree_error error;
    scree_case *c = case_read(LIBRARY_PAIR, (const char *const[]){"stages.relax.duration=1 ms"}, 1);
    scree_simulation *s = library_create(c);
    check(scree_simulation_advance_within_stage(s, 1000, &ended, &error), &error);
    assert_true(ended && scree_simulation_steps(s) == 0 && scree_simulation_stage(s, NULL) == 0);
    check(scree_simulation_advance_within_stage(s, 30, &ended, &error), &error);
    assert_true(!ended && scree_simulation_steps(s) == 30);
    check(scree_simulation_advance_within_stage(s, 1000, &ended, &error), &error);
    assert_true(ended && scree_simulation_steps(s) == 100 && scree_simulation_stage(s, NULL) == 1);
    scree_simulation_free(s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_snapshot_is_the_state),
        cmocka_unit_test(steps_stay_within_the_stage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
