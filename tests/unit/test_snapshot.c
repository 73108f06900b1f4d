/// Snapshots and run.h5: what is written comes back, from a run that goes on and from one that has ended; kills, full
/// disks, damage and restarts lose nothing.
#include "state/plates.h"
#include "testing.h"

#include "io/run_file.h"
#include "io/snapshot.h"
#include "io_sample.h"
#include "io_scratch.h"

#include <sys/wait.h>
#include <time.h>

enum { BODIES = 24, LOOP = 10 };

/// The sample of `seed` as snapshot `index`.
static scree_status try_write(int64_t index, uint64_t seed, scree_error *error)
{
    char name[] = "s\xc3\xa4mple";
    const scree_config config = {.name = name};
    const scree_model model = sample_model(&config);
    scree_state state;
    scree_contact_table table = {0};
    scree_status status = sample_state(&state, BODIES, seed, error);
    if (!status) status = sample_loop(&state, LOOP, error);
    if (!status) status = sample_table(&state, &table, error);
    const scree_snapshot_info info = {
        .index = index, .time = 0.5 + (double)seed, .axial_strain = 0.01 * (double)seed, .stage = "compress"};
    if (!status) status = scree_snapshot_write(scratch, &model, &state, &table, &info, error);
    scree_release(&table.contact);
    scree_state_destroy(&state);
    return status;
}

static void write_snapshot(int64_t index, uint64_t seed)
{
    scree_error error;
    if (try_write(index, seed, &error)) fail_msg("%s", error.message);
}

static size_t count_snapshots(void)
{
    size_t count;
    scree_error error;
    if (scree_snapshot_count(scratch, &count, &error)) fail_msg("%s", error.message);
    return count;
}

/// Snapshot number `which` must have the number `index` and be the sample of `seed`.
static void assert_snapshot(size_t which, int64_t index, uint64_t seed)
{
    scree_snapshot snapshot;
    scree_error error;
    scree_state state;
    if (scree_snapshot_read(scratch, which, &snapshot, &error)) fail_msg("%s", error.message);
    assert_int_equal(sample_state(&state, BODIES, seed, NULL), SCREE_OK);
    assert_int_equal(snapshot.index, index);
    assert_int_equal(snapshot.count, BODIES);
    assert_true(snapshot.time == 0.5 + (double)seed);
    assert_true(snapshot.axial_strain == 0.01 * (double)seed);
    assert_string_equal(snapshot.stage, "compress");
    const scree_config config = {0};
    const scree_model model = sample_model(&config);
    for (size_t id = 0; id < BODIES; id++) {
        size_t row = state.row_of_id[id];
        scree_vector velocity, spin;
        scree_body_velocity(&model, &state, row, velocity, spin);
        assert_true(snapshot.x[id] == state.row[row].x && snapshot.y[id] == state.row[row].y);
        assert_true(snapshot.radius[id] == state.row[row].radius && snapshot.angle[id] == state.angle[row]);
        assert_true(snapshot.vx[id] == velocity[0] && snapshot.vy[id] == velocity[1] && snapshot.spin[id] == spin[2]);
    }
    assert_int_equal(snapshot.contact_count, BODIES);
    for (uint32_t k = 0; k < BODIES; k++) {
        bool wall = k + 1 == BODIES;
        assert_int_equal(snapshot.first[k], wall ? 0 : k);
        assert_int_equal(snapshot.second[k], wall ? SCREE_WALL_ID + SCREE_WALL_BOTTOM : k + 1);
        assert_true(snapshot.normal_force[k] == 3.0 + k && snapshot.tangential_force[k] == -1.0 - k);
        assert_true(snapshot.contact_x[k] == 1e-3 * k && snapshot.contact_y[k] == 2e-3);
    }
    assert_int_equal(snapshot.loop_count, LOOP);
    for (uint32_t k = 0; k < LOOP; k++) assert_int_equal(snapshot.loop[k], k);
    assert_memory_equal(snapshot.wall, scree_plates(&state), sizeof scree_plates(&state));
    scree_snapshot_destroy(&snapshot);
    scree_state_destroy(&state);
}

