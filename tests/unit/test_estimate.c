/// What a case is said to take before it runs: steps of every kind of stage against the steps that are taken, memory
/// and the parts of the time.
#include "run_fixture.h"

#include "run/estimate.h"
#include "small_cases.h"

#define HEAD "scree: 1\nseed: 3\nmaterials:\n" SMALL_QUARTZ
#define PLAIN                                                                                                          \
    "scree: 1\nseed: 3\n"                                                                                              \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45}\n"
#define DISCS HEAD SMALL_DISCS("60", "1e-3")
#define ROTATED                                                                                                        \
    PLAIN "particles: {material: quartz, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"                           \
          "contact: {law: hertz_brilliantov, damping_time: 2 ms, friction_update: implicit, reference_velocity: 1e-4 " \
          "m/s}\n"                                                                                                     \
          "integrator: {scheme: position_verlet}\n"                                                                    \
          "boundary: {every: 100}\n"                                                                                   \
          "stages:\n"                                                                                                  \
          "  - {stage: prepare, outline: circle}\n"                                                                    \
          "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-3, boundary: minimal}\n"                       \
          "  - {stage: rotate_particle, boundary: minimal, spin: 0.03 rad/s, rest_time: 10 ms, ramp_time: 10 ms, "     \
          "hold_time: 10 ms}\n"
#define SHEARED                                                                                                        \
    HEAD "particles: {material: quartz, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"                            \
         "measure: {samples: 20}\n"                                                                                    \
         "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                               \
         "boundary: {periodic: xy}\n"                                                                                  \
         "stages:\n"                                                                                                   \
         "  - {stage: prepare, method: gas, solid_fraction: 60 %}\n"                                                   \
         "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-3}\n"                                           \
         "  - {stage: deform, velocity_gradient: {xy: 0.2 1/s}, stress: {yy: 100 kPa}, strain: 0.2 %}\n"
#define POURED HEAD SMALL_POUR
#define STRUCK                                                                                                         \
    PLAIN "particles: {material: quartz, count: 2, distribution: equal, radius: 0.75 mm}\n"                            \
          "contact: {law: hertz_brilliantov, damping_time: 2 ms, reference_velocity: 7.5e-6 m/s}\n"                    \
          "stages:\n"                                                                                                  \
          "  - {stage: prepare, method: pair}\n"                                                                       \
          "  - {stage: collide}\n"

typedef struct stage_case {
    const char *text, *overrides[6];
} stage_case;

static const stage_case cases[] = {
    {DISCS, {NULL}},
    {DISCS, {"integrator={scheme: two_timescales, repeats: 2, large_multiple: 4, small_steps: 1}", NULL}},
    {SHEARED, {NULL}},
    {ROTATED, {NULL}},
    {POURED, {NULL}},
    {STRUCK, {NULL}},
};

static scree_case *read_case(const stage_case *from)
{
    size_t count = 0;
    while (from->overrides[count]) count++;
    return case_read(from->text, from->overrides, count);
}

/// A confinement is known by experience: small samples take other numbers of wave times than those of the table. All
/// other stages: 1.1, since the step of an imposed boundary ends a sample late (1/20), and an impact meets round-off.
static void check_stage(const scree_simulation *s, int64_t index, double expected)
{
    double taken = (double)(s->state.evaluations - s->state.stage.first_evaluations);
    double factor = s->model.stages[index].kind == SCREE_SLOT_confine ? 2.5 : 1.1;
    print_message("%s: %.0f steps, expected %.0f\n", s->model.stages[index].name, taken, expected);
    assert_true(expected > taken / factor && expected < taken * factor);
}

static void test_steps_of_every_stage(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scree_case *c = read_case(&cases[k]);
        scree_error error;
        scree_simulation s;
        scree_probe probe;
        assert_int_equal(scree_simulation_open(c, 1, &s, &error), SCREE_OK);
        assert_int_equal(scree_probe_measure(c, scree_longest_stage(&s.model), &probe, &error), SCREE_OK);
        assert_true(probe.step > 0 && probe.sample > 0 && probe.rebuild > 0);
        while (s.state.stage.index < c->config.stage_count) {
            assert_int_equal(scree_simulation_step(&s, &error), SCREE_OK);
            int64_t index = s.state.stage.index;
            if (s.stage_ended && index > 0)
                check_stage(&s, index, scree_stage_expect(&s.model, index, probe.collision).steps);
        }
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

static scree_case_summary summarise(const char *first, const char *second)
{
    const char *overrides[] = {first, second};
    scree_case *c = case_read(DISCS, overrides, second ? 2 : first ? 1 : 0);
    scree_case_summary summary;
    scree_error error;
    assert_int_equal(scree_case_summarise(c, &summary, &error), SCREE_OK);
    scree_case_free(c);
    return summary;
}

/// Only what does not depend on the speed of the moment.
static void test_time_has_parts(void **state)
{
    (void)state;
    scree_case_summary all = summarise(NULL, NULL), no_figures = summarise("output.figures=no", NULL);
    assert_true(all.stepping > 0 && all.output > 0 && all.figures > 0 && all.rate > 0);
    assert_true(all.seconds == all.stepping + all.output + all.figures);
    assert_true(no_figures.figures == 0);
}

static void test_memory_grows_with_what_is_asked_for(void **state)
{
    (void)state;
    const char *const more[][2] = {
        {"output.figures=no", "measure.cells=no"},
        {"output.figures=no", NULL},
        {"output.figures=yes", NULL},
        {"output.figures=yes", "particles.count=1200"},
        {"output.figures=yes", "particles.count=5000"},
    };
    double before = 0;
    for (size_t k = 0; k < sizeof more / sizeof *more; k++) {
        double memory = summarise(more[k][0], more[k][1]).memory;
        assert_true(memory > before);
        before = memory;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_of_every_stage),
        cmocka_unit_test(test_time_has_parts),
        cmocka_unit_test(test_memory_grows_with_what_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
