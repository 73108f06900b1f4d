/// Checkpoints: every bit comes back; what is damaged, foreign or missing is recognised and nothing is lost.
#include "testing.h"

#include "io/file_checksum.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "io_sample.h"
#include "io_scratch.h"
#include "measure/delaunay_boundary.h"
#include "state_bits.h"

enum { BODIES = 40, CASE = 77 };

/// A whole state whose every stored byte is random: many are NaN of all kinds, infinite, denormal or negative zero.
static void create_state(scree_state *state, uint64_t seed)
{
    assert_int_equal(sample_state(state, BODIES, seed, NULL), SCREE_OK);
    state->spent = (scree_time_spent){.run = 3.5 * (double)seed, .stage = 1.25, .processor = 2.5};
    assert_int_equal(sample_loop(state, 12, NULL), SCREE_OK);
    assert_int_equal(sample_contacts(state, 60, NULL), SCREE_OK);
    uint64_t counter = 0;
    for (size_t k = 1; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (!scree_field_exists(field, state->dimension)) continue;
        size_t size = (size_t)scree_components(field->components, state->dimension) * scree_field_size(field->type);
        for (size_t row = 0; row < scree_field_rows_count(state, field); row++)
            for (size_t b = 0; b < size; b += 4) {
                uint32_t words[4];
                scree_random_words(seed, SCREE_RANDOM_TEST, counter++, words);
                size_t left = size - b;
                memcpy((unsigned char *)scree_field_get_mutable(state, field, row) + b, words, left < 4 ? left : 4);
            }
    }
    state->step = seed;
    state->next_id = BODIES + 7; // some have been taken out
    assert_int_equal(scree_state_find_rows(state, NULL), SCREE_OK);
}

static void assert_same(const scree_state *a, const scree_state *b)
{
    assert_int_equal(state_bits(a), state_bits(b));
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->contact_count, b->contact_count);
    assert_int_equal(scree_loop_of(a)->count, scree_loop_of(b)->count);
    assert_memory_equal(&a->spent, &b->spent, sizeof a->spent);
    assert_memory_equal(a->row_of_id, b->row_of_id, a->id_count * sizeof *a->row_of_id);
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (!scree_field_exists(field, a->dimension)) continue;
        size_t size = (size_t)scree_components(field->components, a->dimension) * scree_field_size(field->type);
        for (size_t row = 0; row < scree_field_rows_count(a, field) && field->role == SCREE_FIELD_STATE; row++)
            assert_memory_equal(scree_field_get(a, field, row), scree_field_get(b, field, row), size);
    }
}

static void write_checkpoint(uint64_t seed)
{
    scree_state state;
    scree_error error = {0};
    create_state(&state, seed);
    if (scree_checkpoint_write(scratch, &state, CASE, &error)) fail_msg("%s", error.message);
    scree_state_destroy(&state);
}

/// Reads, and demands the state of `seed` (0: a failure with `status`). Returns the message.
static const char *read_checkpoint(uint64_t seed, scree_status status, uint64_t origin)
{
    static scree_error error;
    scree_state state, expected;
    scree_status found = scree_checkpoint_read(scratch, 2, &state, origin, &error);
    if (found != status) fail_msg("status %d, not %d: %s", found, status, error.message);
    if (seed) {
        create_state(&expected, seed);
        assert_same(&state, &expected);
        scree_state_destroy(&expected);
    } else {
        assert_null(state.row);
        assert_int_equal(state.count, 0);
    }
    scree_state_destroy(&state);
    return error.message;
}

static void checkpoint_path(int64_t index, char *path, size_t size)
{
    assert_int_equal(scree_part_path(scratch, SCREE_PART_CHECKPOINT, index, path, size, NULL), SCREE_OK);
}

static void every_bit_comes_back(void **unused)
{
    (void)unused;
    write_checkpoint(5);
    assert_string_equal(read_checkpoint(5, SCREE_OK, CASE), "");
}