static void run_path(char *path, size_t size)
{
    assert_int_equal(scree_run_file_path(scratch, path, size, NULL), 0);
}

/// What a run that goes on does first: keeps the first `count` snapshots, and every checkpoint.
static scree_status try_rewind(int64_t count, scree_error *error)
{
    const scree_kept kept = {.snapshots = count, .last_checkpoint = INT64_MAX};
    return scree_run_file_rewind(scratch, NULL, &kept, NULL, error);
}

static void finish(void)
{
    scree_error error;
    if (scree_run_file_finish(scratch, NULL, &error)) fail_msg("%s", error.message);
}

// ---- content -----------------------------------------------------------------------------------------------------

static void what_is_written_comes_back(void **unused)
{
    (void)unused;
    for (int64_t k = 0; k < 4; k++) write_snapshot(k, (uint64_t)k + 1);
    for (int ended = 0; ended < 2; ended++) {
        assert_int_equal(count_snapshots(), 4);
        for (size_t k = 0; k < 4; k++) assert_snapshot(k, (int64_t)k, k + 1);
        finish();
    }
}

/// Counts datasets, and those whose `unit` or `description` is missing or empty.
typedef struct visited {
    int datasets, bare;
} visited;

static herr_t visit_one(hid_t file, const char *name, const H5O_info_t *information, void *data)
{
    visited *all = data;
    if (information->type != H5O_TYPE_DATASET) return 0;
    all->datasets++;
    scree_hdf5 access = {.file = file, .path = ""};
    char unit[64], description[256];
    scree_hdf5_get_text(&access, name, "unit", unit, sizeof unit);
    scree_hdf5_get_text(&access, name, "description", description, sizeof description);
    all->bare += access.status || !unit[0] || strlen(description) < 4;
    return 0;
}

static void every_dataset_tells_its_unit_and_meaning(void **unused)
{
    (void)unused;
    char path[256], text[512];
    scree_state state;
    scree_hdf5 run;
    visited all = {0};
    write_snapshot(0, 1);
    assert_int_equal(sample_state(&state, BODIES, 1, NULL), SCREE_OK);
    assert_int_equal(scree_checkpoint_write(scratch, &state, 1, NULL), SCREE_OK);
    scree_state_destroy(&state);
    finish();
    run_path(path, sizeof path);
    scree_hdf5_open(&run, path, NULL);
    assert_true(H5Ovisit(run.file, H5_INDEX_NAME, H5_ITER_INC, visit_one, &all) >= 0);
    scree_hdf5_get_text(&run, "/", "program", text, sizeof text);
    assert_non_null(strstr(text, "Scree"));
    scree_hdf5_get_text(&run, "/", "case", text, sizeof text);
    assert_string_equal(text, "s\xc3\xa4mple");
    scree_hdf5_get_text(&run, "/", "conventions", text, sizeof text);
    assert_non_null(strstr(text, "tension positive"));
    assert_int_equal(scree_hdf5_close(&run), SCREE_OK);
    int stored = 0;
    const scree_state any = {.dimension = 2}; // like the sample's, of no law
    for (size_t k = 0; k < scree_field_total(); k++) stored += scree_field_is_stored(&any, scree_field_at(k));
    // 9 fields and 5 results of bodies, 14 of contacts, 6 of the loop, 8 of plates, 5 of walls, 8 of the cell; the
    // tables without derived fields.
    assert_int_equal(all.datasets, 9 + 5 + 14 + 6 + 8 + 5 + 8 + stored);
    assert_int_equal(all.bare, 0);
}

