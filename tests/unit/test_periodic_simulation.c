/// Cases in a periodic cell (threads: test_periodic.c): lost work, restart, the pressure that is asked for, balance of
/// energy, refusals.
#include "run_fixture.h"
#include "state/plates.h"

#include "io_scratch.h"
#include "state/periodic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char case_text[] =
    "scree: 1\n"
    "name: small\n"
    "dimension: 2\n"
    "seed: 3\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"
    "     friction: 0.45, restitution: 0.2}\n"
    "particles: {shape: disc, material: quartz, count: 70, distribution: uniform,\n"
    "            radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"
    "boundary: {periodic: xy}\n"
    "stages:\n"
    "  - {stage: prepare, method: gas, aspect_ratio: 1.5, solid_fraction: 58 %, velocity: 20 mm/s}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 5e-2}\n"
    "  - {stage: compress, strain: 1 %, rate: 0.2 1/s}\n"
    "  - {stage: deform, velocity_gradient: {xy: 0.8 1/s, yx: -0.2 1/s}, stress: {xx: 80 kPa, yy: 100 kPa}, strain: 70 "
    "%}\n"
    "measure: {samples: 20}\n"
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 7000}\n";

/// A lattice in rapid flow: few steps, all stages, a lattice of the cell that is remapped.
#define SHORT                                                                                                          \
    "particles.distribution=equal", "particles.radius=0.75 mm", "stages.prepare.method=hexagonal",                     \
        "stages.prepare.width=10.5 mm", "stages.compress.rate=1 1/s", "stages.confine.ramp_time=1 ms",                 \
        "stages.deform.velocity_gradient={xy: 3 1/s, yx: -0.5 1/s}", "stages.deform.strain=60 %"
enum { OVERRIDES = 12 };
#define SCHEME(law, scheme, more, most)                                                                                \
    {                                                                                                                  \
        SHORT, "contact.law=" law, "integrator.scheme=" scheme, more, most                                             \
    }
static const char *const combinations[][OVERRIDES] = {
    SCHEME("hertz_mindlin", "velocity_verlet", "measure.samples=20", "measure.cells=no"),
    SCHEME("hertz_mindlin", "position_verlet", "measure.samples=20", "measure.cells=no"),
    SCHEME("hertz_brilliantov", "position_verlet", "measure.samples=20", "measure.cells=no"),
    SCHEME("hertz_brilliantov", "position_verlet", "contact.friction_update=implicit", "measure.cells=no"),
    SCHEME("hertz_brilliantov", "two_timescales",
           "integrator={scheme: two_timescales, step: 2e-6 s, repeats: 2, large_multiple: 3, small_steps: 2}",
           "measure.cells=no"),
};
enum { COMBINATIONS = sizeof combinations / sizeof *combinations };

/// Runs the case in memory until `evaluations` have been made in its last stage; at every `discard`-th (0: never) the
/// work is thrown away and rebuilt. residual: largest one of the energy, over the work.
static uint64_t run_some(const scree_case *c, int threads, uint64_t evaluations, uint64_t discard, double *residual)
{
    scree_simulation s;
    scree_error error;
    uint64_t last = UINT64_MAX;
    *residual = 0;
    simulation_open(c, threads, &s);
    while (simulation_goes_on(&s) && s.state.evaluations < last) {
        simulation_step(&s);
        *residual = simulation_residual(&s, *residual);
        if (last == UINT64_MAX && s.state.stage.index + 1 == s.model.stage_count)
            last = s.state.evaluations + evaluations;
        if (discard == 0 || s.state.evaluations % discard != 0 || s.state.evaluations == 0) continue;
        simulation_lose_work(&s, threads);
        check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
    }
    return simulation_close(&s);
}

/// All laws that look at velocities, and all schemes. Energy: trapezoids along Hertz springs in rapid flow.
static void lost_work_gives_the_same_bits(void **unused)
{
    (void)unused;
    for (int k = 0; k < COMBINATIONS; k++) {
        scree_case *c = case_read(case_text, combinations[k], OVERRIDES);
        // The first goes on until its lattice is remapped.
        uint64_t evaluations = k == 0 ? 5000 : 1000;
        double residual;
        uint64_t reference = run_some(c, 1, evaluations, 0, &residual);
        assert_true(reference != 0);
        assert_true(residual < 1e-4);
        assert_true(run_some(c, 1, evaluations, 97, &residual) == reference);
        scree_case_free(c);
    }
}

static void restart_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    scree_case *c = case_read(case_text, combinations[1], OVERRIDES);
    run_restart(c, whole, part, 1, "stage compress ended");
    scree_case_free(c);
    scratch_destroy(folder);
}

