/// The stage `iterate`: factors of convergence against closed forms and the operator, what it leaves and what is
/// refused.
#include "io_scratch.h"
#include "run_fixture.h"

#include "integrate/integrate.h"
#include "specimen/from_state.h"
#include "specimen/stability.h"

#define STEEL(stiffness)                                                                                               \
    "materials:\n  - {name: steel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3,\n"                \
    "     friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: " stiffness ", damping_ratio: 0}\n"
#define QUIET "measure: {cells: no, samples: 1000}\noutput: {figures: no, paraview: no, snapshots: 0}\n"
#define ROW                                                                                                            \
    "scree: 1\nname: row\n" STEEL(                                                                                     \
        "0") "particles: {shape: disc, material: steel, count: 4, distribution: equal, radius: 1 mm, thickness: 1 "    \
             "m}\n"                                                                                                    \
             "contact: {law: linear, deformation: explicit}\nintegrator: {step: 1e-7 s}\nboundary: {periodic: "        \
             "x}\n" QUIET "stages:\n"                                                                                  \
             "  - {stage: prepare, method: bodies, width: 7.96 mm, bodies: [{position: [0.5 mm, 1 mm]},\n"             \
             "     {position: [2.49 mm, 1 mm]}, {position: [4.48 mm, 1 mm]}, {position: [6.47 mm, 1 mm]}]}\n"          \
             "  - {stage: bond, rest: geometric, overlap_tolerance: 20 um}\n"                                          \
             "  - {stage: iterate, boundary: none, iterations: 1000}\n"