static void an_empty_scene_is_written_too(void **unused)
{
    (void)unused;
    const scree_config config = {0};
    const scree_model model = sample_model(&config);
    scree_state state;
    scree_contact_table table = {0};
    scree_snapshot snapshot;
    const scree_snapshot_info info = {.index = 0, .axial_strain = (double)NAN, .stage = "prepare"};
    assert_int_equal(scree_state_create(&state, 2, 0, NULL), SCREE_OK);
    assert_int_equal(scree_snapshot_write(scratch, &model, &state, &table, &info, NULL), SCREE_OK);
    assert_int_equal(scree_snapshot_read(scratch, 0, &snapshot, NULL), SCREE_OK);
    assert_int_equal(snapshot.count + snapshot.contact_count + snapshot.loop_count, 0);
    assert_true(isnan(snapshot.axial_strain));
    scree_snapshot_destroy(&snapshot);
    scree_state_destroy(&state);
}

static void a_missing_snapshot_is_an_error(void **unused)
{
    (void)unused;
    scree_snapshot snapshot;
    scree_error error;
    size_t count;
    assert_int_equal(scree_snapshot_count(scratch, &count, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "run.h5"));
    write_snapshot(0, 1);
    assert_int_equal(scree_snapshot_read(scratch, 1, &snapshot, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "holds 1 snapshots"));
    scree_snapshot_destroy(&snapshot);
}

// ---- the end of a run and what follows it ------------------------------------------------------------------------

static void a_finished_run_is_one_file(void **unused)
{
    (void)unused;
    char path[256], moved[256], part[256];
    for (int64_t k = 0; k < 3; k++) write_snapshot(k, (uint64_t)k);
    assert_int_equal(scree_part_path(scratch, SCREE_PART_SNAPSHOT, 1, part, sizeof part, NULL), SCREE_OK);
    assert_true(file_size(part) > 0);
    finish();
    assert_int_equal(file_size(part), -1);
    (void)snprintf(moved, sizeof moved, "%s/parts", scratch);
    assert_int_equal(file_size(moved), -1);
    run_path(path, sizeof path);
    long size = file_size(path);
    finish();
    assert_int_equal(file_size(path), size);
    // Somewhere else, alone, it is still whole.
    char old[64];
    memcpy(old, scratch, sizeof old);
    assert_true(scratch_create(scratch));
    run_path(moved, sizeof moved);
    assert_int_equal(rename(path, moved), 0);
    for (size_t k = 0; k < 3; k++) assert_snapshot(k, (int64_t)k, k);
    scratch_destroy(old);
}

static void a_run_without_snapshots_finishes(void **unused)
{
    (void)unused;
    finish();
    assert_int_equal(count_snapshots(), 0);
}

/// A kill after the new run.h5 has been put in place and some of the parts have been removed.
static void a_killed_finish_is_repeated(void **unused)
{
    (void)unused;
    char part[256], aside[256];
    for (int64_t k = 0; k < 3; k++) write_snapshot(k, (uint64_t)k);
    assert_int_equal(scree_part_path(scratch, SCREE_PART_SNAPSHOT, 1, part, sizeof part, NULL), SCREE_OK);
    (void)snprintf(aside, sizeof aside, "%s/aside", scratch);
    assert_int_equal(link(part, aside), 0);
    finish();
    assert_int_equal(scree_parts_folder_make(scratch, NULL), SCREE_OK);
    assert_int_equal(rename(aside, part), 0);
    for (int times = 0; times < 2; times++) {
        assert_int_equal(count_snapshots(), 3);
        for (size_t k = 0; k < 3; k++) assert_snapshot(k, (int64_t)k, k);
        finish();
        assert_int_equal(file_size(part), -1);
    }
}

static void a_restart_drops_later_snapshots(void **unused)
{
    (void)unused;
    for (int ended = 0; ended < 2; ended++) {
        for (int64_t k = 0; k < 5; k++) write_snapshot(k, (uint64_t)k);
        if (ended) finish();
        assert_int_equal(try_rewind(3, NULL), SCREE_OK);
        assert_int_equal(count_snapshots(), 3);
        write_snapshot(3, 9);
        assert_int_equal(count_snapshots(), 4);
        for (size_t k = 0; k < 3; k++) assert_snapshot(k, (int64_t)k, k);
        assert_snapshot(3, 3, 9);
    }
    assert_int_equal(try_rewind(0, NULL), SCREE_OK);
    assert_int_equal(count_snapshots(), 0);
}

