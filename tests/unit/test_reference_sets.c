/// Small cases of every law, boundary and dimension, run to their ends: the stored checksums for every instruction set
/// of this machine.
#include "reference_compare.h"

/// Kernels that are compiled once for each instruction set; where there is one only, it has no number.
static void compare_sets(const char *path, const char *name, uint64_t stored)
{
    scree_error error;
    (void)name;
    for (int level = 2; level <= scree_processor_best(); level++) {
        check(scree_instruction_set_choose(reference_sets[level], &error), &error);
        assert_int_equal(scree_processor_level(), level);
        reference_expect(path, NULL, 1, REFERENCE_END, stored, reference_sets[level]);
    }
    check(scree_instruction_set_choose(NULL, &error), &error);
}

static void instruction_sets_do_not_show(void **unused)
{
    (void)unused;
    reference_each(compare_sets);
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
        cmocka_unit_test(instruction_sets_do_not_show),
        cmocka_unit_test(unknown_instruction_sets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
