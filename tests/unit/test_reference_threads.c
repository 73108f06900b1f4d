/// Small cases of every law, boundary and dimension: the same checksum for any number of threads, also more than there
/// are cores, whatever their instruction set.
#include "reference_compare.h"

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
        if (level >= 2) check(scree_instruction_set_choose(reference_sets[level], &error), &error);
        (void)snprintf(what, sizeof what, "%d threads, level %d", threads[k], scree_processor_level());
        reference_expect(path, NULL, threads[k], STEPS, alone, what);
    }
    check(scree_instruction_set_choose(NULL, &error), &error);
}

static void threads_do_not_show(void **unused)
{
    (void)unused;
    reference_each(compare_threads);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
