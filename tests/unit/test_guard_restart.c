/// A run that a guard has stopped: going on from its folder stops at the same place with the same rows, until the limit
/// has been changed.
#include "measure/delaunay_boundary.h"
#include "run_fixture.h"
#include "state/plates.h"

#include "io/series.h"
#include "io_scratch.h"
#include "simulation_cases.h"

static const char case_text[] = SIMULATION_CASE("count: 40, radius_min: 0.9 mm, radius_max: 1 mm", "0.2", "0.2 %",
                                                ", cells: no", ", checkpoint_steps: 1500");

static const scree_run_options plain = {.output = "run", .threads = 1, .force = true};

static size_t count_rows(void)
{
    scree_series series;
    scree_error error;
    check(scree_series_read(&series, "run/series.csv", &error), &error);
    size_t rows = series.row_count;
    scree_series_destroy(&series);
    return rows;
}

/// Restarts until the limit has been changed stop where `first` did.
static void stops_again(const scree_error *first, const char *words)
{
    size_t rows = count_rows(), snapshots, again;
    scree_error error;
    assert_int_equal(first->status, SCREE_ERROR_GUARD);
    if (!strstr(first->message, words)) fail_msg("'%s' does not hold '%s'", first->message, words);
    check(scree_snapshot_count("run", &snapshots, &error), &error);
    for (int times = 0; times < 2; times++) {
        scree_run_options options = {.threads = 1 + times};
        assert_int_equal(scree_restart("run", &options, &error), SCREE_ERROR_GUARD);
        assert_string_equal(error.message, first->message);
        assert_int_equal(count_rows(), rows);
        check(scree_snapshot_count("run", &again, &error), &error);
        assert_int_equal(again, snapshots);
    }
}

/// Gives `key` of run/case.yaml another value.
static void change_case(const char *key, const char *value)
{
    FILE *old = fopen("run/case.yaml", "r"), *new = fopen("run/case.new", "w");
    char line[512];
    int changed = 0;
    assert_true(old && new);
    while (fgets(line, sizeof line, old)) {
        char *at = strstr(line, key);
        if (at && at[strlen(key)] == ':') {
            (void)snprintf(at + strlen(key), sizeof line - (size_t)(at - line) - strlen(key), ": %s\n", value);
            changed++;
        }
        (void)fputs(line, new);
    }
    assert_int_equal(fclose(old) | fclose(new), 0);
    assert_int_equal(changed, 1);
    assert_int_equal(rename("run/case.new", "run/case.yaml"), 0);
}

/// Runs with `override`, which stops it, and goes on with another `value` of `key`. `same`: the limit is nothing but
/// that, so the run ends with the bits of one that had the other value from its begin.
static void limit_stops(const char *override, const char *words, const char *key, const char *value, bool same)
{
    scree_error error;
    const char *const overrides[] = {override};
    scree_case *c = case_read(case_text, overrides, 1);
    assert_int_equal(scree_run(c, &plain, &error), SCREE_ERROR_GUARD);
    stops_again(&error, words);
    change_case(key, value);
    scree_run_options options = {.threads = 1};
    check(scree_restart("run", &options, &error), &error);
    scree_case_free(c);
    size_t rows = count_rows();
    c = case_read(case_text, NULL, 0);
    options = (scree_run_options){.output = "whole", .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    if (same) run_compare("whole", "run");
    assert_int_equal(rename("whole/series.csv", "run/series.csv"), 0);
    if (same) assert_int_equal(count_rows(), rows);
    scree_case_free(c);
}

static void energy(void **unused)
{
    (void)unused;
    limit_stops("guard.energy_growth=1e-7 %", "guard.energy_growth", "energy_growth", "5 %", true);
}

/// The limit of overlap also bounds the forces of a step, hence their quanta: other bits.
static void overlap(void **unused)
{
    (void)unused;
    limit_stops("guard.overlap=0.01 %", "guard.overlap", "overlap", "20 %", false);
}

static void time_limit(void **unused)
{
    (void)unused;
    limit_stops("stages.confine.time_limit=20 ms", "not at rest", "time_limit", "auto", true);
}

/// A value that is no guard makes another case.
static void other_values_are_refused(void **unused)
{
    (void)unused;
    scree_error error;
    const char *const overrides[] = {"stages.confine.time_limit=20 ms"};
    scree_case *c = case_read(case_text, overrides, 1);
    assert_int_equal(scree_run(c, &plain, &error), SCREE_ERROR_GUARD);
    change_case("unbalanced_limit", "0.1");
    scree_run_options options = {.threads = 1};
    assert_int_equal(scree_restart("run", &options, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "of another case"));
    scree_case_free(c);
}

/// Changes the state of the newest checkpoint of run/; what goes on from there is stopped with `words`.
static void spoiled(const scree_case *c, void (*spoil)(scree_state *state), const char *words)
{
    scree_error error;
    uint64_t checksum;
    scree_state state;
    check(scree_case_checksum(c, &checksum, &error), &error);
    check(scree_checkpoint_read("run", 2, &state, checksum, &error), &error);
    spoil(&state);
    check(scree_checkpoint_write("run", &state, checksum, &error), &error);
    scree_state_destroy(&state);
    scree_run_options options = {.threads = 1};
    assert_int_equal(scree_restart("run", &options, &error), SCREE_ERROR_GUARD);
    stops_again(&error, words);
}

static void hurl(scree_state *state)
{
    scree_row *row = &state->row[state->row_of_id[7]];
    row->vx = row->vy = 1.5e308;
}

static void not_a_number(void **unused)
{
    (void)unused;
    scree_error error;
    const char *const overrides[] = {"stages.confine.time_limit=80 ms"};
    scree_case *c = case_read(case_text, overrides, 1);
    assert_int_equal(scree_run(c, &plain, &error), SCREE_ERROR_GUARD);
    spoiled(c, hurl, "particle 7 is not a number");
    scree_case_free(c);
}

/// The bottom plate stands upright beside the sample, and higher than its bodies.
static void lift_plate(scree_state *state)
{
    for (size_t row = 0; row < state->count; row++) {
        state->row[row].x += 1;
        state->reference[row][0] += 1;
    }
    for (size_t k = 0; k < scree_loop_of(state)->count; k++) scree_loop_of(state)->x[k] += 1;
    scree_wall *bottom = &scree_plates(state)[SCREE_WALL_BOTTOM];
    bottom->position = 0.5;
    bottom->normal[0] = 1;
    bottom->normal[1] = 0;
}

static void escape(void **unused)
{
    (void)unused;
    scree_error error;
    run_stop stopping = {.at = "stage confine ended"};
    scree_run_options options = plain;
    options.stop = &stopping.stop;
    options.message = run_stop_at;
    options.user = &stopping;
    scree_case *c = case_read(case_text, NULL, 0);
    assert_int_equal(scree_run(c, &options, &error), SCREE_INTERRUPTED);
    spoiled(c, lift_plate, "is behind the bottom plate");
    scree_case_free(c);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(energy),       IN_SCRATCH(overlap), IN_SCRATCH(time_limit), IN_SCRATCH(other_values_are_refused),
        IN_SCRATCH(not_a_number), IN_SCRATCH(escape),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
