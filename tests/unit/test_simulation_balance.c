/// A small sample from its confinement to its loading: the balance of energy, and stresses from contacts against those
/// from plates.
#include "run_fixture.h"

#include "simulation_cases.h"

/// History laws close the energy balance; second order in the step.
static void energy_balance_closes(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"integrator.step=2e-6 s", "stages.confine.unbalanced_limit=5e-2",
                                     "stages.compress.strain=0.1 %"};
    scree_case *c = case_read(SIMULATION_SMALL, overrides, 3);
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
    scree_case *c = case_read(SIMULATION_SMALL, overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double disagreement = 0, count = 0;
    bool first = true;
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (!s.sampled || !s.stage || !s.stage->loading) continue;
        const double *v = s.sample;
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
        cmocka_unit_test(energy_balance_closes),
        cmocka_unit_test(stresses_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
