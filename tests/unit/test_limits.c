/// Runs at their limits of stability: refused, told, stopped again after a restart, checked anew when bonds go; lengths
/// between selections, and the elastic constants from them.
#include "run_fixture.h"

#include "bond/bond.h"
#include "state/persistent.h"
#include <stdlib.h>

#define BLOCK(more)                                                                                                    \
    "scree: 1\nname: block\nmaterials:\n"                                                                              \
    "  - {name: disc, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0,\n"                \
    "     normal_stiffness: 7e10 N/m, stiffness_ratio: 0, damping_ratio: 0}\n"                                         \
    "particles: {shape: disc, material: disc, count: 40, distribution: equal, radius: 1 mm, thickness: 1 m}\n"         \
    "contact: {law: linear, deformation: explicit}\n"                                                                  \
    "selections:\n  - {select: layer, name: low, axis: y, end: low}\n"                                                 \
    "  - {select: layer, name: high, axis: y, end: high}\n"                                                            \
    "  - {select: layer, name: left, axis: x, end: low}\n"                                                             \
    "  - {select: layer, name: right, axis: x, end: high}\n"                                                           \
    "loads:\n"                                                                                                         \
    "  - {load: prescribed, selection: low, attack: surface, force_y: {from: 0 N, to: 1 kN, begin: 0 s, end: 50 "      \
    "us}}\n"                                                                                                           \
    "  - {load: prescribed, selection: high, attack: surface, force_y: {from: 0 N, to: -1 kN, begin: 0 s, end: 50 "    \
    "us}}\n"                                                                                                           \
    "integrator: {step: 200 ns}\noutput: {figures: no, paraview: no, snapshots: 0}\n"                                  \
    "stages:\n  - {stage: prepare, method: square, width: 10 mm}\n  - {stage: bond, gap_tolerance: 1 um}\n"            \
    "  - {stage: relax, name: press, duration: 100 us, boundary: none}\n"                                              \
    "measure:\n  cells: no\n  samples: 20\n  stability: yes\n  gauges:\n"                                              \
    "    - {name: height, between: high, and: low, along: y}\n"                                                        \
    "    - {name: width, between: left, and: right, along: x}\n" more

static const char plain[] = BLOCK("");

/// Opens a block and steps until something stops it; returns how many steps it took.
static uint64_t run_block(const char *const *overrides, size_t count, scree_simulation *s, scree_case **c,
                          scree_error *error)
{
    *c = case_read(plain, overrides, count);
    simulation_open(*c, 1, s);
    while (simulation_goes_on(s))
        if (scree_simulation_step(s, error)) break;
    return s->state.step;
}

static void block_close(scree_simulation *s, scree_case *c)
{
    scree_simulation_close(s);
    scree_case_free(c);
}

// ---- limits ------------------------------------------------------------------------------------------------------

/// Above k_n/E_p, and above the step, the run ends before the first step, and says what helps; with `warn` it goes on.
/// Relaxed, nothing is wrong with the softest particles.
static void a_run_above_a_limit_is_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *how[2], *says;
        bool stands;
    } tried[] = {
        {{"materials.disc.young_modulus=100 GPa", "guard.stability=stop"}, "contact.deformation: relaxed", false},
        {{"integrator.step=310 ns", "guard.stability=warn"}, "", true},
        {{"materials.disc.young_modulus=100 GPa", "guard.stability=warn"}, "", true},
        {{"materials.disc.young_modulus=100 GPa", "contact.deformation=relaxed"}, "", true},
        {{"materials.disc.young_modulus=200 GPa", "guard.stability=stop"}, "", true},
    };
    for (size_t k = 0; k < sizeof tried / sizeof *tried; k++) {
        scree_simulation s;
        scree_case *c;
        scree_error error = {0};
        const uint64_t steps = run_block(tried[k].how, 2, &s, &c, &error);
        print_message("%s, %s: %llu steps; %s%s\n", tried[k].how[0], tried[k].how[1], (unsigned long long)steps,
                      error.message, s.warning);
        assert_true(tried[k].stands == (steps > 0));
        if (!tried[k].stands) {
            assert_int_equal(error.status, SCREE_ERROR_GUARD);
            assert_non_null(strstr(error.message, tried[k].says));
            assert_true(s.whole);
        }
        // Told where it was allowed to go on above a limit, and nowhere else.
        assert_true((s.warning[0] != 0) == (k == 1 || k == 2));
        block_close(&s, c);
    }
}

