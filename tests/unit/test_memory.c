/// A whole run in which one allocation fails, at each place of the program that allocates: it ends with a message about
/// memory, or (where what failed was not needed) as if nothing had happened.
///
/// A place is who calls whom down to the allocation. A first run notes the places of all its allocations; of those at
/// one place (the arrays of some hundred fields, say) one fails, drawn by chance.
#include "testing.h"

#include "base/checksum.h"
#include "base/memory.h"
#include "base/random.h"
#include "io_scratch.h"

#include <scree/scree.h>

#include <execinfo.h>
#include <malloc.h>
#include <stdlib.h>

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

enum { MOST = 20000, DEPTH = 64 };
static struct {
    bool on;
    uint64_t count;       ///< of allocations so far, and of questions for memory (scree_memory_check)
    uint64_t place[MOST]; ///< by number, from 1 on; 0 of a question
} noted;

/// In place of libc's: what base/memory.c calls for each allocation.
void *aligned_alloc(size_t alignment, size_t size)
{
    void *frames[DEPTH];
    if (noted.on) {
        const int count = backtrace(frames, DEPTH);
        uint64_t place = 0;
        for (int k = 0; k < count; k++) place = scree_checksum_word(place, (uint64_t)(uintptr_t)frames[k]);
        noted.count += scree_allocation_fail_after(0);
        assert_true(noted.count < MOST);
        noted.place[noted.count] = place;
    }
    return memalign(alignment, size);
}

/// Notes the places of a whole run. A question is told by the allocation before it, and by how far that is.
static void note_places(const char *output)
{
    scree_error error;
    (void)scree_allocation_fail_after(0);
    noted.on = true;
    check(run(output, &error), &error);
    noted.on = false;
    noted.count += scree_allocation_fail_after(0);
    assert_true(noted.count < MOST);
    for (uint64_t n = 1; n <= noted.count; n++)
        if (noted.place[n] == 0) noted.place[n] = scree_checksum_word(noted.place[n - 1], 1);
    scratch_destroy(output);
}

/// Whether allocation n is the one of its place that fails.
static bool is_drawn(uint64_t n)
{
    uint64_t alike = 0, before = 0, first = 0;
    for (uint64_t k = 1; k <= noted.count; k++) {
        if (noted.place[k] != noted.place[n]) continue;
        if (alike++ == 0) first = k;
        before += k < n;
    }
    return (uint64_t)(scree_random_uniform(7, SCREE_RANDOM_TEST, first) * (double)alike) == before;
}

static void every_failure_is_told(void **unused)
{
    (void)unused;
    char folder[64], output[128];
    size_t before, after;
    int failed = 0, told = 0;
    scree_error error;
    assert_true(scratch_create(folder));
    (void)snprintf(output, sizeof output, "%s/run", folder);
    check(run(output, &error), &error); // what is made once, and stays
    scratch_destroy(output);
    scree_allocation_statistics(&before, NULL);
    note_places(output);
    for (uint64_t n = 1; n <= noted.count; n++) {
        if (!is_drawn(n)) continue;
        (void)scree_allocation_fail_after(n);
        scree_status status = run(output, &error);
        assert_true(scree_allocation_fail_after(0) >= n);
        if (status && !strstr(error.message, "memory"))
            fail_msg("allocation %u: status %d, '%s'", (unsigned)n, (int)status, error.message);
        assert_true(status == SCREE_OK || status == SCREE_ERROR_IO);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        failed++;
        told += status != SCREE_OK;
        scratch_destroy(output);
    }
    print_message("%d places of %d allocations, %d end the run\n", failed, (int)noted.count, told);
    assert_true(told > failed / 2);
    scratch_destroy(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_failure_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
