/// Whether a loading is quasistatic: numbers before the run against closed forms, warnings whose advice helps, and what
/// a run writes.
#include "biaxial_config.h"
#include "io_scratch.h"
#include "run/quasistatic.h"
#include "run_fixture.h"

#include <math.h>
#include <string.h>

/// Relative; every formula here takes about ten operations.
static const double ROUND_OFF = 1e-14;

static void assert_near(double value, double expected)
{
    if (fabs(value - expected) <= ROUND_OFF * fabs(expected)) return;
    fail_msg("%.17g is not %.17g", value, expected);
}

static scree_model model_of(biaxial_config *c)
{
    scree_model model;
    scree_error error;
    check(scree_model_build(&c->config, &model, &error), &error);
    return model;
}

/// P's case with names of stages, which the fixture leaves out.
static void set_config(biaxial_config *c, int64_t count)
{
    static char confine[] = "confine", compress[] = "compress";
    biaxial_config_set(c, count);
    c->stage[1].name = confine;
    c->stage[2].name = compress;
}

/// 983 discs of 1:2, <R^2> = 7/12 mm^2, 100 kPa, 5e-3 1/s, 30 GPa; expected solid fraction 0.8 and so an area of N pi
/// <R>^2 / 0.8, height sqrt(2 area).
static void test_a_case_before_it_runs(void **unused)
{
    (void)unused;
    biaxial_config c;
    set_config(&c, 983);
    c.config.gravity[1].value = -9.81e-6;
    scree_model model = model_of(&c);
    scree_quasistatic q = scree_quasistatic_expect(&model, 2);
    assert_near(q.value[SCREE_QUASISTATIC_INERTIAL], 5e-3 * sqrt(2.675e8 * M_PI * 7e-6 / 12 / 1e5));
    assert_near(q.value[SCREE_QUASISTATIC_MODULUS], 3e5);
    double height = sqrt(2 * 983 * M_PI * 0.75e-3 * 0.75e-3 / 0.8);
    assert_near(q.value[SCREE_QUASISTATIC_WEIGHT], 9.81e-6 * 2.675e8 * 0.8 * height / 1e5);
    // Hertz: f = K d^1.5 with K = (2/3) E / (1 - nu^2) sqrt(R/2) at the mean force p (2R)^2 has the tangent 1.5 K^(2/3)
    // f^(1/3), and a layer of discs of the length 2R that over 2R as its modulus.
    double stiffness = 2.0 / 3 * 30e9 / 0.91 * sqrt(0.5 * 0.75e-3);
    double modulus = 1.5 * cbrt(stiffness * stiffness * 1e5 * 1.5e-3 * 1.5e-3) / 1.5e-3;
    assert_near(q.value[SCREE_QUASISTATIC_SOUND], 5e-3 * height / sqrt(modulus / (0.8 * 2.675e8)));
    assert_true(isnan(q.value[SCREE_QUASISTATIC_KINETIC]));

    // A confinement imposes no rate; a preparation does not mean to be quasistatic.
    q = scree_quasistatic_expect(&model, 1);
    assert_true(isnan(q.value[SCREE_QUASISTATIC_INERTIAL]) && isnan(q.value[SCREE_QUASISTATIC_SOUND]));
    assert_near(q.value[SCREE_QUASISTATIC_MODULUS], 3e5);
    q = scree_quasistatic_expect(&model, 0);
    for (int k = 0; k < SCREE_QUASISTATIC_COUNT; k++) assert_true(isnan(q.value[k]));
}

/// Spheres: I = rate d sqrt(density / p), the wave through a height of (4 N (4/3) pi R^3 / 0.64)^(1/3).
static void test_spheres_before_they_run(void **unused)
{
    (void)unused;
    biaxial_config c;
    set_config(&c, 500);
    c.config.dimension = 3;
    c.config.particles.shape = SCREE_SLOT_sphere;
    scree_model model = model_of(&c);
    scree_quasistatic q = scree_quasistatic_expect(&model, 2);
    assert_near(q.value[SCREE_QUASISTATIC_INERTIAL], 5e-3 * 1.5e-3 * sqrt(2.675e8 / 1e5));
    double height = cbrt(4 * 500 * 4.0 / 3 * M_PI * pow(0.75e-3, 3) / 0.64);
    assert_near(q.value[SCREE_QUASISTATIC_SOUND] / scree_expected_wave_time(&model, 1e5), 5e-3);
    assert_near(scree_expected_wave_time(&model, 1e5) * sqrt(scree_confined_modulus(&model, 1e5) / (0.64 * 2.675e8)),
                height);
}

