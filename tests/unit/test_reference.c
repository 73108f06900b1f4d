/// Small cases of every law, boundary and dimension, run to their ends by one thread: the same checksum as the stored
/// one whatever compiler made this program.
#include "reference_compare.h"

static void compare_stored(const char *path, const char *name, uint64_t stored)
{
    (void)name;
    reference_expect(path, NULL, 1, REFERENCE_END, stored, "one thread");
}

static void stored_checksums_hold(void **unused)
{
    (void)unused;
    reference_each(compare_stored);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stored_checksums_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
