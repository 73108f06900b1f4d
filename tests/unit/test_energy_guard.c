/// The energy guard: what it divides by. Runs that are right go on, with next to no energy or with much that is only
/// kept; one whose energy grows is stopped; the summary divides by the same.
#include "io_scratch.h"
#include "run_fixture.h"

#include <stdlib.h>

static const char pair_text[] =
    "scree: 1\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"
    "     friction: 0.45}\n"
    "particles: {material: quartz, count: 2, distribution: equal, radius: 0.75 mm}\n"
    "contact: {law: hertz_brilliantov, damping_time: 1 ms, reference_velocity: 7.5e-6 m/s}\n"
    "stages:\n"
    "  - {stage: prepare, method: pair}\n"
    "  - {stage: collide}\n"
    "measure: {cells: no}\n";

/// Discs that fly about in a periodic cell, and lose next to nothing when they meet.
static const char gas_text[] =
    "scree: 1\n"
    "materials:\n"
    "  - {name: glass, young_modulus: 1 GPa, poisson_ratio: 0.3, density: 2500 kg/m3,\n"
    "     friction: 0, restitution: 0.999999}\n"
    "particles: {material: glass, count: 40, distribution: equal, radius: 1 mm}\n"
    "boundary: {periodic: xy}\n"
    "stages:\n"
    "  - {stage: prepare, method: gas, solid_fraction: 30 %, velocity: 0.1 m/s, aspect_ratio: 1}\n"
    "  - {stage: relax, duration: 20 ms}\n"
    "measure: {samples: 500, cells: no}\n"
    "output: {snapshots: 0, figures: no, paraview: no}\n";

/// Bodies on a lattice, each just touching the next; nothing acts on them but `gravity`, and plates stand around.
static const char lattice_text[] = "scree: 1\n"
                                   "materials:\n"
                                   "  - {name: glass, young_modulus: 50 GPa, poisson_ratio: 0.3, density: 2500 kg/m3,\n"
                                   "     friction: 0.3, restitution: 0.5}\n"
                                   "particles: {material: glass, count: 125, distribution: equal, radius: 1 mm}\n"
                                   "stages:\n"
                                   "  - {stage: prepare, method: square}\n"
                                   "  - {stage: relax, boundary: plates, duration: 1e-5 s}\n"
                                   "measure: {samples: 20, cells: no}\n";

static double run_to_end(const char *text, const char *const *overrides, size_t count)
{
    scree_case *c = case_read(text, overrides, count);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    simulation_close(&s);
    scree_case_free(c);
    return worst;
}

static void an_impact_keeps_what_it_began_with(void **unused)
{
    (void)unused;
    // At the automatic step the few steps of an impact leave some percent of what is turned over while it begins, a
    // hundred times as much as in the worst sample of the whole.
    assert_true(run_to_end(pair_text, NULL, 0) < 0.01);
}

static void an_elastic_gas_goes_on(void **unused)
{
    (void)unused;
    // The elastic energy of an impact is followed to third order in the step, of which it has some fifty.
    assert_true(run_to_end(gas_text, NULL, 0) < 1e-3);
}

static void bodies_at_rest_are_round_off(void **unused)
{
    (void)unused;
    static const char *const plane[] = {"particles.shape=disc"};
    static const char *const hexagonal[] = {"stages.prepare.method=hexagonal"};
    static const char *const solid[] = {"dimension=3", "particles.shape=sphere", "stages.prepare.method=cubic"};
    static const char *const apart[] = {"stages.prepare.method=gas"};
    // Overlaps of one unit in the last place in place of sixteen: 16^-2.5 = 1e-3 of the energy that round-off may hold.
    assert_true(run_to_end(lattice_text, plane, 1) < 1e-3);
    assert_true(run_to_end(lattice_text, hexagonal, 1) < 1e-3);
    assert_true(run_to_end(lattice_text, solid, 3) < 1e-3);
    assert_true(run_to_end(lattice_text, apart, 1) == 0);
}

/// Goes on to the end of the case, or until something stops it, and returns what.
static scree_status stopped_by(scree_simulation *s, scree_error *error)
{
    scree_status status = SCREE_OK;
    while (!status && simulation_goes_on(s)) status = scree_simulation_step(s, error);
    return status;
}

static void growing_energy_is_caught(void **unused)
{
    (void)unused;
    scree_case *c = case_read(gas_text, NULL, 0);
    scree_simulation s;
    scree_error error = {0};
    simulation_open(c, 1, &s);
    // Four times the critical step of the strongest impact that the step is chosen for: a mean one is not resolved.
    s.model.step *= 40;
    assert_int_equal(stopped_by(&s, &error), SCREE_ERROR_GUARD);
    if (!strstr(error.message, "energy appears from nowhere")) fail_msg("'%s'", error.message);
    const double *value = s.sample;
    assert_true(value[SCREE_SAMPLE_KINETIC] + value[SCREE_SAMPLE_ELASTIC_NORMAL] > 1.05 * s.state.ledger.initial);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// What is not a number is no small residual.
static void an_energy_that_is_no_number_stops(void **unused)
{
    (void)unused;
    scree_case *c = case_read(gas_text, NULL, 0);
    scree_simulation s;
    scree_error error = {0};
    simulation_open(c, 1, &s);
    while (s.state.evaluations == 0) simulation_step(&s);
    s.state.ledger.turnover = NAN;
    assert_int_equal(stopped_by(&s, &error), SCREE_ERROR_GUARD);
    assert_true(isnan(s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE]));
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void the_summary_divides_by_the_same(void **unused)
{
    (void)unused;
    char path[128], value[32];
    scree_error error;
    scree_series series = {0};
    scree_case *c = case_read(gas_text, NULL, 0);
    scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    (void)snprintf(path, sizeof path, "%s/series.csv", scratch);
    check(scree_series_read(&series, path, &error), &error);
    const double *residual = scree_series_get(&series, "energy_residual");
    const double *relative = scree_series_get(&series, "energy_residual_relative");
    size_t last = series.row_count - 1;
    double largest = 0;
    for (size_t k = 0; k <= last; k++) largest = fmax(largest, fabs(residual[k]));
    check(scree_result_get(scratch, "energy_residual", value, sizeof value, &error), &error);
    // Round-off of the quotients; the last sample lies at the end.
    assert_true(fabs(strtod(value, NULL) / (largest * relative[last] / fabs(residual[last])) - 1) < 1e-12);
    scree_series_destroy(&series);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_impact_keeps_what_it_began_with),
        cmocka_unit_test(an_elastic_gas_goes_on),
        cmocka_unit_test(bodies_at_rest_are_round_off),
        cmocka_unit_test(growing_energy_is_caught),
        cmocka_unit_test(an_energy_that_is_no_number_stops),
        cmocka_unit_test_setup_teardown(the_summary_divides_by_the_same, make_scratch, remove_scratch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
