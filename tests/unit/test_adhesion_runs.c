/// Runs of grains that stick: impacts against e^2 = 1 - (v_s / v)^2 (Thornton and Ning 1998) and against the integrated
/// motion with dashpots, momentum and the ledger; grains that hang below a ceiling; and an assembly with necks, of
/// which nothing but the state decides: threads, instruction sets, age of the lists, a restart in mid-neck.
#include "run_fixture.h"

#include "net_variations.h"
#include "periodic_fixture.h"
#include "run/stage_collide.h"
#include "theory/adhesion.h"

// ---- impacts
// ---------------------------------------------------------------------------------------------------------

static const char impact_text[] =
    "scree: 1\n"
    "materials:\n"
    "  - {name: glass, young_modulus: 1 MPa, poisson_ratio: 0.3, density: 2500 kg/m3, friction: 0.3, restitution: 1,\n"
    "     surface_energy: 0.05 J/m2}\n"
    "particles: {material: glass, count: 2, distribution: equal, radius: 50 um}\n"
    "contact: {law: hertz_jkr}\n"
    "integrator: {scheme: velocity_verlet, step: 4e-8 s}\n"
    "stages:\n"
    "  - {stage: prepare, method: pair, speed: 1 m/s}\n"
    "  - {stage: collide}\n"
    "guard: {overlap: 50 %}\n"
    "measure: {cells: no, samples: 50}\n";

typedef struct outcome {
    double restitution; ///< 0: it stuck
    double theory, sticking, speed, momentum, residual, damping, loss;
    double step_energy; ///< F_c v dt over the energy of the impact
} outcome;

static outcome collide(const char *const *overrides, size_t count)
{
    scree_case *c = case_read(impact_text, overrides, count);
    scree_simulation s;
    scree_error error;
    outcome o = {0};
    simulation_open(c, 1, &s);
    simulation_step(&s); // prepare
    const scree_row *a = &s.state.row[0], *b = &s.state.row[1];
    const double mass = a->mass * b->mass / (a->mass + b->mass);
    const scree_pair_constants *pair = &s.model.pairs[0][0];
    const scree_adhesion of = {.jkr = s.model.laws[0].law == SCREE_SLOT_hertz_jkr,
                               .stiffness = pair->value[HERTZ_NORMAL],
                               .root = pair->value[ADHESIVE_ROOT],
                               .radius = a->radius * b->radius / (a->radius + b->radius)};
    o.speed = fabs(a->vx - b->vx);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        o.momentum = fmax(o.momentum, fabs(a->mass * a->vx + b->mass * b->vx) / (a->mass * o.speed));
        if (s.sampled) o.residual = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL] / (0.5 * mass * o.speed * o.speed);
    }
    scree_impact impact;
    check(scree_impact_adhesive(&of, pair->value[HERTZ_DAMPING], mass, o.speed, &impact, &error), &error);
    o.theory = impact.restitution;
    o.sticking = scree_adhesion_sticking_speed(&of, mass);
    o.step_energy = scree_adhesion_pull_off(&of) * s.model.step / (0.5 * mass * o.speed);
    if (strstr(s.reason, "parted")) o.restitution = fabs(a->vx - b->vx) / o.speed;
    o.damping = s.state.ledger.damping;
    o.loss = scree_adhesion_loss(&of);
    scree_simulation_close(&s);
    scree_case_free(c);
    return o;
}

