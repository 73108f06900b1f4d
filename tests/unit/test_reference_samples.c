/// Small cases of every law, boundary and dimension, run to their ends: the stored checksums whatever is sampled and
/// written.
#include "io_scratch.h"
#include "reference_compare.h"

/// A stage without plates ends at the first sample beyond its strain: there the number of samples is physics.
static void compare_samples(const char *path, const char *name, uint64_t stored)
{
    if (strcmp(name, "minimal_2d") == 0) return;
    reference_expect(path, "measure.samples=7", 1, REFERENCE_END, stored, "7 samples");
    reference_expect(path, "measure.samples=31", 1, REFERENCE_END, stored, "31 samples");
}

static void samples_do_not_show(void **unused)
{
    (void)unused;
    reference_each(compare_samples);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_do_not_show),
        cmocka_unit_test(snapshots_do_not_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