static void a_finished_run_can_go_on(void **unused)
{
    (void)unused;
    for (int64_t k = 0; k < 3; k++) write_snapshot(k, (uint64_t)k);
    finish();
    write_snapshot(3, 3);
    assert_int_equal(count_snapshots(), 4);
    for (size_t k = 0; k < 4; k++) assert_snapshot(k, (int64_t)k, k);
    finish();
    for (size_t k = 0; k < 4; k++) assert_snapshot(k, (int64_t)k, k);
}

// ---- full disks, kills, damage, memory ---------------------------------------------------------------------------

static void a_full_disk_loses_nothing(void **unused)
{
    (void)unused;
    char path[256];
    scree_error error;
    for (int64_t k = 0; k < 6; k++) write_snapshot(k, (uint64_t)k);
    run_path(path, sizeof path);
    assert_true(disk_limit(4096));
    assert_int_equal(try_write(6, 6, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "snapshot-000006.h5': File too large"));
    // Room for the gathered head, not for the snapshots; then for all but the last bytes.
    const rlim_t rooms[] = {12000, 6 * 12000};
    for (size_t k = 0; k < 2; k++) {
        assert_true(disk_limit(rooms[k]));
        assert_int_equal(scree_run_file_finish(scratch, NULL, &error), SCREE_ERROR_IO);
        assert_non_null(strstr(error.message, "run.h5.whole': File too large"));
    }
    assert_true(disk_limit(RLIM_INFINITY));
    assert_int_equal(count_snapshots(), 6);
    for (size_t k = 0; k < 6; k++) assert_snapshot(k, (int64_t)k, k);
    finish();
    // The space that is asked for in advance was enough, and is given back.
    assert_true(file_size(path) > 6 * 12000 && file_size(path) < 6 * 40000);
    for (size_t k = 0; k < 6; k++) assert_snapshot(k, (int64_t)k, k);
}

/// Writes snapshots, checkpoints and the end of a run over and over, until it is killed.
static _Noreturn void write_for_ever(void)
{
    scree_state state;
    scree_error error;
    bool good = sample_state(&state, BODIES, 1, NULL) == SCREE_OK;
    for (int64_t k = 0; good; k = (k + 1) % 7) {
        if (k == 0) good = try_rewind(2, &error) == SCREE_OK;
        good = good && try_write(2 + k, (uint64_t)k, &error) == SCREE_OK;
        good = good && scree_checkpoint_write(scratch, &state, 1, &error) == SCREE_OK;
        if (k % 3 == 2) good = good && scree_run_file_finish(scratch, NULL, &error) == SCREE_OK;
    }
    _exit(1);
}

static void a_kill_at_any_moment_leaves_a_readable_file(void **unused)
{
    (void)unused;
    write_snapshot(0, 100);
    write_snapshot(1, 101);
    for (int kill_number = 0; kill_number < 20; kill_number++) {
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) write_for_ever();
        uint32_t words[4];
        scree_random_words(1, SCREE_RANDOM_TEST, (uint64_t)kill_number, words);
        const struct timespec pause = {0, (long)(words[0] % 40000000)};
        (void)nanosleep(&pause, NULL);
        assert_int_equal(kill(child, SIGKILL), 0);
        int how = 0;
        assert_int_equal(waitpid(child, &how, 0), child);
        assert_true(WIFSIGNALED(how));
        // The first two are never touched; all others are whole, whichever they are.
        size_t count = count_snapshots();
        assert_true(count >= 2);
        assert_snapshot(0, 0, 100);
        assert_snapshot(1, 1, 101);
        for (size_t k = 2; k < count; k++) assert_snapshot(k, (int64_t)k, k - 2);
        scree_state state;
        scree_error error = {0};
        scree_status status = scree_checkpoint_read(scratch, 2, &state, 1, &error);
        if (status == SCREE_OK) assert_string_equal(error.message, "");
        if (status != SCREE_OK) assert_non_null(strstr(error.message, "there is no checkpoint"));
        scree_state_destroy(&state);
    }
}

