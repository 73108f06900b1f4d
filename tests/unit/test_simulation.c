/// Whole simulations of small samples: threads, throwing `work` away, restart, energy, stresses.
#include "run_fixture.h"

#include "base/random.h"
#include "io_scratch.h"
#include "state/pressure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char case_text[] =
    "scree: 1\n"
    "name: small\n"
    "dimension: 2\n"
    "seed: 1\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"
    "     friction: 0.45, restitution: 0.2}\n"
    "particles: {shape: disc, material: quartz, count: 70, distribution: uniform,\n"
    "            radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"
    "boundary: {lateral: pressure, every: 100}\n"
    "stages:\n"
    "  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-2}\n"
    "  - {stage: compress, strain: 0.5 %, rate: 5e-2 1/s}\n"
    "measure: {samples: 20}\n"
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 700}\n";

/// Combinations of law, scheme and update of friction.
#define BRILLIANTOV "contact.law=hertz_brilliantov"
enum { COMBINATIONS = 7, OVERRIDES = 4 };
static const char *const combinations[COMBINATIONS][OVERRIDES] = {
    {"contact.law=hertz_mindlin", "integrator.scheme=velocity_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {"contact.law=hertz_mindlin", "integrator.scheme=position_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=velocity_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=position_verlet", "stages.confine.friction=0.1", "dimension=2"},
    {BRILLIANTOV, "integrator.scheme=velocity_verlet", "contact.friction_update=implicit",
     "stages.confine.friction=0.1"},
    {BRILLIANTOV, "integrator.scheme=position_verlet", "contact.friction_update=implicit",
     "stages.confine.friction=0.1"},
    {BRILLIANTOV, "integrator.scheme=two_timescales", "integrator.step=1e-6 s", "integrator.repeats=2"},
};

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
        scree_case *c = case_read(case_text, combinations[k], OVERRIDES);
        uint64_t reference = run_some(c, 1, 0);
        for (int threads = 2; threads <= 3; threads++) assert_true(run_some(c, threads, 0) == reference);
        double random = scree_random_uniform(1, SCREE_RANDOM_TEST, (uint64_t)k);
        assert_true(run_some(c, 1, 1 + (uint64_t)((COMPARED_STEPS - 2) * random)) == reference);
        scree_case_free(c);
    }
}

static double read_number(const char *directory, const char *name)
{
    scree_error error;
    char text[64];
    check(scree_result_get(directory, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// Uninterrupted run against one that is stopped and restarted, and one that lost everything after a checkpoint.
static void restart_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    for (int k = 0; k < COMBINATIONS; k++) {
        scree_error error;
        scree_case *c = case_read(case_text, combinations[k], OVERRIDES);
        run_restart(c, whole, part, 2, "stage confine ended");
        double cost = read_number(whole, "loading_force_evaluations"), time = read_number(whole, "loading_wall_time");
        assert_true(cost > 0 && cost < read_number(whole, "force_evaluations"));
        assert_true(read_number(part, "loading_force_evaluations") == cost);
        assert_true(time > 0 && time < read_number(whole, "wall_time"));
        double processor = read_number(whole, "loading_processor_time");
        assert_true(processor > 0 && processor < time + 0.02); // one thread; the clocks tick differently
        // A finished run is at its end, and its time is kept.
        scree_run_options options = {.threads = 1};
        check(scree_restart(whole, &options, &error), &error);
        run_compare(whole, part);
        assert_true(read_number(whole, "loading_wall_time") == time);
        assert_true(read_number(whole, "loading_processor_time") == processor);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

/// History laws close the energy balance; second order in the step.
static void energy_balance_closes(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"integrator.step=2e-6 s", "stages.confine.unbalanced_limit=5e-2",
                                     "stages.compress.strain=0.1 %"};
    scree_case *c = case_read(case_text, overrides, 3);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    print_message("largest energy residual over work: %.3g\n", worst);
    // The bound that the program promises for history laws.
    assert_true(worst < 1e-6);
    assert_true(s.state.ledger.damping > 0 && s.state.ledger.friction > 0 && s.state.ledger.turnover > 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Stress from contacts and from plates agree in quasistatic loading; both equal the pressure at its begin.
static void stresses_agree(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"stages.confine.unbalanced_limit=2e-3", "stages.compress.rate=1e-2 1/s"};
    scree_case *c = case_read(case_text, overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double disagreement = 0, count = 0;
    bool first = true;
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (!s.sampled || !s.stage || !s.stage->loading) continue;
        const double *v = s.sample.value;
        if (first) {
            // The stop rule of the confinement allows 5 % for the plates.
            assert_true(fabs(v[SCREE_SAMPLE_LATERAL_CONTACTS] / 1e5 - 1) < 0.05);
            first = false;
        }
        disagreement += fabs(v[SCREE_SAMPLE_AXIAL_CONTACTS] / v[SCREE_SAMPLE_AXIAL_PLATES] - 1);
        count += 1;
    }
    print_message("mean disagreement of plates and contacts: %.3g\n", disagreement / count);
    assert_true(disagreement / count < 0.01);
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_and_lost_work_give_the_same_bits),
        cmocka_unit_test(restart_gives_the_same_bits),
        cmocka_unit_test(energy_balance_closes),
        cmocka_unit_test(stresses_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
