/// Threads and throwing `work` away change no bit of small samples under each law and scheme.
#include "run_fixture.h"
#include "state/pressure.h"

#include "base/random.h"
#include "simulation_cases.h"

/// Steps that the comparisons of threads and lost work take: into the confinement, with sliding, opening and new
/// contacts.
enum { COMPARED_STEPS = 6000 };

/// Runs COMPARED_STEPS in memory; at step `discard` (0: never) the work is thrown away and rebuilt.
static uint64_t run_some(const scree_case *c, int threads, uint64_t discard)
{
    scree_simulation s;
    simulation_open(c, threads, &s);
    while (s.state.evaluations < COMPARED_STEPS) {
        simulation_step(&s);
        if (discard == 0 || s.state.evaluations != discard) continue;
        simulation_lose_work(&s, threads);
        discard = 0;
    }
    assert_true(s.work.rebuilds > 0 && scree_pressure_now(&s.state) > 0);
    return simulation_close(&s);
}

static void threads_and_lost_work_give_the_same_bits(void **unused)
{
    (void)unused;
    for (int k = 0; k < COMBINATIONS; k++) {
        scree_case *c = case_read(SIMULATION_SMALL, combinations[k], OVERRIDES);
        uint64_t reference = run_some(c, 1, 0);
        for (int threads = 2; threads <= 3; threads++) assert_true(run_some(c, threads, 0) == reference);
        double random = scree_random_uniform(1, SCREE_RANDOM_TEST, (uint64_t)k);
        assert_true(run_some(c, 1, 1 + (uint64_t)((COMPARED_STEPS - 2) * random)) == reference);
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
