/// Small cases of every law, boundary and dimension, run to their ends: the same checksum as the stored one whatever
/// compiler made this program, for every instruction set of this machine, for any number of threads (also more than
/// there are cores), and whatever is sampled and written.
#include "testing.h"

#include "base/processor.h"
#include "io_scratch.h"
#include "reference_cases.h"

/// Calls `compare` for every case with its stored checksum.
static void for_each(void (*compare)(const char *path, const char *name, uint64_t stored))
{
    glob_t cases;
    assert_int_equal(glob(REFERENCE_CASES, 0, NULL, &cases), 0);
    for (size_t k = 0; k < cases.gl_pathc; k++) {
        char name[64];
        uint64_t stored = 0;
        reference_name(cases.gl_pathv[k], name);
        if (!reference_stored(name, &stored)) fail_msg("no checksum of '%s' is stored; `make reference`", name);
        compare(cases.gl_pathv[k], name, stored);
    }
    globfree(&cases);
}

static void expect(const char *path, const char *override, int threads, uint64_t most, uint64_t stored,
                   const char *what)
{
    uint64_t checksum = 0;
    assert_int_equal(reference_run(path, override, threads, most, &checksum), SCREE_OK);
    if (checksum != stored)
        fail_msg("%s, %s: checksum %016" PRIx64 ", expected %016" PRIx64, path, what, checksum, stored);
}

static void compare_stored(const char *path, const char *name, uint64_t stored)
{
    (void)name;
    expect(path, NULL, 1, REFERENCE_END, stored, "one thread");
}

static void stored_checksums_hold(void **unused)
{
    (void)unused;
    for_each(compare_stored);
}

static const char *const sets[] = {[2] = "v2", [3] = "v3", [4] = "v4"};

/// Kernels that are compiled once for each instruction set; where there is one only, it has no number.
static void compare_sets(const char *path, const char *name, uint64_t stored)
{
    scree_error error;
    (void)name;
    for (int level = 2; level <= scree_processor_best(); level++) {
        check(scree_instruction_set_choose(sets[level], &error), &error);
        assert_int_equal(scree_processor_level(), level);
        expect(path, NULL, 1, REFERENCE_END, stored, sets[level]);
    }
    check(scree_instruction_set_choose(NULL, &error), &error);
}

static void instruction_sets_do_not_show(void **unused)
{
    (void)unused;
    for_each(compare_sets);
}

/// Some thousand steps, since more threads than cores are slow; with each instruction set.
static void compare_threads(const char *path, const char *name, uint64_t stored)
{
    enum { STEPS = 2000 };
    static const int threads[] = {2, 3, 7};
    scree_error error;
    uint64_t alone = 0;
    (void)name, (void)stored;
    assert_int_equal(reference_run(path, NULL, 1, STEPS, &alone), SCREE_OK);
    for (int k = 0; k < 3; k++) {
        char what[64];
        int best = scree_processor_best(), level = best > 0 ? best - k : 0;
        if (level >= 2) check(scree_instruction_set_choose(sets[level], &error), &error);
        (void)snprintf(what, sizeof what, "%d threads, level %d", threads[k], scree_processor_level());
        expect(path, NULL, threads[k], STEPS, alone, what);
    }
    check(scree_instruction_set_choose(NULL, &error), &error);
}

static void threads_do_not_show(void **unused)
{
    (void)unused;
    for_each(compare_threads);
}

/// A stage without plates ends at the first sample beyond its strain: there the number of samples is physics.
static void compare_samples(const char *path, const char *name, uint64_t stored)
{
    if (strcmp(name, "minimal_2d") == 0) return;
    expect(path, "measure.samples=7", 1, REFERENCE_END, stored, "7 samples");
    expect(path, "measure.samples=31", 1, REFERENCE_END, stored, "31 samples");
}

static void samples_do_not_show(void **unused)
{
    (void)unused;
    for_each(compare_samples);
}

static void snapshots_do_not_show(void **unused)
{
    (void)unused;
    static const char *const numbers[] = {"output.snapshots=1", "output.snapshots=5"};
    char folder[64], output[128], text[32], stored[32];
    uint64_t checksum;
    assert_true(scratch_create(folder));
    assert_true(reference_stored("plates_2d", &checksum));
    (void)snprintf(stored, sizeof stored, "%016" PRIx64, checksum);
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_error error;
        (void)snprintf(output, sizeof output, "%s/%d", folder, k);
        scree_run_options options = {.output = output, .threads = 1};
        assert_int_equal(reference_read(REFERENCE_FOLDER "cases/plates_2d.yaml", numbers[k], &c), SCREE_OK);
        check(scree_run(c, &options, &error), &error);
        check(scree_result_get(output, "state_checksum", text, sizeof text, &error), &error);
        assert_string_equal(text, stored);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

static void unknown_instruction_sets_are_refused(void **unused)
{
    (void)unused;
    static const char *const words[] = {"v5", "V3", "", "v", "avx2"};
    scree_error error;
    int level = scree_processor_level();
    for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
        assert_int_equal(scree_instruction_set_choose(words[k], &error), SCREE_ERROR_INPUT);
        assert_int_equal(scree_processor_level(), level);
    }
    check(scree_instruction_set_choose("auto", &error), &error);
    assert_int_equal(scree_processor_level(), level);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_checksums_hold), cmocka_unit_test(instruction_sets_do_not_show),
        cmocka_unit_test(threads_do_not_show),   cmocka_unit_test(samples_do_not_show),
        cmocka_unit_test(snapshots_do_not_show), cmocka_unit_test(unknown_instruction_sets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