/// What has been asked for is in the checkpoint: going on from it, the run is refused again.
static void a_refused_run_is_refused_again(void **unused)
{
    (void)unused;
    static const char *const soft[] = {"materials.disc.young_modulus=100 GPa"};
    scree_case *c = case_read(plain, soft, 1);
    scree_error error = {0};
    const scree_run_options options = {.threads = 1, .output = "limits-refused", .force = true};
    assert_int_equal(scree_run(c, &options, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "no step is stable, as the spectral radius"));
    error = (scree_error){0};
    assert_int_equal(scree_restart("limits-refused", &options, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "step 0, stage press"));
    scree_case_free(c);
}

/// A step that has become too large shows when a hundredth of the bonds is gone, and not before.
static void bonds_that_go_ask_for_a_check(void **unused)
{
    (void)unused;
    scree_case *c = case_read(plain, NULL, 0);
    scree_simulation s;
    scree_error error = {0};
    simulation_open(c, 1, &s);
    simulation_load(&s);
    for (int k = 0; k < 3; k++) simulation_step(&s);
    // Twice the mass, and nobody looks; half of it is found by the operator.
    for (size_t row = 0; row < s.state.count; row++) s.state.row[row].mass *= 0.3;
    simulation_step(&s);
    simulation_step(&s);
    const scree_persistent_member first = scree_persistent(&s.state)->member[0];
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    check(scree_persistent_remove(&s.state, first.first, first.second, &error), &error);
    scree_neighbours_invalidate(&s.work);
    simulation_step(&s);
    assert_int_equal(scree_simulation_step(&s, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "above the critical one"));
    block_close(&s, c);
}

/// A guard that only looks changes no bit.
static void looking_changes_nothing(void **unused)
{
    (void)unused;
    static const char *const how[][2] = {{"measure.stability=yes", "guard.stability=stop"},
                                         {"measure.stability=no", "guard.stability=warn"}};
    uint64_t sum[2];
    for (int k = 0; k < 2; k++) {
        scree_simulation s;
        scree_case *c;
        scree_error error = {0};
        assert_true(run_block(how[k], 2, &s, &c, &error) == 501);
        sum[k] = scree_state_checksum(&s.model, &s.state);
        block_close(&s, c);
    }
    assert_true(sum[0] == sum[1]);
}

// ---- gauges ------------------------------------------------------------------------------------------------------