/// The cell comes to the pressure that is asked for, to the strain that is asked for, and its energy is accounted for.
static void stages_do_what_they_say(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"stages.confine.unbalanced_limit=1e-2", "stages.deform.strain=40 %",
                                     "integrator.step=1e-5 s"};
    scree_case *c = case_read(case_text, overrides, 3);
    scree_simulation s;
    double worst = 0, stress[9], held = 0, lateral = 0, rows = 0, mean[2] = {0}, steps = 0;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s)) {
        int64_t stage = s.state.stage.index;
        bool sampled = s.sampled;
        simulation_step(&s);
        worst = simulation_residual(&s, worst);
        if (stage == 1) {
            // The tolerance of the stop rule, of means since the last sample.
            scree_periodic_stress(&s.model, &s.state, stress);
            for (int k = 0; k < 2; k++) mean[k] = (sampled ? 0 : mean[k]) + stress[4 * k];
            steps = (sampled ? 0 : steps) + 1;
            for (int k = 0; k < 2 && s.stage_ended; k++) assert_true(fabs(mean[k] / steps / 1e5 + 1) < 0.002);
        }
        if (stage == 2 && s.stage_ended) assert_true(fabs(s.sample[SCREE_SAMPLE_AXIAL_STRAIN] - 0.01) < 1e-5);
        if (stage == 3 && s.sampled && s.sample[SCREE_SAMPLE_AXIAL_STRAIN] > 0.2) {
            held += s.sample[SCREE_SAMPLE_AXIAL_PLATES];
            lateral += s.sample[SCREE_SAMPLE_LATERAL_APPLIED];
            rows++;
        }
    }
    assert_true(fabs(scree_cell(&s.state)->strain[1] / scree_cell(&s.state)->strain[3] + 4) < 1e-9);
    print_message("largest energy residual over work: %.3g; mean stresses %.4g, %.4g\n", worst, held / rows,
                  lateral / rows);
    // Means of some 16 samples of rapid shear of 70 discs: they scatter by a fifth.
    assert_true(fabs(held / rows / 1e5 - 1) < 0.4 && fabs(lateral / rows / 8e4 - 1) < 0.4);
    // Trapezoids along Hertz springs (test_simulation_balance.c), here with free flights and impacts.
    assert_true(worst < 1e-4);
    assert_true(fabs(s.state.ledger.periodic) > 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Periodic in x alone, between plates.
static void plates_close_the_other_direction(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"boundary.periodic=x", "particles.distribution=equal", "particles.radius=0.75 mm",
                                     "stages.prepare.method=hexagonal", "stages.prepare.width=10.5 mm"};
    char text[sizeof case_text];
    memcpy(text, case_text, sizeof text);
    // Without the stage that only a whole cell has.
    char *deform = strstr(text, "  - {stage: deform"), *rest = strstr(text, "measure:");
    memmove(deform, rest, strlen(rest) + 1);
    scree_case *c = case_read(text, overrides, 5);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    assert_true(s.work.ghosts.count > 0 && !scree_plates(&s.state)[SCREE_WALL_LEFT].active);
    assert_true(worst < 1e-4);
    // Contact stress and plates agree to the inertia of a fast compression.
    const double *v = s.sample;
    assert_true(fabs(v[SCREE_SAMPLE_AXIAL_CONTACTS] / v[SCREE_SAMPLE_AXIAL_PLATES] - 1) < 0.1);
    assert_true(fabs(v[SCREE_SAMPLE_AREA] - scree_cell(&s.state)->lattice[0] * v[SCREE_SAMPLE_HEIGHT]) < 1e-12);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void refuse(const char *override, const char *message)
{
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    assert_int_equal(case_parse(case_text, &override, 1, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        if (strstr(scree_problems_get(problems, k)->message, message)) {
            scree_problems_free(problems);
            return;
        }
    fail_msg("%s: expected \"%s\", got \"%s\"", override, message, scree_problems_get(problems, 0)->message);
}

/// Whether the model of the case can be built.
static void accept(const char *override, bool expected)
{
    scree_case *c = case_read(case_text, &override, 1);
    scree_model model;
    scree_error error;
    scree_status status = scree_model_build(&c->config, &model, &error);
    assert_int_equal(status, expected ? SCREE_OK : SCREE_ERROR_INPUT);
    if (!expected) assert_non_null(strstr(error.message, "wide along x"));
    scree_case_free(c);
}

static void what_cannot_be_is_refused(void **unused)
{
    (void)unused;
    refuse("stages.prepare.method=drop_and_roll", "this method needs walls");
    refuse("boundary.periodic=x", "only a cell that is periodic in all directions can be deformed");
    refuse("boundary.periodic=xyz", "there is no z in two dimensions");
    refuse("stages.deform.velocity_gradient={xy: 1 1/s, xz: 1 1/s}", "there is no z in two dimensions");
    refuse("stages.deform.velocity_gradient={xx: 1 1/s}", "the same component has a rate");
    refuse("gravity=[0, -9.81 m/s2]", "gravity has nothing to fall on");
    refuse("stages.prepare.outline=circle", "a round sample cannot repeat itself");
    // 12 discs of 0.5 to 1 mm, 23 mm2 at 0.76: 4.5 mm wide at an aspect ratio of 1.5, less than 4 mm at 2.
    accept("particles.count=12", true);
    accept("particles.count=8", false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lost_work_gives_the_same_bits), cmocka_unit_test(restart_gives_the_same_bits),
        cmocka_unit_test(stages_do_what_they_say),       cmocka_unit_test(plates_close_the_other_direction),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
