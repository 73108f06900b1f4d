/// A whole run in which one allocation fails, at every seventh place: it ends with a message about memory, or (where
/// what failed was not needed) as if nothing had happened.
#include "testing.h"

#include "base/memory.h"
#include "io_scratch.h"

#include <scree/scree.h>

static const char text[] = "scree: 1\n"
                           "name: small\n"
                           "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5}]\n"
                           "particles: {material: glass, count: 6, radius_min: 1 mm, radius_max: 1.2 mm}\n"
                           "contact: {law: hertz_mindlin, reference_velocity: 1 m/s}\n"
                           "integrator: {scheme: velocity_verlet, step: 2e-6 s}\n"
                           "boundary: {lateral: plates}\n"
                           "measure: {samples: 2}\n"
                           "output: {snapshots: 1, paraview: no, figures: no}\n"
                           "stages:\n"
                           "  - {stage: prepare, method: gas, solid_fraction: 30 %}\n"
                           "  - {stage: relax, duration: 1e-4 s}\n";

static scree_status run(const char *output, scree_error *error)
{
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    scree_run_options options = {.output = output, .threads = 1};
    scree_status status = scree_case_parse(text, strlen(text), "small.yaml", NULL, &c, &problems);
    if (status && problems) *error = *scree_problems_get(problems, 0);
    if (status && !problems) scree_error_set_memory(error, 0);
    scree_problems_free(problems);
    if (!status) status = scree_run(c, &options, error);
    scree_case_free(c);
    return status;
}

static void every_failure_is_told(void **unused)
{
    (void)unused;
    enum { STRIDE = 7 };
    char folder[64], output[128];
    size_t before, after;
    scree_error error;
    assert_true(scratch_create(folder));
    scree_allocation_statistics(&before, NULL);
    (void)scree_allocation_fail_after(0);
    uint64_t made = STRIDE;
    for (uint64_t n = 1; n <= made; n += STRIDE) {
        (void)snprintf(output, sizeof output, "%s/%u", folder, (unsigned)n);
        (void)scree_allocation_fail_after(n);
        scree_status status = run(output, &error);
        made = scree_allocation_fail_after(0);
        if (status && !strstr(error.message, "memory"))
            fail_msg("allocation %u: status %d, '%s'", (unsigned)n, (int)status, error.message);
        assert_true(status == SCREE_OK || status == SCREE_ERROR_IO);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        if (status) made = n + STRIDE; // there may be more
        scratch_destroy(output);
    }
    scratch_destroy(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_failure_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