/// The break is found to a step, F_c u dt of energy: first order.
static void restitution_is_that_of_thornton_and_ning(void **unused)
{
    (void)unused;
    static const char *const speed[] = {"stages.prepare.speed=0.235 m/s", "stages.prepare.speed=0.3 m/s",
                                        "stages.prepare.speed=0.6 m/s", "stages.prepare.speed=2 m/s"};
    double wide = 0, narrow = 0;
    for (int solid = 0; solid < 2; solid++)
        for (int k = 0; k < 4; k++) {
            const char *overrides[] = {solid ? "dimension=3" : "dimension=2",
                                       solid ? "particles.shape=sphere" : "particles.shape=disc",
                                       solid ? speed[k] : speed[3 - k], "integrator.step=4e-8 s"};
            outcome coarse = collide(overrides, 4);
            overrides[3] = "integrator.step=1e-8 s";
            outcome fine = collide(overrides, 4);
            const double ratio = fine.sticking / fine.speed, wanted = sqrt(fmax(0, 1 - ratio * ratio));
            assert_true(fine.theory == wanted || fabs(fine.theory - wanted) < 1e-14);
            print_message(
                "v / v_s %.3f: e %.5f, with a quarter of the step %.5f, closed form %.5f; residual %.2g, %.2g\n",
                1 / ratio, coarse.restitution, fine.restitution, wanted, coarse.residual, fine.residual);
            assert_true(fabs(coarse.restitution * coarse.restitution - wanted * wanted) < coarse.step_energy);
            assert_true(fabs(fine.restitution * fine.restitution - wanted * wanted) < fine.step_energy);
            assert_true(fine.step_energy < 2e-3);
            assert_true(coarse.momentum < 1e-12 && fine.momentum < 1e-12);
            // Second order, and 3/2 from the break, where it counts at which part of a step the neck goes.
            assert_true(fabs(coarse.residual) < 1e-4 && fabs(fine.residual) < fabs(coarse.residual) / 4);
            wide += fabs(coarse.residual), narrow += fabs(fine.residual);
            assert_true(fabs(fine.damping / fine.loss - 1) < 2 * fine.step_energy / (ratio * ratio));
        }
    print_message("residuals fall with the power %.3g of the step\n", log(wide / narrow) / log(4));
    assert_true(wide > 8 * narrow);
}

static void slow_grains_stick(void **unused)
{
    (void)unused;
    const char *overrides[] = {"dimension=3", "particles.shape=sphere", "stages.prepare.speed=0.22 m/s",
                               "integrator.step=1e-8 s"};
    outcome o = collide(overrides, 4);
    assert_true(o.speed < o.sticking && o.speed > 0.9 * o.sticking && o.restitution == 0 && o.theory == 0);
    assert_true(fabs(o.residual) < 1e-5);
}

static void dashpots_take_their_part(void **unused)
{
    (void)unused;
    static const char *const law[] = {"contact.law=hertz_jkr", "contact.law=hertz_dmt"};
    for (int k = 0; k < 2; k++) {
        const char *overrides[] = {"dimension=3", "particles.shape=sphere", "materials.0.restitution=0.7",
                                   "integrator.step=5e-9 s", law[k]};
        outcome o = collide(overrides, 5);
        assert_true(o.theory > 0.4 && o.theory < 0.7);
        assert_true(fabs(o.restitution - o.theory) < 2e-4);
        assert_true(fabs(o.residual) < 1e-5);
    }
}

/// DMT has no neck: what does not stick by dashpots parts with all that it had.
static void dmt_loses_nothing(void **unused)
{
    (void)unused;
    const char *overrides[] = {"dimension=3", "particles.shape=sphere", "contact.law=hertz_dmt",
                               "integrator.step=1e-8 s"};
    outcome o = collide(overrides, 4);
    assert_true(o.theory == 1 && fabs(o.restitution - 1) < 2e-3);
    assert_true(fabs(o.residual) < 1e-5);
}

