/// Under each boundary the balance of energy closes and the rates are those that were asked for.
#include "boundary/membrane.h"
#include "run_fixture.h"

#include "boundary_cases.h"

#include <math.h>

static void energy_balance_closes_and_rates_are_met(void **unused)
{
    (void)unused;
    for (int k = 0; k < BOUNDARY_VARIANTS; k++) {
        const char *const overrides[] = {boundary_variants[k].override, "integrator.step=2e-6 s",
                                         "stages.confine.unbalanced_limit=5e-2", "stages.2.rise_time=5 ms",
                                         "stages.2.strain=0.02 %"};
        scree_case *c = case_read(boundary_variants[k].text, overrides, 5);
        scree_simulation s;
        const scree_config_stage *loading = &c->config.stages[2];
        double strain = scree_modules[loading->kind]->numbers->strain(loading->own);
        double worst = 0, least = INFINITY, most = -INFINITY;
        simulation_open(c, 1, &s);
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            if (!s.sampled) continue;
            const double *v = s.sample;
            worst = fmax(worst, v[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE]);
            double ratio = scree_sample_get(&s, "rate_ratio");
            if (isnan(ratio) || v[SCREE_SAMPLE_AXIAL_STRAIN] < 0.5 * strain) continue;
            least = fmin(least, ratio);
            most = fmax(most, ratio);
        }
        print_message("%s: largest energy residual over work %.3g, ratio of rates %.4f to %.4f\n",
                      boundary_variants[k].override, worst, least, most);
        // The bound that the program promises for history laws.
        assert_true(worst < 1e-6);
        // The default penalty lets the confining pressure answer an error of 1 %; the stress is a few times that.
        if (s.boundary == scree_module_minimal.boundary) assert_true(least > 0.95 && most < 1.05);
        if (s.boundary == scree_module_affine.boundary) assert_true(fabs(least - 1) < 1e-3 && fabs(most - 1) < 1e-3);
        assert_true(s.boundary == scree_module_membrane.boundary ? scree_membrane_of(&s.state)->count > 0
                                                                 : scree_membrane_of(&s.state)->count == 0);
        assert_true(s.state.ledger.boundary != 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_balance_closes_and_rates_are_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
