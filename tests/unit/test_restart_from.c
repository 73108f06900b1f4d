/// Going on from every snapshot of a run, and from folders with damage: the same last state, rows and snapshots.
#include "run_fixture.h"

#include "io/run_file.h"
#include "io_scratch.h"
#include "restart_cases.h"

#include <stdlib.h>

enum { OVERRIDES = 2 };
static const char *const overrides[RESTART_CASES][OVERRIDES] = {
    {"output.snapshots=3", "stages.deform.strain=0.1 %"},
    {"output.snapshots=2", "stages.deform.strain=0.03 %"},
    {"output.snapshots=2", "stages.compress.strain=0.3 %"},
    {"output.snapshots=2", "stages.deform.strain=3 %"},
};
static const scree_run_options whole_run = {.output = "whole", .threads = 1, .force = true};

static void command(const char *text)
{
    if (system(text) != 0) fail_msg("%s", text);
}

static size_t count_snapshots(const char *folder)
{
    size_t count;
    scree_error error;
    check(scree_snapshot_count(folder, &count, &error), &error);
    return count;
}

/// part/ has become what whole/ is.
static void compare_folders(void)
{
    run_compare("whole", "part");
    command("cmp whole/series.csv part/series.csv");
    size_t count = count_snapshots("whole");
    assert_int_equal(count_snapshots("part"), count);
    for (size_t k = 0; k < count; k++) {
        scree_snapshot a, b;
        scree_error error;
        check(scree_snapshot_read("whole", k, &a, &error), &error);
        check(scree_snapshot_read("part", k, &b, &error), &error);
        assert_int_equal(a.index, b.index);
        assert_true(a.time == b.time && a.count == b.count && a.contact_count == b.contact_count);
        assert_memory_equal(a.x, b.x, a.count * sizeof *a.x);
        assert_memory_equal(a.normal_force, b.normal_force, a.contact_count * sizeof *a.normal_force);
        scree_snapshot_destroy(&a);
        scree_snapshot_destroy(&b);
    }
}

static void every_snapshot_of_a_finished_run(void **unused)
{
    (void)unused;
    for (int k = 0; k < RESTART_CASES; k++) {
        scree_error error;
        scree_case *c = case_read(restart_cases[k], overrides[k], OVERRIDES);
        check(scree_run(c, &whole_run, &error), &error);
        size_t count = count_snapshots("whole");
        assert_true(count >= 4);
        for (size_t from = 0; from <= count; from++) {
            char number[32] = "latest";
            if (from < count) (void)snprintf(number, sizeof number, "%zu", from);
            command("rm -rf part && cp -r whole part");
            const scree_run_options options = {.threads = 1 + (int)(from % 2), .from = number};
            check(scree_restart("part", &options, &error), &error);
            compare_folders();
        }
        scree_case_free(c);
    }
}

/// Stops with checkpoints and snapshots behind it.
static scree_case *interrupted(void)
{
    scree_error error;
    run_stop stopping = {.at = "stage confine ended"};
    const char *const more[] = {"output.snapshots=3", "stages.deform.strain=0.1 %", "output.checkpoint_steps=200"};
    scree_case *c = case_read(restart_cases[0], more, 3);
    check(scree_run(c, &whole_run, &error), &error);
    scree_run_options options = {.output = "part",
                                 .threads = 1,
                                 .force = true,
                                 .stop = &stopping.stop,
                                 .message = run_stop_at,
                                 .user = &stopping};
    assert_int_equal(scree_run(c, &options, &error), SCREE_INTERRUPTED);
    return c;
}

static void an_earlier_snapshot_drops_what_came_after(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = interrupted();
    volatile int stop = 1;
    scree_run_options options = {.threads = 1, .from = "0", .stop = &stop};
    assert_int_equal(scree_restart("part", &options, &error), SCREE_INTERRUPTED);
    assert_int_equal(count_snapshots("part"), 1);
    assert_non_null(strstr(error.message, "interrupted at step 0"));
    // What follows goes on from there by itself.
    options = (scree_run_options){.threads = 1};
    check(scree_restart("part", &options, &error), &error);
    compare_folders();
    scree_case_free(c);
}

static void wrong_points_are_refused(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = interrupted();
    static const char *const wrong[] = {"17", "-1", "1x", ""};
    for (size_t k = 0; k < 4; k++) {
        const scree_run_options options = {.threads = 1, .from = wrong[k]};
        assert_int_equal(scree_restart("part", &options, &error), SCREE_ERROR_INPUT);
        assert_non_null(strstr(error.message, k == 0 ? "there is no snapshot 17" : "is no snapshot"));
    }
    scree_case_free(c);
}

static bool log_holds(const char *words)
{
    char text[256];
    (void)snprintf(text, sizeof text, "grep -q '%s' part/log.txt", words);
    return system(text) == 0;
}

/// Damage in run.h5, in an old snapshot, in the newest checkpoint, and all of it.
static void damage_is_named_at_the_begin_and_left_out(void **unused)
{
    (void)unused;
    scree_case *c = interrupted();
    command("cp -r part kept");
    static const struct {
        const char *damage, *words;
        int lost;
    } cases[] = {
        {"truncate -s -20 part/run.h5", "run.h5. is damaged", 0},
        {"truncate -s -20 part/parts/snapshot-000000.h5", "snapshot 0 is damaged and left out", 1},
        {"for f in part/parts/checkpoint-*; do last=$f; done; truncate -s -20 $last", "is used: ", 0},
        {"truncate -s -20 part/parts/checkpoint-*", "snapshot 1 is used", 0},
        {"rm part/parts/checkpoint-*", "goes on from snapshot 1", 0},
        {"truncate -s -20 part/run.h5 part/parts/checkpoint-* part/parts/snapshot-000001.h5", "snapshot 0 is used", 0},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scree_error error;
        command("rm -rf part && cp -r kept part");
        command(cases[k].damage);
        const scree_run_options options = {.threads = 1};
        check(scree_restart("part", &options, &error), &error);
        if (!log_holds(cases[k].words)) fail_msg("%s: the log does not say '%s'", cases[k].damage, cases[k].words);
        assert_int_equal(count_snapshots("part") + (size_t)cases[k].lost, count_snapshots("whole"));
        run_compare("whole", "part");
        command("cmp whole/series.csv part/series.csv");
    }
    scree_case_free(c);
}

/// Rows that a checkpoint counts on are gone: the older one is used, and what cannot be used any more never comes back.
static void missing_rows_make_an_older_one_serve(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = interrupted();
    const scree_run_options options = {.threads = 1};
    command("head -n -1 part/series.csv > cut && mv cut part/series.csv");
    check(scree_restart("part", &options, &error), &error);
    assert_true(log_holds("rows, the checkpoint was taken after"));
    compare_folders();
    command("rm -rf part && cp -r whole part && head -n 1 whole/series.csv > part/series.csv");
    assert_int_equal(scree_restart("part", &options, &error), SCREE_OK); // from the snapshot before any row
    compare_folders();
    command("rm -rf part && cp -r whole part && rm part/series.csv");
    assert_int_equal(scree_restart("part", &options, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "series.csv"));
    scree_case_free(c);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(every_snapshot_of_a_finished_run),
        IN_SCRATCH(an_earlier_snapshot_drops_what_came_after),
        IN_SCRATCH(wrong_points_are_refused),
        IN_SCRATCH(damage_is_named_at_the_begin_and_left_out),
        IN_SCRATCH(missing_rows_make_an_older_one_serve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
