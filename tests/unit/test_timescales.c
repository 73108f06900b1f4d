/// Two timescales in whole simulations: cost in force evaluations, the limits I and III bit for bit, continuation in
/// the middle of a sequence, the energy balance, and the implicit friction that makes small steps needless.
#include "run_fixture.h"

#include "io_scratch.h"
#include "run/loading.h"

#include <math.h>
#include <string.h>

/// Padbidri's parameters; the rate is ten times his, so the step, too, that makes friction stiff.
static const char case_text[] =
    "scree: 1\n"
    "name: small\n"
    "dimension: 2\n"
    "seed: 3\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3, friction: 0.45}\n"
    "particles: {shape: disc, material: quartz, count: 80, distribution: uniform,\n"
    "            radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "contact: {law: hertz_brilliantov}\n"
    "integrator: {scheme: two_timescales, step: 1e-6 s}\n"
    "boundary: {lateral: pressure, every: 50}\n"
    "stages:\n"
    "  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-2, friction: 0.05}\n"
    "  - {stage: compress, strain: 1 %, rate: 5e-2 1/s}\n"
    "measure: {samples: 20}\n";

typedef struct run {
    scree_case *c;
    scree_simulation s;
} run;

/// A simulation of the case at the begin of its loading stage.
static void start(run *r, int threads, const char *const *overrides, size_t count)
{
    r->c = case_read(case_text, overrides, count);
    simulation_open(r->c, threads, &r->s);
    simulation_load(&r->s);
}

static void advance(run *r, uint64_t evaluations)
{
    uint64_t target = r->s.state.evaluations + evaluations;
    while (r->s.state.evaluations < target) simulation_step(&r->s);
}

static void finish(run *r)
{
    scree_simulation_close(&r->s);
    scree_case_free(r->c);
}

#define SEQUENCE(m, n, q) "integrator.repeats=" #m, "integrator.large_multiple=" #n, "integrator.small_steps=" #q

/// Table 2.1: N_S / (m (1 + q)), exactly, and the time of every step.
static void force_evaluations_are_those_of_table_2_1(void **unused)
{
    (void)unused;
    static const char *const sequences[][3] = {
        {SEQUENCE(1, 50, 0)},  {SEQUENCE(2, 20, 5)}, {SEQUENCE(2, 15, 10)},
        {SEQUENCE(2, 10, 15)}, {SEQUENCE(5, 5, 5)},  {SEQUENCE(50, 1, 0)},
    };
    static const double theory[] = {50, 4.1667, 2.2727, 1.5625, 1.6667, 1};
    for (size_t k = 0; k < 6; k++) {
        run r;
        start(&r, 1, sequences[k], 3);
        assert_int_equal(r.s.model.largest_step, 50);
        uint64_t evaluations = r.s.state.evaluations, step = r.s.state.step;
        while (r.s.state.step < step + 2000) advance(&r, 1);
        assert_int_equal(r.s.state.step, step + 2000);
        assert_true(fabs(2000.0 / (double)(r.s.state.evaluations - evaluations) - theory[k]) < 5e-5);
        const scree_stage_state *stage = &r.s.state.stage;
        assert_true(scree_state_time(&r.s.state) == stage->first_time + 2000 * 1e-6);
        assert_int_equal(r.s.plan.interval % 50, 0);
        finish(&r);
    }
}

/// Runs position_verlet and the single sequence n + 0; positions, velocities and forces agree to the bit. How well the
/// sample is confined does not matter to that, and small steps to a small limit would take most of this test.
static void compare_with_position_verlet(const char *step, const char *multiple)
{
    const char *const soon = "stages.confine.unbalanced_limit=0.5";
    const char *const plain[] = {"integrator.scheme=position_verlet", step, soon};
    const char *const single[] = {"integrator.repeats=1", multiple, "integrator.small_steps=0", soon};
    run a, b;
    start(&a, 1, plain, 3);
    start(&b, 1, single, 4);
    advance(&a, 1500);
    advance(&b, 1500);
    assert_int_equal(a.s.state.evaluations, b.s.state.evaluations);
    assert_true(a.s.state.step_size == b.s.state.step_size);
    for (size_t id = 0; id < a.s.state.count; id++) {
        size_t i = a.s.state.row_of_id[id], j = b.s.state.row_of_id[id];
        assert_memory_equal(&a.s.state.row[i], &b.s.state.row[j], sizeof(scree_row));
        assert_memory_equal(&a.s.state.sum[i], &b.s.state.sum[j], sizeof(scree_sum_row));
    }
    assert_memory_equal(&a.s.state.ledger, &b.s.state.ledger, sizeof(scree_ledger));
    finish(&b);
    finish(&a);
}

static void the_limits_are_position_verlet(void **unused)
{
    (void)unused;
    compare_with_position_verlet("integrator.step=8e-6 s", "integrator.large_multiple=8"); // 8 times 1e-6 is exact
    compare_with_position_verlet("integrator.step=1e-6 s", "integrator.large_multiple=1");
}

/// A checkpoint in the middle of a sequence, read into another simulation with other threads.
static void a_sequence_goes_on_after_a_restart(void **unused)
{
    (void)unused;
    static const char *const overrides[] = {SEQUENCE(2, 20, 5)};
    char folder[64];
    run whole, part;
    assert_true(scratch_create(folder));
    start(&whole, 1, overrides, 3);
    for (int stop = 0; stop < 4; stop++) {
        advance(&whole, 301); // each time another place in the sequence of six
        simulation_reopen(&whole.s, 2, folder, &part.s);
        advance(&part, 200);
        advance(&whole, 200);
        assert_true(simulation_bits(&part.s) == simulation_bits(&whole.s));
        scree_simulation_close(&part.s);
    }
    finish(&whole);
    scratch_destroy(folder);
}