static void a_state_without_contacts_and_boundary_comes_back(void **unused)
{
    (void)unused;
    scree_state state, copy;
    for (size_t count = 0; count < 2; count++) {
        assert_int_equal(sample_state(&state, count, 3, NULL), SCREE_OK);
        assert_int_equal(scree_checkpoint_write(scratch, &state, CASE, NULL), SCREE_OK);
        assert_int_equal(scree_checkpoint_read(scratch, 2, &copy, CASE, NULL), SCREE_OK);
        assert_same(&state, &copy);
        scree_state_destroy(&state);
        scree_state_destroy(&copy);
    }
}

static void the_newest_two_are_kept(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 5; seed++) write_checkpoint(seed);
    scree_part_list parts;
    assert_int_equal(scree_parts_list(scratch, SCREE_PART_CHECKPOINT, &parts, NULL), SCREE_OK);
    assert_int_equal(parts.count, 2);
    assert_int_equal(parts.index[0], 3);
    assert_int_equal(parts.index[1], 4);
    scree_part_list_destroy(&parts);
    assert_string_equal(read_checkpoint(5, SCREE_OK, CASE), "");
}

static void none_there(void **unused)
{
    (void)unused;
    assert_non_null(strstr(read_checkpoint(0, SCREE_ERROR_INPUT, CASE), "there is no checkpoint"));
}

static void another_case_is_refused(void **unused)
{
    (void)unused;
    write_checkpoint(1);
    write_checkpoint(2);
    assert_non_null(strstr(read_checkpoint(0, SCREE_ERROR_INPUT, CASE + 1), "is a checkpoint of another case"));
}

/// Rewrites an attribute of a checkpoint as if another build had written it.
static void set_attribute(int64_t index, const char *name, uint64_t value)
{
    char path[256], group[64];
    checkpoint_path(index, path, sizeof path);
    scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
    scree_hdf5 file;
    scree_hdf5_extend(&file, path, NULL);
    assert_true(H5Adelete_by_name(file.file, group, name, H5P_DEFAULT) >= 0);
    scree_hdf5_set_integer(&file, group, name, value);
    assert_int_equal(scree_hdf5_close(&file), SCREE_OK);
    assert_int_equal(scree_file_checksum_append(path, NULL), SCREE_OK);
}

static void another_version_is_refused(void **unused)
{
    (void)unused;
    write_checkpoint(1);
    set_attribute(0, "layout", 12345);
    assert_non_null(strstr(read_checkpoint(0, SCREE_ERROR_INPUT, CASE), "of another version of the state"));
}

static void the_older_one_is_used_when_the_newest_is_damaged(void **unused)
{
    (void)unused;
    char path[256];
    write_checkpoint(1);
    write_checkpoint(2);
    checkpoint_path(1, path, sizeof path);
    long size = file_size(path);
    // Cut at the end, in the middle, in the head, and to nothing.
    const long lengths[] = {size - 1, size / 2, 100, 0};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(truncate(path, lengths[k]), 0);
        const char *message = read_checkpoint(1, SCREE_OK, CASE);
        assert_non_null(strstr(message, "checkpoint 0 is used"));
        assert_non_null(strstr(message, "checkpoint-000001.h5"));
    }
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (int k = 0; k < 5000; k++) (void)fputc(k * 7919 % 251, file);
    assert_int_equal(fclose(file), 0);
    assert_non_null(strstr(read_checkpoint(1, SCREE_OK, CASE), "checkpoint 0 is used"));
    // The next one is written beside the damaged one.
    write_checkpoint(3);
    assert_string_equal(read_checkpoint(3, SCREE_OK, CASE), "");
}

static void no_whole_one_is_an_error(void **unused)
{
    (void)unused;
    char path[256];
    write_checkpoint(1);
    write_checkpoint(2);
    for (int64_t k = 0; k < 2; k++) {
        checkpoint_path(k, path, sizeof path);
        assert_int_equal(truncate(path, 1000), 0);
    }
    assert_non_null(strstr(read_checkpoint(0, SCREE_ERROR_IO, CASE), "can be used"));
}

