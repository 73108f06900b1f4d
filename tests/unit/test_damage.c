/// Damaged files: what is hit is named and left out, everything else goes on.
#include "testing.h"

#include "base/notes.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "io_sample.h"
#include "io_scratch.h"
#include "state_bits.h"

/// Frames of HDF5, which has no frame pointers, are seen by the suppression in leaks.supp. Exported, else the sanitizer
/// does not see it.
SCREE_API const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "fast_unwind_on_malloc=0";
}

enum { BODIES = 24, SNAPSHOTS = 3, CASE = 77, FLIPS = 120 };

static void sample(scree_state *state, uint64_t seed)
{
    assert_int_equal(sample_state(state, BODIES, seed, NULL), SCREE_OK);
    assert_int_equal(sample_loop(state, 10, NULL), SCREE_OK);
    assert_int_equal(sample_contacts(state, 20, NULL), SCREE_OK);
}

static void write_snapshot(int64_t index)
{
    const scree_config config = {.name = (char[]){"sample"}};
    const scree_model model = sample_model(&config);
    scree_error error;
    scree_state state;
    scree_contact_table table;
    sample(&state, (uint64_t)index);
    check(sample_table(&state, &table, &error), &error);
    const scree_snapshot_info info = {.index = index,
                                      .time = (double)index,
                                      .axial_strain = 0.01,
                                      .stage = "compress",
                                      .restartable = true,
                                      .case_checksum = CASE};
    check(scree_snapshot_write(scratch, &model, &state, &table, &info, &error), &error);
    scree_release(&table.contact);
    scree_state_destroy(&state);
}

static void write_checkpoint(uint64_t seed)
{
    scree_error error;
    scree_state state;
    sample(&state, seed);
    check(scree_checkpoint_write(scratch, &state, CASE, &error), &error);
    scree_state_destroy(&state);
}

/// Snapshots 0, 1, 2 and checkpoints of the seeds 10 and 11.
static void write_all(void)
{
    for (int64_t k = 0; k < SNAPSHOTS; k++) write_snapshot(k);
    write_checkpoint(10);
    write_checkpoint(11);
}

/// The state of a point that must be that of `seed`; 0: it may also be refused. Returns whether it was.
static bool reads_as(const scree_restart_point *point, uint64_t seed, bool must)
{
    scree_error error = {0};
    scree_state state, expected;
    bool another;
    const scree_restart_wanted wanted = {.dimension = 2, .case_checksum = CASE};
    scree_status status = scree_restart_point_read(scratch, point, &wanted, &state, &another, &error);
    if (status && must) fail_msg("%s", error.message);
    if (status) return false;
    sample(&expected, seed);
    assert_true(state_bits(&state) == state_bits(&expected));
    scree_state_destroy(&expected);
    scree_state_destroy(&state);
    return true;
}

static void path_of(const char *name, char path[128])
{
    (void)snprintf(path, 128, "%s/%s", scratch, name);
}

static void rewind_all(scree_notes *notes)
{
    const scree_kept all = SCREE_KEEP_ALL;
    scree_error error;
    *notes = (scree_notes){0};
    check(scree_run_file_rewind(scratch, "sample", &all, notes, &error), &error);
}

static size_t count_snapshots(void)
{
    size_t count;
    scree_error error;
    check(scree_snapshot_count(scratch, &count, &error), &error);
    return count;
}

/// Any byte of a run.h5 that holds links only: a restart reads both checkpoints all the same, and writes it anew.
static void links_are_not_needed(void **unused)
{
    (void)unused;
    char path[128];
    scree_notes notes;
    write_all();
    path_of("run.h5", path);
    long size = file_size(path);
    for (long place = 0; place < size; place += 61) {
        scree_error error = {0};
        scree_state state;
        assert_true(file_flip(path, place, (int)(place % 8)));
        check(scree_checkpoint_read(scratch, 2, &state, CASE, &error), &error);
        assert_string_equal(error.message, "");
        scree_state_destroy(&state);
        rewind_all(&notes);
        if (!strstr(notes.text, "run.h5' is damaged")) fail_msg("place %ld: '%s'", place, notes.text);
        assert_int_equal(count_snapshots(), SNAPSHOTS);
        rewind_all(&notes);
        assert_string_equal(notes.text, "");
    }
    // The next checkpoint repairs it, too, and the end of the run.
    assert_int_equal(truncate(path, 100), 0);
    write_checkpoint(12);
    assert_int_equal(count_snapshots(), SNAPSHOTS);
    assert_int_equal(truncate(path, 0), 0);
    assert_int_equal(scree_run_file_finish(scratch, NULL, NULL), SCREE_OK);
    assert_int_equal(count_snapshots(), SNAPSHOTS);
}