typedef struct heard {
    int count;
    char text[4][512];
} heard;

static void hear(void *user, int level, const char *line)
{
    heard *h = user;
    if (level != SCREE_LOG_WARNING || h->count == 4) return;
    (void)snprintf(h->text[h->count++], sizeof h->text[0], "%s", line);
}

static void hear_log(void *user, scree_log_level level, const char *line)
{
    hear(user, (int)level, line);
}

static heard warnings_of(biaxial_config *c)
{
    heard h = {0};
    scree_model model = model_of(c);
    scree_log log = {.sink = hear_log, .user = &h};
    scree_quasistatic_warn(&model, &log);
    return h;
}

/// The number behind `before` in a text.
static double number_after(const char *text, const char *before)
{
    const char *place = strstr(text, before);
    if (!place) fail_msg("no '%s' in: %s", before, text);
    return strtod(place + strlen(before), NULL);
}

/// Each limit in turn: the warning names stage, number and limit; what it advises is followed, and it is gone.
static void test_warnings_whose_advice_helps(void **unused)
{
    (void)unused;
    biaxial_config c;
    set_config(&c, 983);
    assert_int_equal(warnings_of(&c).count, 0);

    biaxial_compress(&c)->rate = 0.03;
    heard h = warnings_of(&c);
    assert_int_equal(h.count, 1);
    assert_non_null(strstr(h.text[0], "stage 2 (compress): inertial number 0.0021, above 0.001: "));
    biaxial_compress(&c)->rate = number_after(h.text[0], "a rate of ");
    assert_true(biaxial_compress(&c)->rate > 0.012);
    assert_int_equal(warnings_of(&c).count, 0);

    // So light that the inertial number is small, and so many that a wave needs long: 0.03 s.
    c.material[0].density = 1e4;
    c.config.particles.count = 100000000;
    biaxial_compress(&c)->rate = 0.5;
    h = warnings_of(&c);
    assert_int_equal(h.count, 1);
    assert_non_null(strstr(h.text[0], "stage 2 (compress): strain while a wave crosses the sample "));
    biaxial_compress(&c)->rate = number_after(h.text[0], "a rate of ");
    assert_int_equal(warnings_of(&c).count, 0);
}

/// Modulus and weight concern the confinement too.
static void test_warnings_of_modulus_and_weight(void **unused)
{
    (void)unused;
    biaxial_config c;
    set_config(&c, 983);
    c.material[0].young_modulus = 0.5e8;
    heard h = warnings_of(&c);
    assert_int_equal(h.count, 2);
    assert_non_null(strstr(h.text[0], "stage 1 (confine): Young's modulus"));
    assert_non_null(strstr(h.text[1], "Young's modulus over pressure 500, below 1000: "));
    c.material[0].young_modulus = number_after(h.text[1], "young_modulus of ");
    assert_int_equal(warnings_of(&c).count, 0);

    set_config(&c, 983);
    c.config.gravity[1].value = -1e-3;
    h = warnings_of(&c);
    assert_int_equal(h.count, 2);
    assert_non_null(strstr(h.text[0], "self-weight over pressure 0.14"));
    biaxial_confine(&c)->pressure = number_after(h.text[0], "a pressure of ");
    assert_int_equal(warnings_of(&c).count, 0);
}

static const char case_text[] = "scree: 1\n"
                                "name: small\n"
                                "dimension: 2\n"
                                "seed: 1\n"
                                "materials:\n"
                                "  - {name: quartz, young_modulus: 3 GPa, poisson_ratio: 0.3, density: 2.675e8 kg/m3,\n"
                                "     friction: 0.45, restitution: 0.2}\n"
                                "particles: {shape: disc, material: quartz, count: 60, distribution: uniform,\n"
                                "            radius_min: 0.5 mm, radius_max: 1 mm}\n"
                                "contact: {law: hertz_mindlin}\n"
                                "integrator: {scheme: velocity_verlet, step: 3e-5 s}\n"
                                "stages:\n"
                                "  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}\n"
                                "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 1e-2}\n"
                                "  - {stage: compress, strain: 0.4 %, rate: 1e-2 1/s}\n"
                                "measure: {samples: 20}\n"
                                "output: {snapshots: 1, paraview: no, figures: no}\n";