static void refuse(const char *override, const char *words, const char *field)
{
    const char *overrides[] = {"dimension=3", "particles.shape=sphere", override};
    scree_case *c = case_read(impact_text, overrides, 3);
    scree_simulation s;
    scree_error error = {0};
    assert_int_equal(scree_simulation_open(c, 1, &s, &error), SCREE_ERROR_INPUT);
    if (!strstr(error.message, words)) fail_msg("%s", error.message);
    assert_string_equal(error.field, field);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void cohesion_that_is_too_strong_is_refused(void **unused)
{
    (void)unused;
    refuse("materials.0.surface_energy=50 J/m2", "cohesion too strong", "materials.0.surface_energy");
    refuse("contact={law: hertz_jkr, work_of_adhesion: 100 J/m2}", "cohesion too strong", "materials.0.surface_energy");
    refuse("integrator.step=1e-5 s", "the cohesion of this case counts", "integrator.step");
}

static void check_tells_the_tabor_parameter(void **unused)
{
    (void)unused;
    const char *overrides[] = {"dimension=3", "particles.shape=sphere", "contact.law=hertz_mindlin"};
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(impact_text, overrides, k ? 3 : 2);
        scree_case_summary summary;
        scree_error error;
        check(scree_case_summarise(c, &summary, &error), &error);
        // (25 um (0.1 / 0.5495 MPa)^2 / (0.3 nm)^3)^(1/3)
        const double ebar = 1e6 / (2 * (1 - 0.09)), wanted = cbrt(25e-6 * pow(0.1 / ebar, 2)) / 3e-10;
        assert_true(k ? isnan(summary.tabor) : fabs(summary.tabor / wanted - 1) < 1e-12);
        scree_case_free(c);
    }
}

// ---- below a ceiling -----------------------------------------------------------------------------------------------

static const char ceiling_text[] = "scree: 1\n"
                                   "materials:\n"
                                   "  - {name: glass, young_modulus: 1 MPa, poisson_ratio: 0.3, density: 2500 kg/m3, "
                                   "friction: 0.3, restitution: 0.2}\n"
                                   "particles: {material: glass, count: 1, distribution: equal, radius: 1 mm}\n"
                                   "integrator: {scheme: velocity_verlet}\n"
                                   "measure: {cells: no, samples: 20}\n";

/// Height of the centre in the end [m]; with `lists`, which are thrown away in between; bits of the state.
static double hang(int dimension, const char *work, bool lists, uint64_t *bits, scree_adhesion *of, double *weight)
{
    const char *overrides[] = {
        dimension == 3 ? "dimension=3" : "dimension=2",
        dimension == 3 ? "particles.shape=sphere" : "particles.shape=disc",
        "contact={law: hertz_jkr}",
        work,
        dimension == 3 ? "walls=[{shape: plane, point: [0, 0, 0], normal: [0, 0, -1]}]"
                       : "walls=[{shape: plane, point: [0, 0], normal: [0, -1]}]",
        dimension == 3 ? "gravity=[0, 0, -9.81]" : "gravity=[0, -9.81]",
        dimension == 3 ? "stages=[{stage: prepare, method: bodies, bodies: [{position: [1 mm, 1 mm, -0.9999 mm]}]}, "
                         "{stage: relax, duration: 60 ms}]"
                       : "stages=[{stage: prepare, method: bodies, bodies: [{position: [1 mm, -0.9999 mm]}]}, "
                         "{stage: relax, duration: 60 ms}]"};
    scree_case *c = case_read(ceiling_text, overrides, 7);
    scree_simulation s;
    scree_vector place;
    simulation_open(c, 1, &s);
    simulation_step(&s);
    for (int k = 0; simulation_goes_on(&s); k++) {
        if (lists && k % 37 == 36) simulation_lose_work(&s, 1);
        simulation_step(&s);
    }
    *of = (scree_adhesion){true, s.model.surfaces[0][0].value[HERTZ_NORMAL],
                           s.model.surfaces[0][0].value[ADHESIVE_ROOT], s.state.row[0].radius};
    *weight = s.state.row[0].mass * 9.81;
    scree_body_position(&s.state, 0, place);
    *bits = simulation_close(&s);
    scree_case_free(c);
    return place[dimension - 1];
}