/// Flips single bits all over a file, to its last byte: each one is found, and HDF5 is never given the file.
static void every_flipped_bit_is_found(void **unused)
{
    (void)unused;
    char path[256];
    write_checkpoint(1);
    checkpoint_path(0, path, sizeof path);
    long size = file_size(path);
    enum { FLIPS = 1500 };
    for (long k = 0; k <= FLIPS; k++) {
        long place = k * (size - 1) / FLIPS;
        int bit = (int)(k % 8);
        assert_true(file_flip(path, place, bit));
        assert_non_null(strstr(read_checkpoint(0, SCREE_ERROR_IO, CASE), "checksum does not match"));
        assert_true(file_flip(path, place, bit));
    }
    assert_string_equal(read_checkpoint(1, SCREE_OK, CASE), "");
}

static void a_full_disk_loses_nothing(void **unused)
{
    (void)unused;
    scree_state state;
    scree_error error;
    write_checkpoint(1);
    create_state(&state, 2);
    assert_true(disk_limit(4096));
    scree_status status = scree_checkpoint_write(scratch, &state, CASE, &error);
    assert_true(disk_limit(RLIM_INFINITY));
    scree_state_destroy(&state);
    assert_int_equal(status, SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "checkpoint-000001.h5"));
    assert_non_null(strstr(error.message, "File too large"));
    assert_string_equal(read_checkpoint(1, SCREE_OK, CASE), "");
    write_checkpoint(3);
    assert_string_equal(read_checkpoint(3, SCREE_OK, CASE), "");
}

static void a_finished_run_keeps_its_checkpoints(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 3; seed++) write_checkpoint(seed);
    assert_int_equal(scree_run_file_finish(scratch, NULL, NULL), SCREE_OK);
    char path[256];
    checkpoint_path(2, path, sizeof path);
    assert_int_equal(file_size(path), -1);
    assert_string_equal(read_checkpoint(3, SCREE_OK, CASE), "");
    write_checkpoint(4);
    assert_string_equal(read_checkpoint(4, SCREE_OK, CASE), "");
    assert_int_equal(file_size(path) > 0, true);
}

/// Every own allocation of writing and of reading fails once: an error, nothing lost, nothing leaked, and no older
/// checkpoint instead of the newest.
static void failed_allocations(void **unused)
{
    (void)unused;
    scree_state state, copy;
    size_t before, after;
    write_checkpoint(1);
    create_state(&state, 2);
    for (uint64_t n = 1;; n++) {
        scree_error error = {0};
        scree_allocation_statistics(&before, NULL);
        (void)scree_allocation_fail_after(n);
        scree_status status = scree_checkpoint_write(scratch, &state, CASE, &error);
        uint64_t made = scree_allocation_fail_after(0);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        if (made < n) break;
        if (!status) fail_msg("allocation %llu failed without an error", (unsigned long long)n);
        if (!strstr(error.message, "out of memory"))
            fail_msg("allocation %llu: %s", (unsigned long long)n, error.message);
    }
    assert_string_equal(read_checkpoint(2, SCREE_OK, CASE), "");
    for (uint64_t n = 1;; n++) {
        scree_error error = {0};
        scree_allocation_statistics(&before, NULL);
        (void)scree_allocation_fail_after(n);
        scree_status status = scree_checkpoint_read(scratch, 2, &copy, CASE, &error);
        uint64_t made = scree_allocation_fail_after(0);
        if (!status) assert_same(&copy, &state);
        if (!status) scree_state_destroy(&copy);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        if (made < n) break;
        if (!status) fail_msg("allocation %llu failed without an error", (unsigned long long)n);
        if (!strstr(error.message, "out of memory"))
            fail_msg("allocation %llu: %s", (unsigned long long)n, error.message);
    }
    scree_state_destroy(&state);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(every_bit_comes_back),
        WITH_SCRATCH(a_state_without_contacts_and_boundary_comes_back),
        WITH_SCRATCH(the_newest_two_are_kept),
        WITH_SCRATCH(none_there),
        WITH_SCRATCH(another_case_is_refused),
        WITH_SCRATCH(another_version_is_refused),
        WITH_SCRATCH(the_older_one_is_used_when_the_newest_is_damaged),
        WITH_SCRATCH(no_whole_one_is_an_error),
        WITH_SCRATCH(every_flipped_bit_is_found),
        WITH_SCRATCH(a_full_disk_loses_nothing),
        WITH_SCRATCH(a_finished_run_keeps_its_checkpoints),
        WITH_SCRATCH(failed_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