/// A contact with a body that does not exist is refused, so that a figure may index with ids.
static void impossible_ids_are_refused(void **unused)
{
    (void)unused;
    char path[256];
    scree_error error;
    scree_snapshot snapshot;
    scree_hdf5 run;
    const uint32_t values[] = {BODIES, SCREE_WALL_ID + SCREE_WALL_COUNT};
    write_snapshot(0, 1);
    finish();
    run_path(path, sizeof path);
    for (size_t k = 0; k < 2; k++) {
        uint32_t second[BODIES] = {0};
        second[5] = values[k];
        scree_hdf5_extend(&run, path, NULL);
        hid_t dataset = H5Dopen2(run.file, "/snapshots/000000/contacts/second", H5P_DEFAULT);
        assert_true(H5Dwrite(dataset, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, second) >= 0);
        assert_true(H5Dclose(dataset) >= 0);
        assert_int_equal(scree_hdf5_close(&run), SCREE_OK);
        assert_int_equal(scree_snapshot_read(scratch, 0, &snapshot, &error), SCREE_ERROR_IO);
        assert_non_null(strstr(error.message, "does not exist"));
    }
}

static scree_status read_first(scree_error *error)
{
    scree_snapshot snapshot;
    scree_status status = scree_snapshot_read(scratch, 0, &snapshot, error);
    scree_snapshot_destroy(&snapshot);
    return status;
}

static scree_status write_first(scree_error *error)
{
    return try_write(0, 1, error);
}
static scree_status rewind_two(scree_error *error)
{
    return try_rewind(2, error);
}
static scree_status finish_all(scree_error *error)
{
    scree_status status = try_write(1, 2, error);
    return status ? status : scree_run_file_finish(scratch, NULL, error);
}

static void failed_allocations(void **unused)
{
    (void)unused;
    scree_status (*const actions[])(scree_error *) = {write_first, read_first, finish_all, rewind_two};
    for (size_t a = 0; a < sizeof actions / sizeof *actions; a++) {
        uint64_t n = 1;
        for (bool reached = true; reached; n++) {
            size_t before, after;
            scree_error error = {0};
            scree_allocation_statistics(&before, NULL);
            (void)scree_allocation_fail_after(n);
            scree_status status = actions[a](&error);
            reached = scree_allocation_fail_after(0) >= n;
            scree_allocation_statistics(&after, NULL);
            assert_int_equal(before, after);
            if (!reached && status) fail_msg("%s", error.message);
            if (reached && !status) fail_msg("allocation %llu of action %zu failed unseen", (unsigned long long)n, a);
            if (reached && !strstr(error.message, "out of memory")) fail_msg("%s", error.message);
        }
        // The last round failed nowhere.
        if (n < 4) fail_msg("action %zu made %llu allocations", a, (unsigned long long)n - 2);
    }
    assert_snapshot(0, 0, 1);
    assert_snapshot(1, 1, 2);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(what_is_written_comes_back),
        WITH_SCRATCH(every_dataset_tells_its_unit_and_meaning),
        WITH_SCRATCH(an_empty_scene_is_written_too),
        WITH_SCRATCH(a_missing_snapshot_is_an_error),
        WITH_SCRATCH(a_finished_run_is_one_file),
        WITH_SCRATCH(a_run_without_snapshots_finishes),
        WITH_SCRATCH(a_killed_finish_is_repeated),
        WITH_SCRATCH(a_restart_drops_later_snapshots),
        WITH_SCRATCH(a_finished_run_can_go_on),
        WITH_SCRATCH(a_full_disk_loses_nothing),
        WITH_SCRATCH(a_kill_at_any_moment_leaves_a_readable_file),
        WITH_SCRATCH(impossible_ids_are_refused),
        WITH_SCRATCH(failed_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
