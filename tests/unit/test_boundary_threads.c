/// Threads and throwing `work` away change no bit under each boundary.
#include "run_fixture.h"

#include "boundary_cases.h"

/// Runs until `steps` steps of the last stage are done; at that many before (discard > 0) the work is thrown away.
static uint64_t run_some(const scree_case *c, int threads, uint64_t steps, uint64_t discard)
{
    scree_simulation s;
    simulation_open(c, threads, &s);
    uint64_t done = 0;
    while (done < steps) {
        simulation_step(&s);
        done = simulation_last_steps(&s);
        if (discard == 0 || done != discard) continue;
        simulation_lose_work(&s, threads);
        discard = 0;
    }
    return simulation_close(&s);
}

static void threads_and_lost_work_give_the_same_bits(void **unused)
{
    (void)unused;
    for (int k = 0; k < BOUNDARY_VARIANTS - 1; k++) {
        scree_case *c = case_read(boundary_variants[k].text, &boundary_variants[k].override, 1);
        uint64_t reference = run_some(c, 1, 800, 0);
        assert_true(run_some(c, 2, 800, 0) == reference);
        assert_true(run_some(c, 1, 800, 321) == reference);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_and_lost_work_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
