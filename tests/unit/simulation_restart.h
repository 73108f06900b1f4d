/// Small samples that are stopped between two stages and restarted, for programs of some combinations each.
#ifndef SCREE_TESTS_SIMULATION_RESTART_H
#define SCREE_TESTS_SIMULATION_RESTART_H

#include "run_fixture.h"

#include "io_scratch.h"
#include "simulation_cases.h"

#include <stdlib.h>

static inline double restart_number(const char *directory, const char *name)
{
    scree_error error;
    char text[64];
    check(scree_result_get(directory, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// The combinations `first` to `last`: an uninterrupted run against one that is stopped between two stages and
/// restarted, and what going on does to one that has ended.
static inline void restart_compare(int first, int last)
{
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    for (int k = first; k <= last; k++) {
        scree_error error;
        scree_case *c = case_read(SIMULATION_SMALL, combinations[k], OVERRIDES);
        run_restart(c, whole, part, 2, "stage confine ended");
        double cost = restart_number(whole, "loading_force_evaluations");
        double time = restart_number(whole, "loading_wall_time");
        assert_true(cost > 0 && cost < restart_number(whole, "force_evaluations"));
        assert_true(restart_number(part, "loading_force_evaluations") == cost);
        assert_true(time > 0 && time < restart_number(whole, "wall_time"));
        double processor = restart_number(whole, "loading_processor_time");
        assert_true(processor > 0 && processor < time + 0.02); // one thread; the clocks tick differently
        // A finished run is at its end, and its time is kept.
        scree_run_options options = {.threads = 1};
        check(scree_restart(whole, &options, &error), &error);
        run_compare(whole, part);
        assert_true(restart_number(whole, "loading_wall_time") == time);
        assert_true(restart_number(whole, "loading_processor_time") == processor);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

#endif
