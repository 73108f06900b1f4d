/// Impact of two bodies: stage `collide` against the closed forms of both laws, in 2D and 3D; momentum, exchange.
#include "run_fixture.h"

#include "io/summary.h"
#include "run/conclusion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SPEED 7.5e-6

static const char case_text[] =
    "scree: 1\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"
    "     friction: 0.45}\n"
    "particles: {material: quartz, count: 2, radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "contact: {law: hertz_brilliantov, damping_time: 2 ms, reference_velocity: 7.5e-6 m/s}\n"
    "integrator: {scheme: velocity_verlet, step: 8e-6 s}\n"
    "stages:\n"
    "  - {stage: prepare, method: pair}\n"
    "  - {stage: collide}\n"
    "measure: {cells: no}\n";

typedef struct outcome {
    double restitution, restitution_theory, time, time_theory;
    double momentum; ///< largest over the run, over that of one body
    double residual; ///< J of the energy balance at the end, over the energy at the begin
    bool parted;
} outcome;

static double number_in(const char *text, const char *name)
{
    char wanted[64];
    (void)snprintf(wanted, sizeof wanted, "\"%s\":", name);
    const char *found = strstr(text, wanted);
    return found ? strtod(found + strlen(wanted), NULL) : NAN;
}

static void read_results(scree_simulation *s, outcome *o)
{
    char path[] = "/tmp/scree-test-XXXXXX", text[4096] = "";
    scree_error error;
    scree_summary *summary;
    int handle = mkstemp(path);
    assert_true(handle >= 0);
    close(handle);
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    check(scree_modules[SCREE_SLOT_collide]->conclude(&(scree_conclusion){.s = s, .summary = summary}, &error), &error);
    assert_int_equal(scree_summary_write(summary, path, NULL), SCREE_OK);
    FILE *file = fopen(path, "r");
    assert_true(fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    unlink(path);
    scree_summary_destroy(summary);
    o->parted = strstr(text, "restitution") != NULL;
    o->restitution = number_in(text, "restitution");
    o->restitution_theory = number_in(text, "restitution_theory");
    o->time = number_in(text, "relaxation_time");
    o->time_theory = number_in(text, "relaxation_time_theory");
}

/// The other pair seen in a mirror: body 0 is what body 1 was.
static void exchange(scree_state *state)
{
    scree_row first = state->row[state->row_of_id[0]], second = state->row[state->row_of_id[1]];
    double sum = first.x + second.x;
    double mirrored[2] = {sum - second.x, sum - first.x}, speed[2] = {-second.vx, -first.vx};
    scree_row *a = &state->row[state->row_of_id[0]], *b = &state->row[state->row_of_id[1]];
    *a = second;
    *b = first;
    a->x = mirrored[0];
    b->x = mirrored[1];
    a->vx = speed[0];
    b->vx = speed[1];
}

static outcome collide(const char *const *overrides, size_t count, bool exchanged)
{
    scree_case *c = case_read(case_text, overrides, count);
    scree_simulation s;
    outcome o = {0};
    simulation_open(c, 1, &s);
    simulation_step(&s); // prepare
    if (exchanged) exchange(&s.state);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        const scree_row *a = &s.state.row[0], *b = &s.state.row[1];
        o.momentum = fmax(o.momentum, fabs(a->mass * a->vx + b->mass * b->vx) / (a->mass * SPEED));
        assert_true(a->vy == 0 && b->vy == 0);
        if (s.sampled) o.residual = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL] / s.state.ledger.initial;
    }
    read_results(&s, &o);
    scree_simulation_close(&s);
    scree_case_free(c);
    return o;
}

#define SOLID "dimension=3", "particles.shape=sphere"
#define PLANE "dimension=2", "particles.shape=disc"