/// Lengths are those of the lattice from centre to centre, to the rounding of a mean; shortenings those of the rows.
static void lengths_are_those_between_centres(void **unused)
{
    (void)unused;
    scree_case *c = case_read(plain, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    assert_true(fabs(scree_sample_get(&s, "height_length") - 14e-3) < 1e-15);
    assert_true(fabs(scree_sample_get(&s, "width_length") - 8e-3) < 1e-15);
    assert_true(scree_sample_get(&s, "height_shortening") == 0);
    double before = 0;
    for (size_t row = 0; row < s.state.count; row++)
        before += s.state.row[row].y * (s.state.row[row].y > 14e-3 ? 1 : s.state.row[row].y < 2e-3 ? -1 : 0) / 5;
    while (simulation_goes_on(&s) && !s.stage_ended) simulation_step(&s);
    double after = 0;
    for (size_t row = 0; row < s.state.count; row++)
        after += s.state.row[row].y * (s.state.row[row].y > 14e-3 ? 1 : s.state.row[row].y < 2e-3 ? -1 : 0) / 5;
    const double shortening = scree_sample_get(&s, "height_shortening");
    assert_true(shortening > 1e-7 && fabs(shortening - (before - after)) < 1e-15);
    assert_true(fabs(scree_sample_get(&s, "height_strain") - shortening / 14e-3) < 1e-15);
    assert_true(scree_sample_get(&s, "width_strain") < 0);
    block_close(&s, c);
}

static double result(const char *name)
{
    char text[64];
    scree_error error = {0};
    check(scree_result_get("limits-elastic", name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// Dashpots of five times the critical ratio, loaded slowly: the closed forms of the lattice (M 4.26, 4.27) and of the
/// energies. 2e-3: the load takes 30 periods of the block; energies are those at the end, at rest.
static void elastic_test_has_the_closed_form(void **unused)
{
    (void)unused;
    static const char text[] = BLOCK("  elastic_axial: height\n  elastic_lateral: width\n  elastic_load: high\n"
                                     "  elastic_area: 0.01 m2\n  elastic_theory: square\n");
    static const char *const slow[] = {"materials.disc.damping_ratio=5", "integrator.step=10 ns"};
    scree_case *c = case_read(text, slow, 2);
    scree_error error = {0};
    const scree_run_options options = {.threads = 1, .output = "limits-elastic", .force = true};
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
    const double kp = M_PI * 200e9 / (2 * (1 - 0.35 * 0.35)), k = 7e10 * kp / (kp + 2 * 7e10);
    const double poisson = 4 * 0.35 * 1.35 * 7e10 / (4 * (1 - 0.35 * 0.35) * 7e10 + M_PI * 200e9);
    assert_true(fabs(result("axial_young_modulus_theory") / k - 1) < 1e-9);
    assert_true(fabs(result("axial_poisson_ratio_theory") / poisson - 1) < 1e-9);
    assert_true(fabs(result("axial_young_modulus") / k - 1) < 2e-3);
    assert_true(fabs(result("axial_poisson_ratio") / poisson - 1) < 2e-3);
    assert_true(fabs(result("height_shortening") / (7 * 1e3 / k) - 1) < 1e-4);
    // Five columns of seven contacts and eight discs: f^2 / 2 k_n and f^2 / k_p each; the loads work at the surface.
    const double contacts = 35 * 1e6 / (2 * 7e10), particles = 40 * 1e6 / kp;
    const double stored = result("elastic_normal") + result("energy_particles");
    assert_true(fabs(result("elastic_normal") / contacts - 1) < 1e-4);
    assert_true(fabs(result("energy_particles") / particles - 1) < 1e-4);
    assert_true(fabs((stored - result("centre_work")) / (5 * 1e6 / kp) - 1) < 1e-2);
    const double work = result("low_exerted_work") + result("high_exerted_work");
    assert_true(fabs(work - stored - result("dissipated_damping") - result("energy_lag")) < 1e-6 * work);
}

/// Names that are not there, directions without a length, a test without its gauge: each is refused at its place.
static void bad_gauges_are_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"measure.gauges.height.between=top", "there is no selection 'top'"},
        {"measure.gauges.height.and=high", "this is the first"},
        {"measure.gauges.height.along=z", "no z in two dimensions"},
        {"measure.gauges.height.from=pres", "there is no stage 'pres'"},
        {"measure.gauges.width.name=height", "is called 'height' too"},
        {"measure.elastic_axial=length", "there is no gauge 'length'"},
        {"measure.elastic_axial=height", "needs the load"},
        {"measure.elastic_load=high", "not used without elastic_axial"},
        {"measure.elastic_theory=square", "not used without elastic_axial"},
        {"measure.elastic_from=90 %", "ends before it begins"},
        {"boundary.periodic=y", "there is no distance"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        scree_case *c;
        scree_problems *problems;
        assert_int_equal(case_parse(plain, &wrong[k][0], 1, &c, &problems), SCREE_ERROR_INPUT);
        bool found = false;
        for (size_t p = 0; p < scree_problems_count(problems); p++)
            found = found || strstr(scree_problems_get(problems, p)->message, wrong[k][1]);
        if (!found) fail_msg("%s: '%s'", wrong[k][0], scree_problems_get(problems, 0)->message);
        scree_problems_free(problems);
    }
}

/// Both selections lie at one height: known once the sample is there, and said with the key of the gauge.
static void a_gauge_without_length_is_refused(void **unused)
{
    (void)unused;
    static const char *const along[] = {"measure.gauges.width.along=y"};
    scree_simulation s;
    scree_case *c;
    scree_error error = {0};
    run_block(along, 1, &s, &c, &error);
    assert_int_equal(error.status, SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "gauge 'width' has no length"));
    assert_string_equal(error.field, "measure.gauges.1");
    block_close(&s, c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_above_a_limit_is_refused),
        cmocka_unit_test(a_refused_run_is_refused_again),
        cmocka_unit_test(bonds_that_go_ask_for_a_check),
        cmocka_unit_test(looking_changes_nothing),
        cmocka_unit_test(a_gauge_without_length_is_refused),
        cmocka_unit_test(lengths_are_those_between_centres),
        cmocka_unit_test(elastic_test_has_the_closed_form),
        cmocka_unit_test(bad_gauges_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