static double result_of(const char *name)
{
    char text[64];
    scree_error error;
    check(scree_result_get(scratch, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

static void run_of(const char *text, const char *const *overrides, size_t count)
{
    scree_case *c = case_read(text, overrides, count);
    scree_error error;
    const scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
}

// ---- a row -------------------------------------------------------------------------------------------------------

/// M 3.25: changes go by -2 k_n / k_p; theta of the way in each makes that 1 - theta (1 + 2 k_n / k_p).
static void a_row_converges_as_its_stiffness_says(void **unused)
{
    static const struct {
        const char *text;
        double modulus, share;
        int ends; ///< 1: converged, 0: diverges
    } cases[] = {{"3e11", 3e11, 1, 1},     {"1e11", 1e11, 1, 1},   {"7.9e10", 7.9e10, 1, 0},
                 {"7.5e10", 7.5e10, 1, 0}, {"2e11", 2e11, 0.3, 1}, {"2e10", 2e10, 0.3, 1}};
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char young[64], share[64];
        (void)snprintf(young, sizeof young, "materials.steel.young_modulus=%s", cases[k].text);
        (void)snprintf(share, sizeof share, "contact.relaxation=%g", cases[k].share);
        const char *const overrides[] = {young, "contact.deformation=relaxed", share};
        run_of(ROW, overrides, cases[k].share < 1 ? 3 : 1);
        const double disc = M_PI * cases[k].modulus / (2 * (1 - 0.35 * 0.35)), ratio = 2 * 7e10 / disc;
        const double factor = fabs(1 - cases[k].share * (1 + ratio)), found = result_of("convergence_factor");
        const double iterations = result_of("iterations");
        print_message("E %s: factor %.6f, departure %.2g, %.0f iterations\n", cases[k].text, found, found / factor - 1,
                      iterations);
        // Changes above 1e-7 of the strains, which forces round to 2^-50 of a bound some hundred times the force.
        assert_true(fabs(found / factor - 1) < 1e-5 && result_of("energy_residual") < 1e-12);
        const double expected = 7e10 / (1 + ratio) * 1e-5;
        if (cases[k].ends) assert_true(fabs(result_of("force") / expected - 1) < 1e-8 && iterations < 1000);
        // From the first change a tenfold one: ln 10 / ln 1.0428 = 55.
        if (factor > 1) assert_true(fabs(iterations - 2 - log(10) / log(factor)) < 2);
    }
}

// ---- a lattice ---------------------------------------------------------------------------------------------------

#define BLOCK                                                                                                          \
    "scree: 1\nname: block\nseed: 4\n" STEEL(                                                                          \
        "0.5") "particles: {shape: disc, material: steel, count: 60, distribution: equal, radius: 1 mm, thickness: 1 " \
               "m}\n"                                                                                                  \
               "contact: {law: linear, deformation: explicit}\nintegrator: {step: 5e-8 s}\n" QUIET "selections:\n"     \
               "  - {select: side, name: low, side: bottom}\n  - {select: side, name: high, side: top}\n"              \
               "loads:\n  - {load: prescribed, selection: high, until: press, velocity_y: -50 mm/s}\n"                 \
               "  - {load: prescribed, selection: low, until: press, velocity_y: 0}\n"                                 \
               "stages:\n  - {stage: prepare, method: hexagonal, aspect_ratio: 1}\n  - {stage: bond}\n"                \
               "  - {stage: relax, name: press, boundary: none, duration: 10 us}\n"                                    \
               "  - {stage: iterate, boundary: none, iterations: 400, tolerance: 1e-12}\n"                             \
               "  - {stage: relax, name: free, boundary: none, duration: 1 us}\n"

static void enter(scree_simulation *s, int64_t stage)
{
    while (simulation_goes_on(s) && (s->state.stage.index != stage || s->state.stage.counter < 0)) simulation_step(s);
}

static double iterate_state(const scree_simulation *s, const char *name)
{
    for (size_t k = 0; k < scree_field_total(); k++)
        if (strcmp(scree_field_at(k)->name, name) == 0)
            return *(const double *)scree_field_get(&s->state, scree_field_at(k), 0);
    fail_msg("there is no field %s", name);
    return NAN;
}

/// 2 k_n / k_p enough for some hundred iterates, in which the first mode is left alone.
static const char *const soft[] = {"materials.steel.young_modulus=95 GPa"};

/// The factor is the spectral radius of B that the operator finds on the same specimen; nothing moves meanwhile, the
/// balance stays closed with the motion taken out, and the forces converge.
static void a_block_converges_as_the_operator_says(void **unused)
{
    (void)unused;
    scree_case *c = case_read(BLOCK, soft, 1);
    scree_simulation s;
    scree_specimen specimen;
    scree_error error;
    double radius;
    simulation_open(c, 1, &s);
    enter(&s, 3);
    check(scree_specimen_of_state(&s.stage_model, &s.state, &s.work, &specimen, &error), &error);
    check(scree_spectral_radius(&specimen, &radius, NULL, &error), &error);
    scree_specimen_destroy(&specimen);
    scree_vector before[60], place, velocity, spin;
    for (size_t id = 0; id < 60; id++) scree_body_position(&s.state, s.state.row_of_id[id], before[id]);
    const double held = iterate_state(&s, "iterate/held");
    double worst = 0, factor = NAN, earlier = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE];
    while (simulation_goes_on(&s) && s.state.stage.index == 3) {
        simulation_step(&s);
        if (s.state.stage.index == 3) factor = iterate_state(&s, "iterate/factor");
        worst = simulation_residual(&s, worst);
        for (size_t id = 0; id < 60 && s.state.stage.index == 3; id++) {
            scree_body_position(&s.state, s.state.row_of_id[id], place);
            scree_body_motion(&s.state, s.state.row_of_id[id], velocity, spin);
            for (int k = 0; k < 3; k++) assert_true(place[k] == before[id][k]);
            assert_true(scree_length(velocity) == 0 && scree_length(spin) == 0);
        }
    }
    print_message("factor %.7f, operator %.7f; %.2g J held, residual %.2g, before %.2g\n", factor, radius, held, worst,
                  earlier);
    assert_true(held > 0 && worst < 1e-6);
    // What is left of the second mode, (b_2 / b_1)^k.
    assert_true(fabs(factor / radius - 1) < 1e-3);
    worst = fmax(worst, simulation_finish(&s));
    assert_true(worst < 1e-6);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Bodies that are held do not fall, whatever the step rounds.
static void weight_is_held(void **unused)
{
    (void)unused;
    static const char *const heavy[] = {"gravity=[0, -9.81]", "materials.steel.young_modulus=79 GPa"};
    scree_case *c = case_read(ROW, heavy, 2);
    scree_simulation s;
    double worst = 0;
    simulation_open(c, 1, &s);
    enter(&s, 2);
    for (int k = 0; k < 100; k++) {
        simulation_step(&s);
        worst = simulation_residual(&s, worst);
        for (size_t row = 0; row < s.state.count; row++) {
            scree_vector force, torque;
            assert_true(s.state.row[row].y == 1e-3);
            scree_body_force(&s.stage_model, &s.state, row, force, torque);
            assert_true(scree_length(force) <= s.state.force_quantum && scree_length(torque) == 0);
        }
    }
    assert_true(worst < 1e-12);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void bits_do_not_depend_on_threads_or_restarts(void **unused)
{
    (void)unused;
    uint64_t bits[4];
    scree_case *c = case_read(BLOCK, NULL, 0);
    for (int k = 0; k < 4; k++) {
        const int threads[] = {1, 2, 7, 2};
        scree_simulation s, other;
        simulation_open(c, threads[k], &s);
        s.work.keep_threads = true;
        enter(&s, 3);
        for (int step = 0; step < 20; step++) simulation_step(&s);
        if (k == 3) {
            simulation_reopen(&s, 1, scratch, &other);
            scree_simulation_close(&s);
            s = other;
        }
        for (int step = 0; step < 20; step++) simulation_step(&s);
        assert_true(s.state.stage.index == 3);
        for (size_t row = 0; row < s.state.count; row++)
            assert_true(s.state.row[row].x == s.state.reference[row][0] &&
                        s.state.row[row].y == s.state.reference[row][1]);
        bits[k] = simulation_close(&s);
        assert_true(bits[k] == bits[0]);
    }
    scree_case_free(c);
}

// ---- what is refused ---------------------------------------------------------------------------------------------

static void what_cannot_iterate_is_refused(void **unused)
{
    static const char *const how[] = {"contact.deformation=none", "contact.deformation=implicit"};
    (void)unused;
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_problems *problems;
        assert_true(case_parse(ROW, &how[k], 1, &c, &problems) != SCREE_OK);
        bool said = false;
        for (size_t p = 0; p < scree_problems_count(problems); p++)
            said = said || strstr(scree_problems_get(problems, p)->message, "there is nothing to iterate");
        assert_true(said);
        scree_problems_free(problems);
    }
    // A load that goes on.
    const char *const on[] = {"loads.0.until=iterate"};
    scree_case *c = case_read(BLOCK, on, 1);
    scree_simulation s;
    scree_error error;
    simulation_open(c, 1, &s);
    enter(&s, 3);
    assert_int_equal(scree_simulation_step(&s, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "holds all particles, and a load moves particle"));
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_row_converges_as_its_stiffness_says, make_scratch, remove_scratch),
        cmocka_unit_test(a_block_converges_as_the_operator_says),
        cmocka_unit_test(weight_is_held),
        cmocka_unit_test_setup_teardown(bits_do_not_depend_on_threads_or_restarts, make_scratch, remove_scratch),
        cmocka_unit_test(what_cannot_iterate_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
