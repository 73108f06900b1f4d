/// Restart between two stages changes no bit of small samples under each law and scheme, and keeps the times.
#include "run_fixture.h"

#include "io_scratch.h"
#include "simulation_cases.h"

static double read_number(const char *directory, const char *name)
{
    scree_error error;
    char text[64];
    check(scree_result_get(directory, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// Uninterrupted run against one that is stopped and restarted, and one that lost everything after a checkpoint.
static void restart_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    for (int k = 0; k < COMBINATIONS; k++) {
        scree_error error;
        scree_case *c = case_read(SIMULATION_SMALL, combinations[k], OVERRIDES);
        run_restart(c, whole, part, 2, "stage confine ended");
        double cost = read_number(whole, "loading_force_evaluations"), time = read_number(whole, "loading_wall_time");
        assert_true(cost > 0 && cost < read_number(whole, "force_evaluations"));
        assert_true(read_number(part, "loading_force_evaluations") == cost);
        assert_true(time > 0 && time < read_number(whole, "wall_time"));
        double processor = read_number(whole, "loading_processor_time");
        assert_true(processor > 0 && processor < time + 0.02); // one thread; the clocks tick differently
        // A finished run is at its end, and its time is kept.
        scree_run_options options = {.threads = 1};
        check(scree_restart(whole, &options, &error), &error);
        run_compare(whole, part);
        assert_true(read_number(whole, "loading_wall_time") == time);
        assert_true(read_number(whole, "loading_processor_time") == processor);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restart_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
