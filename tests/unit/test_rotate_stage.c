/// The stage rotate_particle end to end: spin, energy, bits, refusals, and a crystal of spheres whose answer is known.
#include "integrate/forced_spin.h"
#include "run_fixture.h"

#include "io_scratch.h"

#include "io/series.h"
#include "measure/rotation.h"
#include "run/stage_rotate_config.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEP 2e-5
#define SPIN 0.5
enum { REST = 100, RAMP = 250, HOLD = 150 };

#define DISCS                                                                                                          \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {material: quartz, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"                                 \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: position_verlet, step: 2e-5 s}\n"                                                            \
    "boundary: {every: 100}\n"                                                                                         \
    "measure: {samples: 10}\n"                                                                                         \
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 0}\n"                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, outline: circle}\n"                                                                          \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 2e-2, boundary: minimal}\n"                             \
    "  - {stage: rotate_particle, boundary: minimal, spin: 0.5 rad/s, rest_time: 2 ms, ramp_time: 5 ms, "              \
    "hold_time: 3 ms}\n"

/// A simple cubic crystal of 5 x 5 x 5 spheres between plates; 62 is the middle one.
#define SPHERES                                                                                                        \
    "scree: 1\n"                                                                                                       \
    "name: crystal\n"                                                                                                  \
    "dimension: 3\n"                                                                                                   \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {shape: sphere, material: quartz, count: 125, distribution: equal, radius: 1 mm}\n"                    \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: position_verlet, step: 2e-5 s}\n"                                                            \
    "boundary: {lateral: plates}\n"                                                                                    \
    "measure: {samples: 10}\n"                                                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: cubic, aspect_ratio: 1}\n"                                                           \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-2}\n"                                                \
    "  - {stage: rotate_particle, particle: 62, spin: 0.05 rad/s, ramp_time: 5 ms, hold_time: 5 ms}\n"

static scree_status parse(const char *text, const char *const *overrides, size_t count, scree_case **c, char line[2048])
{
    scree_problems *problems;
    scree_status status = case_parse(text, overrides, count, c, &problems);
    line[0] = 0;
    if (status) scree_error_format(scree_problems_get(problems, 0), line, 2048);
    if (status) scree_problems_free(problems);
    return status;
}

/// Opens the case and goes to the begin of its last stage.
static void open_at_stage(const scree_case *c, int threads, scree_simulation *s)
{
    simulation_open(c, threads, s);
    while (s->state.stage.index + 1 < s->model.stage_count || s->state.stage.counter < 0) simulation_step(s);
}

static double spin_of(const scree_simulation *s, size_t id, int axis)
{
    scree_vector velocity, spin;
    scree_body_motion(&s->state, s->state.row_of_id[id], velocity, spin);
    return spin[axis];
}

static void the_spin_follows_the_ramp(void **unused)
{
    (void)unused;
    scree_simulation s;
    scree_case *c = case_read(DISCS, NULL, 0);
    open_at_stage(c, 1, &s);
    size_t id = (size_t)scree_forced(&s.state)->id;
    double turned = 0;
    for (int k = 1; k <= REST + RAMP + HOLD; k++) {
        assert_non_null(s.stage);
        simulation_step(&s);
        // Velocities of position_verlet are those of the middle of the step.
        double expected = SPIN * fmin(1, fmax(0, (k - 0.5 - REST) / RAMP));
        assert_true(fabs(spin_of(&s, id, 2) - expected) < 1e-12 * SPIN);
        turned = k > REST + RAMP ? turned + expected * STEP : 0;
        double angle = s.state.angle[s.state.row_of_id[id]];
        if (k > REST + RAMP) assert_true(fabs(angle - turned) < 1e-12);
        if (k == REST) assert_true(angle == 0);
        // What a sample at rest turns by is something, and little.
        double background = scree_rotation_of(&s.state)->background.mean;
        if (k > REST) assert_true(background > 0 && background < 0.3);
    }
    assert_true(s.stage_ended);
    assert_true(fabs(scree_rotation_of(&s.state)->turn - SPIN * STEP * (0.5 * RAMP + HOLD)) < 1e-12);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// The ledger closes with the work of the forcing torque, which is no small part of it, and not without.
static void the_ledger_closes_with_the_work_of_the_torque(void **unused)
{
    (void)unused;
    scree_simulation s;
    scree_case *c = case_read(DISCS, NULL, 0);
    open_at_stage(c, 1, &s);
    // What was open before is of the loose packing that was pressed together.
    double before = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL], friction = s.state.ledger.friction;
    while (s.state.stage.index < 3) simulation_step(&s);
    double residual = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL] - before, forced = s.state.ledger.forced;
    assert_true(forced > 0 && s.state.ledger.friction - friction > 0.2 * forced);
    // Trapezoidal work against the true one of a nonlinear law in 500 steps.
    assert_true(fabs(residual) < 1e-3 * forced);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Runs `steps` of the stage from its begin; after `broken` of them the state goes through a checkpoint.
static uint64_t run_some(scree_simulation *begin, int threads, uint64_t steps, uint64_t broken, const char *folder)
{
    scree_simulation s[2];
    int now = 0;
    simulation_reopen(begin, threads, folder, &s[now]);
    for (uint64_t done = 1; done <= steps; done++) {
        simulation_step(&s[now]);
        if (done != broken) continue;
        simulation_reopen(&s[0], threads, folder, &s[1]);
        scree_simulation_close(&s[0]);
        now = 1;
    }
    return simulation_close(&s[now]);
}

