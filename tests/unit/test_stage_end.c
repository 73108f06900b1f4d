/// The end of a stage as its last snapshot sees it: with the strain of that stage, whatever comes next.
#include "run_fixture.h"

#include "io_scratch.h"

#include <stdlib.h>

#define COMMON                                                                                                         \
    "scree: 1\n"                                                                                                       \
    "seed: 3\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {material: quartz, count: 40, radius_min: 0.5 mm, radius_max: 1 mm}\n"                                 \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "output: {snapshots: 2, paraview: no, figures: no}\n"

/// Stages whose strains are of different components, so that none can stand for another; the last one is a deform.
static const char plates_text[] =
    COMMON "stages:\n"
           "  - {stage: prepare, aspect_ratio: 1.5}\n"
           "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.2}\n"
           "  - {stage: compress, strain: 0.5 %, rate: 0.2 1/s}\n"
           "  - {stage: deform, strain: 0.3 %, boundary: minimal, strain_rate: {xy: 0.2 1/s, yy: 0}}\n"
           "  - {stage: compress, strain: 0.2 %, rate: 0.2 1/s}\n"
           "  - {stage: deform, strain: 0.02 %, boundary: affine,\n"
           "     velocity_gradient: {xx: -0.1 1/s, xy: 0, yx: 0, yy: 0.02 1/s}}\n";

static const char periodic_text[] =
    COMMON "boundary: {periodic: xy}\n"
           "stages:\n"
           "  - {stage: prepare, method: gas, aspect_ratio: 1, solid_fraction: 60 %}\n"
           "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.2}\n"
           "  - {stage: compress, strain: 1 %, rate: 1 1/s}\n"
           "  - {stage: deform, velocity_gradient: {xy: 3 1/s, xx: -1 1/s}, strain: 3 %}\n"
           "  - {stage: deform, velocity_gradient: {yy: -1 1/s}, strain: 1 %}\n";

/// Strain of the last row of each loading stage, and what the case asked of it. Returns their number.
static size_t final_strains(const char *folder, const scree_case *c, double strain[8], double wanted[8])
{
    char path[128];
    scree_error error;
    scree_series series = {0};
    (void)snprintf(path, sizeof path, "%s/series.csv", folder);
    check(scree_series_read(&series, path, &error), &error);
    const double *stage = scree_series_get(&series, "stage"), *axial = scree_series_get(&series, "axial_strain");
    size_t count = 0;
    for (size_t k = 0; k < series.row_count; k++) {
        if (isnan(axial[k]) || (k + 1 < series.row_count && stage[k + 1] == stage[k])) continue;
        const scree_config_stage *config = &c->config.stages[(size_t)stage[k]];
        wanted[count] = scree_modules[config->kind]->numbers->strain(config->own);
        strain[count++] = axial[k];
    }
    scree_series_destroy(&series);
    return count;
}

/// Strains of the snapshots after which a stage begins anew, or nothing comes.
static size_t last_of_snapshots(const char *folder, double strain[8])
{
    scree_error error;
    size_t count, found = 0;
    double before = NAN;
    check(scree_snapshot_count(folder, &count, &error), &error);
    for (size_t k = 0; k < count; k++) {
        scree_snapshot snapshot;
        check(scree_snapshot_read(folder, k, &snapshot, &error), &error);
        // A loading stage has one at its begin, where the strain is zero.
        if (snapshot.axial_strain == 0 && !isnan(before)) strain[found++] = before;
        before = snapshot.axial_strain;
        scree_snapshot_destroy(&snapshot);
    }
    strain[found++] = before;
    return found;
}

static void expect_strains_of_their_own_stage(const char *text, size_t stages)
{
    scree_error error;
    scree_case *c = case_read(text, NULL, 0);
    scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    double strain[8], wanted[8], snapshot[8];
    check(scree_run(c, &options, &error), &error);
    assert_int_equal(final_strains(scratch, c, strain, wanted), stages);
    assert_int_equal(last_of_snapshots(scratch, snapshot), stages);
    for (size_t k = 0; k < stages; k++) {
        // The sample of the same step has the very number; stages end within half a step of a hundred or more, or
        // an interval of twenty later.
        if (snapshot[k] != strain[k]) fail_msg("stage %zu: %g in place of %g", k, snapshot[k], strain[k]);
        print_message("stage %zu: strain %.6g, wanted %.6g\n", k, strain[k], wanted[k]);
        assert_true(snapshot[k] > 0.995 * wanted[k] && snapshot[k] < 1.2 * wanted[k]);
    }
    scree_case_free(c);
}

static void with_plates_and_imposed_rates(void **unused)
{
    (void)unused;
    expect_strains_of_their_own_stage(plates_text, 4);
}

static void in_a_periodic_cell(void **unused)
{
    (void)unused;
    expect_strains_of_their_own_stage(periodic_text, 3);
}

/// A step budget that is used up where a stage ends tells so, and the next call goes on from there.
static void an_end_is_told_at_once(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = case_read(periodic_text, NULL, 0);
    scree_simulation *s;
    bool done = false;
    check(scree_simulation_create(c, 1, &s, &error), &error);
    uint64_t steps = 0;
    while (!done) {
        assert_true(s->state.evaluations == steps);
        check(scree_simulation_advance(s, 1, &done, &error), &error);
        steps++;
    }
    assert_true(s->state.evaluations == steps && s->state.stage.index == c->config.stage_count);
    check(scree_simulation_advance(s, 1, &done, &error), &error);
    assert_true(done && s->state.evaluations == steps);
    scree_simulation_free(s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(with_plates_and_imposed_rates, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(in_a_periodic_cell, make_scratch, remove_scratch),
        cmocka_unit_test(an_end_is_told_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