static void what_sticks_hangs_below_a_ceiling(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        uint64_t bits, again;
        scree_adhesion of;
        double weight;
        // Half again as much as the pull-off force needs, and that much less.
        const char *enough =
            dimension == 3 ? "contact.work_of_adhesion=0.0327 J/m2" : "contact.work_of_adhesion=0.0491 J/m2";
        double height = hang(dimension, enough, false, &bits, &of, &weight);
        assert_true(scree_adhesion_pull_off(&of) > 1.2 * weight && scree_adhesion_pull_off(&of) < 1.8 * weight);
        const double overlap = scree_adhesion_overlap(&of, scree_adhesion_area_of_force(&of, -weight));
        print_message("%dD: hangs with an overlap of %.6g m\n", dimension, height + of.radius);
        assert_true(fabs(height + of.radius - overlap) < 1e-4 * scree_adhesion_neck(&of));
        (void)hang(dimension, enough, true, &again, &of, &weight);
        assert_true(again == bits);
        height = hang(dimension, "contact.work_of_adhesion=0.01 J/m2", false, &bits, &of, &weight);
        assert_true(height < -5e-3);
    }
}

// ---- an assembly
// -----------------------------------------------------------------------------------------------------

enum { STEPS = 400 };

static size_t count_necks(periodic_sample *s)
{
    scree_contact_table table = {0};
    scree_error error;
    size_t count = 0;
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    for (size_t c = 0; c < table.count; c++) count += table.contact[c].overlap < 0;
    scree_contact_table_destroy(&table);
    return count;
}

static size_t fewest, most;

/// A net that is pulled apart, so that many contacts are necks and some break.
static uint64_t run(int dimension, unsigned directions, int threads, int set, bool reference, int disturbance)
{
    const double pull = 450, gradient[9] = {pull, 40, 0, 0, pull, 0, 0, 0, dimension == 3 ? pull : 0};
    periodic_sample s;
    scree_error error;
    (void)directions;
    periodic_fill(&s, dimension, dimension == 3 ? 5 : 9, HERTZ_JKR, 0.5);
    law_stick(&s.model, 4e-3, 1.2e-3);
    scree_work_destroy(&s.work);
    check(scree_work_create(&s.work, &s.model, threads, &error), &error);
    s.work.keep_threads = true;
    s.work.instruction_set = set;
    s.work.reference_kernel = reference;
    memcpy(scree_cell(&s.state)->gradient, gradient, sizeof gradient);
    periodic_forces(&s);
    for (int k = 0; k < STEPS; k++) {
        if (disturbance == 1 && k % 7 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == 2 && k % 50 == 49) { // what contacts remember goes through the state into a new list
            check(scree_contacts_save(&s.state, &s.work, &error), &error);
            scree_contact_scratch_destroy(&s.work);
            scree_work_destroy(&s.work);
            check(scree_work_create(&s.work, &s.model, threads, &error), &error);
        }
        periodic_step(&s);
        if (k % 50 == 0 && threads == 1) {
            const size_t necks = count_necks(&s);
            fewest = necks < fewest ? necks : fewest, most = necks > most ? necks : most;
        }
    }
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    const uint64_t checksum = scree_state_checksum(&s.model, &s.state);
    periodic_destroy(&s);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    fewest = SIZE_MAX, most = 0;
    assert_nothing_but_the_state_decides(run, 2);
    print_message("%zu to %zu necks\n", fewest, most);
    assert_true(most > 20 && fewest < most);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restitution_is_that_of_thornton_and_ning),
        cmocka_unit_test(slow_grains_stick),
        cmocka_unit_test(dashpots_take_their_part),
        cmocka_unit_test(dmt_loses_nothing),
        cmocka_unit_test(cohesion_that_is_too_strong_is_refused),
        cmocka_unit_test(check_tells_the_tabor_parameter),
        cmocka_unit_test(what_sticks_hangs_below_a_ceiling),
        cmocka_unit_test(nothing_but_the_state_decides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