static void threads_and_restarts_give_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_case *c = case_read(dimension == 2 ? DISCS : SPHERES, NULL, 0);
        scree_simulation s;
        open_at_stage(c, 1, &s);
        uint64_t reference = run_some(&s, 1, 450, 0, folder);
        assert_true(run_some(&s, 2, 450, 0, folder) == reference);
        // In the rest (of the discs), in the ramp, in the hold.
        assert_true(run_some(&s, 1, 450, 60, folder) == reference);
        assert_true(run_some(&s, 1, 450, 201, folder) == reference);
        assert_true(run_some(&s, 1, 450, 400, folder) == reference);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

static void what_cannot_work_is_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *override, *says;
    } wrong[] = {
        {"stages.rotate_particle.ramp_time=0 s", "ramp_time"},
        {"stages.rotate_particle.hold_time=0 s", "hold_time"},
        {"stages.rotate_particle.particle=60", "there is no such particle"},
        {"stages.rotate_particle.particle=1.5", "whole"},
        {"stages.rotate_particle.axis=x", "turns about z only"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        scree_case *c = NULL;
        char line[2048];
        assert_int_equal(parse(DISCS, &wrong[k].override, 1, &c, line), SCREE_ERROR_INPUT);
        if (!strstr(line, wrong[k].says)) fail_msg("'%s' does not say '%s'", line, wrong[k].says);
    }
}

static void a_named_particle_is_turned(void **unused)
{
    (void)unused;
    scree_simulation s;
    const char *override = "stages.rotate_particle.particle=59";
    scree_case *c = case_read(DISCS, &override, 1);
    open_at_stage(c, 1, &s);
    assert_int_equal(scree_forced(&s.state)->id, 59);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// The neighbours in the plane of the rotation turn like gears, whatever the axis; on it the contacts only twist.
static void a_crystal_turns_like_gears(void **unused)
{
    (void)unused;
    for (int axis = 0; axis < 3; axis++) {
        char choice[64];
        (void)snprintf(choice, sizeof choice, "stages.rotate_particle.axis=%c", "xyz"[axis]);
        const char *override = choice;
        scree_case *c = case_read(SPHERES, &override, 1);
        scree_simulation s;
        scree_vector centre, place;
        open_at_stage(c, 1, &s);
        while (s.state.stage.index < 3) simulation_step(&s);
        size_t forced = (size_t)scree_forced(&s.state)->id;
        double plane[4], along = 0, driven = spin_of(&s, forced, axis);
        int beside = 0;
        scree_body_position(&s.state, s.state.row_of_id[forced], centre);
        for (size_t id = 0; id < s.state.count; id++) {
            scree_body_position(&s.state, s.state.row_of_id[id], place);
            for (int i = 0; i < 3; i++) place[i] -= centre[i];
            if (id == forced || scree_length(place) > 2.1e-3) continue;
            if (fabs(place[axis]) > 1e-3)
                along = fmax(along, fabs(spin_of(&s, id, axis)));
            else
                plane[beside++] = spin_of(&s, id, axis);
        }
        assert_int_equal(beside, 4);
        // No contact gives more than mu f_n, and the plates do not press alike on all of them: within a factor of four.
        for (int k = 0; k < 4; k++) assert_true(plane[k] < -0.1 * driven && plane[k] > -0.9 * driven);
        assert_true(along < 0.1 * driven);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// What the run tells of its begin, and of each contact: both ways of sorting them have all of them.
static void the_run_tells_its_begin_and_its_contacts(void **unused)
{
    (void)unused;
    scree_case *c;
    char line[2048], text[64], path[sizeof scratch + 32];
    scree_error error;
    scree_series series, handed;
    assert_int_equal(parse(DISCS, NULL, 0, &c, line), SCREE_OK);
    const scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
    (void)snprintf(path, sizeof path, "%s/series.csv", scratch);
    check(scree_series_read(&series, path, &error), &error);
    const double *stage = scree_series_get(&series, "stage"), *contacts = scree_series_get(&series, "coordination");
    size_t first = 0;
    while (stage[first] < 2) first++;
    check(scree_result_get(scratch, "coordination_at_start", text, sizeof text, &error), &error);
    assert_true(contacts[first] > 2 && fabs(strtod(text, NULL) - contacts[first]) < 1e-6);
    (void)snprintf(path, sizeof path, "%s/rotation-handed.csv", scratch);
    check(scree_series_read(&handed, path, &error), &error);
    assert_int_equal(handed.row_count, SCREE_ROTATION_FORCES + SCREE_ROTATION_ANGLES);
    const double *count = scree_series_get(&handed, "count");
    double sum[2] = {0, 0};
    for (size_t k = 0; k < handed.row_count; k++) sum[k >= SCREE_ROTATION_FORCES] += count[k];
    assert_true(sum[0] > 0 && sum[0] == sum[1]);
    scree_series_destroy(&handed);
    scree_series_destroy(&series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spin_follows_the_ramp),
        cmocka_unit_test_setup_teardown(the_run_tells_its_begin_and_its_contacts, make_scratch, remove_scratch),
        cmocka_unit_test(the_ledger_closes_with_the_work_of_the_torque),
        cmocka_unit_test(threads_and_restarts_give_the_same_bits),
        cmocka_unit_test(what_cannot_work_is_refused),
        cmocka_unit_test(a_named_particle_is_turned),
        cmocka_unit_test(a_crystal_turns_like_gears),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