static double result_of(const char *name)
{
    char text[64];
    scree_error error;
    check(scree_result_get("out", name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

static heard run_small(const char *override)
{
    scree_error error;
    heard h = {0};
    scree_case *c = case_read(case_text, &override, 1);
    scree_run_options options = {.output = "out", .threads = 1, .force = true, .message = hear, .user = &h};
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
    return h;
}

/// A slow run of soft discs is quasistatic and warns of nothing; the results are those of its series.
static void test_a_quasistatic_run(void **unused)
{
    (void)unused;
    heard h = run_small("seed=1");
    assert_int_equal(h.count, 0);
    char text[512];
    scree_error error;
    check(scree_result_get("out", "quasistatic", text, sizeof text, &error), &error);
    assert_string_equal(text, "yes");
    check(scree_result_get("out", "quasistatic_reason", text, sizeof text, &error), &error);
    assert_string_equal(text, "every stage keeps its limits");

    scree_series series;
    check(scree_series_read(&series, "out/series.csv", &error), &error);
    const double *stage = scree_series_get(&series, "stage"), *number = scree_series_get(&series, "inertial_number");
    const double *kinetic = scree_series_get(&series, "kinetic"),
                 *share = scree_series_get(&series, "kinetic_over_elastic");
    const double *normal = scree_series_get(&series, "elastic_normal");
    const double *tangential = scree_series_get(&series, "elastic_tangential");
    double moving = 0, stored = 0, sum = 0, rows = 0, largest = 0;
    for (size_t k = 0; k < series.row_count; k++) {
        assert_near(share[k], kinetic[k] / (normal[k] + tangential[k]));
        if (stage[k] < 2) {
            assert_true(isnan(number[k]));
            continue;
        }
        moving += kinetic[k];
        stored += normal[k] + tangential[k];
        sum += number[k];
        largest = fmax(largest, number[k]);
        rows++;
    }
    scree_series_destroy(&series);
    assert_near(result_of("kinetic_over_elastic"), moving / stored);
    assert_near(result_of("inertial_number"), sum / rows);
    // At the full rate and 100 kPa; the mean stress of the contacts, which counts where it is less, is at the begin of
    // the loading that pressure within the 5 % of the plates that end a confinement.
    assert_true(fabs(largest / (1e-2 * sqrt(2.675e8 * M_PI * 7e-6 / 12 / 1e5)) - 1) < 0.03);
}

/// Ten times as fast: no, with every reason, and the warnings before and during the run.
static void test_a_run_that_is_not_quasistatic(void **unused)
{
    (void)unused;
    heard h = run_small("stages.compress.rate=0.1");
    assert_int_equal(h.count, 2);
    assert_non_null(strstr(h.text[0], "stage 2 (compress): inertial number 0.007, above 0.001"));
    assert_non_null(strstr(h.text[1], "stage 2 (compress): kinetic over elastic energy "));
    char text[512];
    scree_error error;
    check(scree_result_get("out", "quasistatic", text, sizeof text, &error), &error);
    assert_string_equal(text, "no");
    check(scree_result_get("out", "quasistatic_reason", text, sizeof text, &error), &error);
    assert_non_null(
        strstr(text, "stage 2 (compress): inertial number 0.007, above 0.001; stage 2 (compress): kinetic"));
    assert_true(result_of("kinetic_over_elastic") > 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_case_before_it_runs),
        cmocka_unit_test(test_spheres_before_they_run),
        cmocka_unit_test(test_warnings_whose_advice_helps),
        cmocka_unit_test(test_warnings_of_modulus_and_weight),
        cmocka_unit_test_setup_teardown(test_a_quasistatic_run, enter_scratch, leave_scratch),
        cmocka_unit_test_setup_teardown(test_a_run_that_is_not_quasistatic, enter_scratch, leave_scratch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
