/// Stage `compress` by the velocity of its plates: how they move, the rate that it amounts to, what is refused.
#include "run_fixture.h"
#include "simulation_cases.h"

#include "boundary/plates.h"
#include "model/critical_step.h"
#include "run/loading.h"
#include "run/quasistatic.h"
#include "state/plates.h"

static const double SPEED = 1.5e-3;
static const char *const by_velocity[] = {"stages.compress.rate=auto", "stages.compress.velocity=1.5 mm/s"};

/// Both plates, as fast as they are told behind the rise; the stage ends at its strain.
static void plates_have_their_velocity(void **unused)
{
    (void)unused;
    scree_case *c = case_read(SIMULATION_SMALL, by_velocity, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    const double height = scree_loading_of(&s.state)->height, rise = s.plan.ramp_time;
    const scree_wall *wall = scree_plates(&s.state);
    const double begin[2] = {wall[SCREE_WALL_BOTTOM].position, wall[SCREE_WALL_TOP].position};
    double fast = 0, worst = 0, way[2] = {0, 0}, strain = 0, time = 0;
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (!simulation_goes_on(&s)) break;
        time = scree_state_time(&s.state) - s.state.stage.first_time;
        fast = fmax(fast, wall[SCREE_WALL_TOP].velocity);
        worst = fmax(worst, fabs(wall[SCREE_WALL_TOP].velocity / wall[SCREE_WALL_BOTTOM].velocity - 1));
        way[0] = fabs(wall[SCREE_WALL_BOTTOM].position - begin[0]);
        way[1] = fabs(wall[SCREE_WALL_TOP].position - begin[1]);
        strain = (way[0] + way[1]) / height;
    }
    print_message("height %.4g m, rise %.3g s, plates %.9g m/s, strain %.5f, rate %.6g 1/s\n", height, rise, fast,
                  strain, scree_model_loading_rate(&s.model, &s.model.stages[2]));
    // What a factor and its inverse leave of a velocity; of ways, sums of 3000 small ones to places of 8 mm.
    assert_true(fabs(fast / SPEED - 1) < 1e-15 && worst == 0 && fabs(way[0] / way[1] - 1) < 1e-9);
    assert_true(fabs(strain / 0.005 - 1) < 0.02);
    // Behind the cubic rise the way is that of a plate which began half of it later; a step is not known of.
    const double expected = SPEED * (time - 0.5 * rise);
    assert_true(fabs(way[0] / expected - 1) < 2 * SPEED * s.state.tick / expected);
    // What is expected before there is a sample: its height by the solid fraction of all, 0.8.
    const double rate = scree_model_loading_rate(&s.model, &s.model.stages[2]);
    assert_true(fabs(rate / (2 * SPEED / height) - 1) < 0.1);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// A rate of 2 v / height is the same stage, bit for bit.
static void a_rate_is_the_same(void **unused)
{
    (void)unused;
    uint64_t bits[2];
    char rate[64] = "";
    for (int k = 0; k < 2; k++) {
        const char *const by_rate[] = {rate, "contact.reference_velocity=1e-4 m/s"};
        const char *const given[] = {by_velocity[0], by_velocity[1], by_rate[1]};
        scree_case *c = case_read(SIMULATION_SMALL, k ? by_rate : given, k ? 2 : 3);
        scree_simulation s;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        if (!k)
            (void)snprintf(rate, sizeof rate, "stages.compress.rate=%.17g",
                           2 * SPEED / scree_loading_of(&s.state)->height);
        for (int step = 0; step < 400; step++) simulation_step(&s);
        bits[k] = simulation_close(&s);
        scree_case_free(c);
    }
    assert_true(bits[0] == bits[1]);
}

#define BLOCK                                                                                                          \
    "scree: 1\nname: block\n"                                                                                          \
    "materials: [{name: steel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0.5,\n"     \
    "  normal_stiffness: 7e10 N/m, stiffness_ratio: 0.5, damping_ratio: 0}]\n"                                         \
    "particles: {shape: disc, material: steel, count: 60, distribution: equal, radius: 1 mm, thickness: 1 m}\n"        \
    "contact: {law: linear}\nintegrator: {step: 5e-8 s}\nboundary: {lateral: pressure}\n"                              \
    "loads: [{load: background_damping, translation: 0.2, rotation: 0.2}]\n"                                           \
    "measure: {cells: no, samples: 50}\noutput: {figures: no, paraview: no}\nstages:\n"                                \
    "  - {stage: prepare, method: hexagonal, aspect_ratio: 1}\n  - {stage: bond}\n"                                    \
    "  - {stage: compress, velocity: 5 mm/s, strain: 0.02 %}\n"

/// M 4.3: bonds hold the block, its sides are free, and the plates move at 5 mm/s each. The stress of the plates rises
/// with their way.
static void a_bonded_block_needs_no_pressure(void **unused)
{
    (void)unused;
    scree_case *c = case_read(BLOCK, NULL, 0);
    scree_simulation s;
    double fast = 0, worst = 0, stress[2] = {0, 0}, strain[2] = {0, 0};
    simulation_open(c, 1, &s);
    simulation_load(&s);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        worst = simulation_residual(&s, worst);
        if (!simulation_goes_on(&s)) break;
        const int half = scree_axial_strain(&s) > 1e-4;
        fast = fmax(fast, scree_plates(&s.state)[SCREE_WALL_TOP].velocity);
        stress[half] = scree_plate_stress(&s.stage_model, &s.state, SCREE_WALL_TOP);
        strain[half] = scree_axial_strain(&s);
    }
    print_message("%.6g m/s, %.4g Pa at %.4g, %.4g at %.4g, residual %.2g\n", fast, stress[0], strain[0], stress[1],
                  strain[1], worst);
    assert_true(fabs(fast / 5e-3 - 1) < 1e-15 && worst < 1e-6);
    // What swings is damped, not gone.
    assert_true(fabs(stress[1] / stress[0] / 2 - 1) < 0.1 && strain[1] > 1.9e-4);
    scree_simulation_close(&s);
    scree_case_free(c);
    // Without bonds something has to press.
    scree_problems *problems;
    static const char *const loose[] = {"stages=[{stage: prepare, method: hexagonal, aspect_ratio: 1}, {stage: "
                                        "compress, velocity: 5 mm/s, strain: 0.02 %}]"};
    assert_true(case_parse(BLOCK, loose, 1, &c, &problems) != SCREE_OK);
    assert_non_null(strstr(scree_problems_get(problems, 0)->message, "a confine stage must come before"));
    scree_problems_free(problems);
}

static void expect_problem(const char *const *overrides, size_t count, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    assert_true(case_parse(SIMULATION_SMALL, overrides, count, &c, &problems) != SCREE_OK);
    bool said = false;
    for (size_t p = 0; p < scree_problems_count(problems); p++)
        said = said || strstr(scree_problems_get(problems, p)->message, message);
    if (!said) print_message("not said: %s\n", message);
    assert_true(said);
    scree_problems_free(problems);
}

static void wrong_ways_to_say_it_are_refused(void **unused)
{
    (void)unused;
    const char *const both[] = {"stages.compress.velocity=1 mm/s"}, *const none[] = {"stages.compress.rate=auto"};
    const char *const free[] = {by_velocity[0], by_velocity[1], "stages.compress.boundary=minimal"};
    expect_problem(both, 1, "rate is given: give one of the two");
    expect_problem(none, 1, "how fast is not said");
    expect_problem(free, 3, "has no plates that could have a velocity");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plates_have_their_velocity),
        cmocka_unit_test(a_rate_is_the_same),
        cmocka_unit_test(a_bonded_block_needs_no_pressure),
        cmocka_unit_test(wrong_ways_to_say_it_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