/// The damping force has the velocity of half a step before: first order, so a quarter of the step leaves a quarter of
/// the error, a half with a margin. The time is found to half a step.
static void closed_form_to_the_order_of_the_step(void **unused)
{
    (void)unused;
    static const char *const dimension[2][2] = {{PLANE}, {SOLID}};
    static const char *const damping[] = {"contact.damping_time=1e-4 s", "contact.damping_time=2e-3 s",
                                          "contact.damping_time=5e-3 s"};
    static const char *const scheme[] = {"integrator.scheme=velocity_verlet", "integrator.scheme=position_verlet"};
    for (int k = 0; k < 12; k++) {
        const char *overrides[] = {dimension[k % 2][0], dimension[k % 2][1], damping[k / 2 % 3], scheme[k / 6],
                                   "integrator.step=8e-6 s"};
        outcome coarse = collide(overrides, 5, false);
        overrides[4] = "integrator.step=2e-6 s";
        outcome fine = collide(overrides, 5, false);
        assert_true(coarse.parted && fine.parted);
        double wide = fabs(coarse.restitution / coarse.restitution_theory - 1);
        double narrow = fabs(fine.restitution / fine.restitution_theory - 1);
        print_message("%d: error of the restitution %.3g, with a quarter of the step %.3g; of the time %.3g s\n", k,
                      wide, narrow, fine.time - fine.time_theory);
        assert_true(wide < 5e-3);
        assert_true(narrow < 0.5 * wide || narrow < 1e-6);
        assert_true(fabs(coarse.time - coarse.time_theory) < 0.75 * 8e-6 + 1e-3 * coarse.time_theory);
        assert_true(fabs(fine.time - fine.time_theory) < 0.75 * 2e-6 + 2e-4 * fine.time_theory);
    }
}

static void hertz_mindlin_has_the_restitution_of_its_material(void **unused)
{
    (void)unused;
    for (int solid = 0; solid < 2; solid++) {
        const char *const overrides[] = {
            solid ? "dimension=3" : "dimension=2", solid ? "particles.shape=sphere" : "particles.shape=disc",
            "contact.law=hertz_mindlin", "materials.0.restitution=0.6", "integrator.step=2e-6 s"};
        outcome o = collide(overrides, 5, false);
        assert_true(o.parted);
        // The inverse of the closed form is exact to the last bits; the run has the error of its step.
        assert_true(fabs(o.restitution_theory / 0.6 - 1) < 1e-12);
        assert_true(fabs(o.restitution / 0.6 - 1) < 1e-3);
        assert_true(isnan(o.time_theory));
    }
}

/// Forces are integers: what one body gains the other loses, to the rounding of their velocities. Exchanging the two
/// changes rounding alone.
static void momentum_and_exchange(void **unused)
{
    (void)unused;
    static const char *const dimension[2][2] = {{PLANE}, {SOLID}};
    for (int d = 0; d < 2; d++) {
        outcome plain = collide(dimension[d], 2, false), exchanged = collide(dimension[d], 2, true);
        assert_true(plain.momentum < 1e-12 && exchanged.momentum < 1e-12);
        assert_true(fabs(plain.restitution - exchanged.restitution) < 1e-9);
        assert_true(fabs(plain.time - exchanged.time) < 1e-12);
        assert_true(fabs(plain.residual) < 1e-4);
    }
}

/// Without damping nothing is lost; the ledger closes.
static void elastic(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"contact.damping_time=0 s", "integrator.step=2e-6 s"};
    outcome o = collide(overrides, 2, false);
    assert_true(o.parted && fabs(o.restitution - 1) < 1e-6 && fabs(o.residual) < 1e-6);
}

/// A short duration ends the stage before they meet: no results, no failure.
static void duration_ends_it(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"stages.collide.duration=1e-4 s"};
    assert_false(collide(overrides, 1, false).parted);
}

static void refuse(const char *const *overrides, size_t count, const char *wanted)
{
    scree_case *c;
    scree_problems *problems;
    assert_int_not_equal(case_parse(case_text, overrides, count, &c, &problems), SCREE_OK);
    const char *message = scree_problems_get(problems, 0)->message;
    if (!strstr(message, wanted)) fail_msg("'%s' does not say '%s'", message, wanted);
    scree_problems_free(problems);
}

static void what_makes_no_sense_is_refused(void **unused)
{
    (void)unused;
    static const char *const count[] = {"particles.count=3"}, *const gravity[] = {"gravity=[0, -9.81]"};
    static const char *const method[] = {"stages.prepare.method=gas"};
    refuse(count, 1, "a pair is two particles");
    refuse(gravity, 1, "fall freely");
    refuse(method, 1, "prepare method pair");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_form_to_the_order_of_the_step),
        cmocka_unit_test(hertz_mindlin_has_the_restitution_of_its_material),
        cmocka_unit_test(momentum_and_exchange),
        cmocka_unit_test(elastic),
        cmocka_unit_test(duration_ends_it),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