static void a_damaged_part_costs_itself(void **unused)
{
    (void)unused;
    for (int finish = 0; finish < 2; finish++) {
        char part[128], aside[144];
        scree_notes notes = {0};
        scree_error error;
        write_all();
        path_of("parts/snapshot-000001.h5", part);
        (void)snprintf(aside, sizeof aside, "%s.damaged", part);
        assert_true(file_flip(part, file_size(part) / 2, 3));
        if (finish)
            check(scree_run_file_finish(scratch, &notes, &error), &error);
        else
            rewind_all(&notes);
        assert_non_null(strstr(notes.text, "snapshot 1 is damaged and left out"));
        assert_true(file_size(part) == -1 && file_size(aside) > 0);
        assert_int_equal(count_snapshots(), SNAPSHOTS - 1);
        const scree_restart_point kept = {.snapshot = true, .index = 2, .part = !finish};
        assert_true(reads_as(&kept, 2, true));
        assert_int_equal(unlink(aside), 0);
        const scree_kept checkpoints = {.last_checkpoint = INT64_MAX};
        assert_int_equal(scree_run_file_rewind(scratch, NULL, &checkpoints, NULL, NULL), SCREE_OK);
    }
}

/// The older checkpoint serves when the newest is damaged, then a snapshot; the damaged ones never come back.
static void what_serves_in_their_place(void **unused)
{
    (void)unused;
    write_all();
    static const char *const parts[] = {"parts/checkpoint-000001.h5", "parts/checkpoint-000000.h5"};
    static const char *const words[] = {"checkpoint 0 is used", "snapshot 2 is used"};
    const uint64_t steps[] = {1234 + 10, 1234 + 2};
    for (int k = 0; k < 2; k++) {
        char path[128];
        scree_error error = {0};
        scree_state state;
        path_of(parts[k], path);
        assert_int_equal(truncate(path, 1000), 0);
        check(scree_checkpoint_read(scratch, 2, &state, CASE, &error), &error);
        assert_non_null(strstr(error.message, words[k]));
        assert_int_equal(state.step, steps[k]);
        scree_state_destroy(&state);
    }
    scree_notes notes;
    rewind_all(&notes);
    assert_non_null(strstr(notes.text, "checkpoint 0 is damaged"));
    assert_non_null(strstr(notes.text, "checkpoint 1 is damaged"));
}

/// One flipped bit anywhere in a finished run.h5: each snapshot and checkpoint is read as it was written, or refused
/// and left out with a note; most flips cost one of them at most, those in what they have in common may cost all.
static void any_bit_of_a_finished_run(void **unused)
{
    (void)unused;
    char path[128], kept[128], copy[320], extra[128];
    int hit[SNAPSHOTS + 3] = {0};
    path_of("run.h5", path);
    path_of("kept.h5", kept);
    path_of("run.h5.damaged", extra);
    write_all();
    assert_int_equal(scree_run_file_finish(scratch, NULL, NULL), SCREE_OK);
    assert_int_equal(rename(path, kept), 0);
    long size = file_size(kept);
    (void)snprintf(copy, sizeof copy, "cp %s %s", kept, path);
    for (long flip = 0; flip < FLIPS; flip++) {
        scree_notes notes;
        scree_restart_points points;
        scree_error error;
        size_t lost = 0;
        const scree_kept nothing = {.first_checkpoint = 1};
        (void)unlink(extra);
        check(scree_run_file_rewind(scratch, "sample", &nothing, NULL, &error), &error);
        assert_int_equal(system(copy), 0);
        long place = (long)((double)(size - 17) * (double)flip / FLIPS) + flip % 7;
        assert_true(file_flip(path, place, (int)(flip % 8)));
        check(scree_restart_points_list(scratch, &points, &error), &error);
        for (size_t k = 0; k < points.count; k++)
            lost += !reads_as(&points.point[k], (uint64_t)points.point[k].index + (points.point[k].snapshot ? 0 : 10),
                              false);
        rewind_all(&notes);
        if (points.run.status) lost = SNAPSHOTS + 2;
        if (lost == 0 && !strstr(notes.text, "is damaged")) fail_msg("place %ld: '%s'", place, notes.text);
        if (lost > 0 && (!strstr(notes.text, "is damaged") || file_size(extra) < 0))
            fail_msg("place %ld: '%s'", place, notes.text);
        hit[lost < SNAPSHOTS + 2 ? lost : SNAPSHOTS + 2]++;
        for (size_t k = 0; k < points.count && !points.run.status; k++) points.point[k].part = true;
        size_t left = 0;
        for (size_t k = 0; k < points.count && !points.run.status; k++)
            left += reads_as(&points.point[k], (uint64_t)points.point[k].index + (points.point[k].snapshot ? 0 : 10),
                             false);
        // Damage may lie in what a restart does not read, too.
        if (!points.run.status && left + (lost > 0 ? lost : 1) < points.count)
            fail_msg("place %ld: %zu are left", place, left);
        scree_restart_points_destroy(&points);
    }
    print_message("of %d flips %d cost nothing, %d one, %d two to four, %d all\n", (int)FLIPS, hit[0], hit[1],
                  hit[2] + hit[3] + hit[4], hit[5]);
    assert_true(hit[0] + hit[1] > FLIPS * 9 / 10);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(links_are_not_needed),
        WITH_SCRATCH(a_damaged_part_costs_itself),
        WITH_SCRATCH(what_serves_in_their_place),
        WITH_SCRATCH(any_bit_of_a_finished_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