static void the_energy_balance_closes(void **unused)
{
    (void)unused;
    static const char *const overrides[] = {SEQUENCE(2, 20, 5)};
    run r;
    start(&r, 1, overrides, 3);
    double residual = r.s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL], turnover = r.s.state.ledger.turnover;
    double scheme = r.s.state.ledger.scheme, worst = 0;
    while (simulation_goes_on(&r.s)) {
        simulation_step(&r.s);
        if (!r.s.sampled) continue;
        double change = r.s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL] - residual;
        worst = fmax(worst, fabs(change) / (r.s.state.ledger.turnover - turnover));
    }
    double last = fabs(r.s.state.ledger.scheme - scheme) / (r.s.state.ledger.turnover - turnover);
    print_message("residual %.2g of the work, accumulated for changes of the step %.2g\n", worst, last);
    // The trapezoids' error at large steps of 2e-5 s, as with that step alone; well below what changes of the step do.
    assert_true(worst < 1e-5 && last > 10 * worst);
    finish(&r);
}

/// Mean slip over the loading after its first fifth, over v_R.
static double mean_slip(const char *const *overrides, size_t count)
{
    run r;
    double slip = 0, samples = 0;
    start(&r, 1, overrides, count);
    while (simulation_goes_on(&r.s)) {
        simulation_step(&r.s);
        if (!r.s.sampled || !(scree_axial_strain(&r.s) > 2e-3)) continue;
        slip += r.s.sample[SCREE_SAMPLE_SLIP_RATIO];
        samples++;
    }
    finish(&r);
    return slip / samples;
}

/// At the large step the explicit update leaves its slip turning round in every step (P figure 2.4); small steps, two
/// timescales and the implicit update at the large step do not. In eight samples of this size (seeds 3 to 10) turning
/// round adds 0.35 to 0.57 of v_R to a slip of 0.9 to 1.6; realisations of the other two differ by some 20 %.
static void implicit_friction_does_not_chatter(void **unused)
{
    (void)unused;
    for (int k = 0; k < 3; k++) {
        const char *const seed[] = {"seed=3", "seed=7", "seed=8"};
        const char *const large[] = {SEQUENCE(1, 50, 0), seed[k]}, *const two[] = {SEQUENCE(2, 20, 5), seed[k]};
        const char *const implicit[] = {SEQUENCE(1, 50, 0), seed[k], "contact.friction_update=implicit"};
        double chattering = mean_slip(large, 4), reference = mean_slip(two, 4), quiet = mean_slip(implicit, 5);
        print_message("slip over v_R: large steps %.3g, 2(20+5) %.3g, implicit %.3g\n", chattering, reference, quiet);
        assert_true(chattering > reference + 0.2 && fabs(quiet / reference - 1) < 0.4);
    }
}

/// A stage chooses for itself: confined implicitly, samples are those that a wholly implicit case confines, whatever
/// sequence loads them then; and they go on with the bits of a restart in either stage.
static void a_stage_chooses_its_friction_update(void **unused)
{
    (void)unused;
    static const char *const whole[] = {SEQUENCE(1, 50, 0), "contact.friction_update=implicit"};
    static const char *const confined[] = {SEQUENCE(2, 20, 5), "stages.confine.friction_update=implicit"};
    static const char *const explicit_alone[] = {SEQUENCE(2, 20, 5)};
    char folder[64];
    run a, b, c, part;
    assert_true(scratch_create(folder));
    start(&a, 1, whole, 4);
    start(&b, 1, confined, 4);
    start(&c, 1, explicit_alone, 3);
    for (size_t id = 0; id < a.s.state.count; id++) {
        const scree_row *here = &a.s.state.row[a.s.state.row_of_id[id]], *there = &b.s.state.row[b.s.state.row_of_id[id]];
        assert_memory_equal(here, there, sizeof *here);
    }
    assert_true(simulation_bits(&b.s) != simulation_bits(&c.s));
    assert_true(scree_model_predicts(&a.s.stage_model) && !scree_model_predicts(&b.s.stage_model));
    advance(&b, 300);
    simulation_reopen(&b.s, 2, folder, &part.s);
    advance(&part, 300);
    advance(&b, 300);
    assert_true(simulation_bits(&part.s) == simulation_bits(&b.s));
    scree_simulation_close(&part.s);
    finish(&a);
    finish(&b);
    finish(&c);
    scratch_destroy(folder);
}

/// What a stage may not choose: steps of two sizes while loading, and a law that has no such update.
static void a_stage_is_refused_what_its_law_or_steps_do_not_carry(void **unused)
{
    (void)unused;
    static const char *const sequence[] = {SEQUENCE(2, 20, 5), "stages.compress.friction_update=implicit"};
    static const char *const other_law[] = {"contact.law=hertz_mindlin", "integrator.scheme=velocity_verlet",
                                            "stages.confine.friction_update=implicit"};
    static const char *const one_size[] = {SEQUENCE(1, 50, 0), "stages.compress.friction_update=implicit"};
    case_refused(case_text, sequence, 4, "needs equal steps");
    case_refused(case_text, other_law, 3, "friction_update");
    scree_case_free(case_read(case_text, one_size, 4));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(force_evaluations_are_those_of_table_2_1), cmocka_unit_test(the_limits_are_position_verlet),
        cmocka_unit_test(a_sequence_goes_on_after_a_restart),       cmocka_unit_test(the_energy_balance_closes),
        cmocka_unit_test(implicit_friction_does_not_chatter),
        cmocka_unit_test(a_stage_chooses_its_friction_update),
        cmocka_unit_test(a_stage_is_refused_what_its_law_or_steps_do_not_carry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
