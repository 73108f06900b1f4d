/// Distributions of sizes: moments against closed forms and against draws, limits, and radii that are functions of seed
/// and number alone.
#include "biaxial_config.h"
#include "model/model.h"
#include "size/grading.h"
#include "size/log_normal.h"
#include "size/normal.h"
#include "size/power_law.h"
#include "size/table.h"
#include "testing.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <string.h>

enum { DRAWS = 100000 };

static biaxial_config c;
static scree_model model;

static void build(int distribution, int dimension)
{
    scree_error error;
    c.config.particles.distribution = distribution;
    c.config.dimension = dimension;
    c.config.particles.shape = dimension == 3 ? SCREE_SLOT_sphere : SCREE_SLOT_disc;
    check(scree_model_build(&c.config, &model, &error), &error);
}

/// Moments as the model has them, to `tolerance`; those of DRAWS radii, within four standard errors; limits.
static void expect_moments(double mean, double square, double cube, double tolerance)
{
    const double expected[] = {mean, square, cube};
    const scree_size_moments *m = &model.species[0].radius;
    assert_true(fabs(m->mean / mean - 1) < tolerance);
    assert_true(fabs(m->square / square - 1) < tolerance);
    assert_true(fabs(m->cube / cube - 1) < tolerance);
    for (int k = 1; k <= 3; k++) {
        double sum = 0, squares = 0;
        for (uint64_t id = 0; id < DRAWS; id++) {
            double radius = scree_model_drawn_radius(&model, id), term = pow(radius, k) / expected[k - 1];
            assert_true(radius >= model.radius_min && radius <= model.radius_max);
            sum += term;
            squares += term * term;
        }
        sum /= DRAWS;
        double deviation = sqrt(fmax(squares / DRAWS - sum * sum, 0) / DRAWS);
        if (!(fabs(sum - 1) <= 4 * deviation + 1e-12))
            fail_msg("moment %d: %g of what it should be, standard error %g", k, sum, deviation);
    }
}

static void limits_and_equal_sizes(void **unused)
{
    (void)unused;
    const double a = 0.5e-3, b = 1e-3, m = 0.75e-3;
    biaxial_config_set(&c, 100);
    build(SCREE_SLOT_uniform, 2);
    expect_moments(m, 7.0 / 12 * b * b, 15.0 / 32 * b * b * b, 1e-14);
    build(SCREE_SLOT_two_sizes, 2);
    expect_moments(m, (a * a + b * b) / 2, (a * a * a + b * b * b) / 2, 1e-14);
    build(SCREE_SLOT_equal, 2);
    expect_moments(m, m * m, m * m * m, 1e-14);
}

static double normal_share(double a, double b)
{
    return gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a);
}

static void normal_sizes(void **unused)
{
    (void)unused;
    // Broad against the limits, narrow, and cut in a tail.
    const double middles[] = {0.7e-3, 0.7e-3, 0.3e-3}, spreads[] = {0.3e-3, 0.02e-3, 0.15e-3};
    for (int k = 0; k < 3; k++) {
        const double mu = middles[k], s = spreads[k], low = 0.5e-3, high = 1e-3;
        biaxial_config_set(&c, 100);
        *OWN(&c.sizes, scree_normal_config, normal, "particles") = (scree_normal_config){low, high, mu, s};
        build(SCREE_SLOT_normal, 2);
        double a = (low - mu) / s, b = (high - mu) / s, whole = normal_share(a, b);
        double p = gsl_ran_ugaussian_pdf(a) / whole, q = gsl_ran_ugaussian_pdf(b) / whole;
        double z1 = p - q, z2 = 1 + a * p - b * q, z3 = 2 * z1 + a * a * p - b * b * q;
        expect_moments(mu + s * z1, mu * mu + 2 * mu * s * z1 + s * s * z2,
                       mu * mu * mu + 3 * mu * mu * s * z1 + 3 * mu * s * s * z2 + s * s * s * z3, 1e-9);
    }
}

static void log_normal_sizes(void **unused)
{
    (void)unused;
    const double medians[] = {0.7e-3, 0.4e-3, 1e-3}, deviations[] = {1.3, 2, 1.05}, lows[] = {0.4e-3, 0.01e-3, 0.2e-3},
                 highs[] = {1.2e-3, 8e-3, 3e-3};
    for (int k = 0; k < 3; k++) {
        const double median = medians[k], s = log(deviations[k]), low = lows[k], high = highs[k];
        biaxial_config_set(&c, 100);
        *OWN(&c.sizes, scree_log_normal_config, log_normal, "particles") =
            (scree_log_normal_config){low, high, median, deviations[k]};
        build(SCREE_SLOT_log_normal, 3);
        double a = log(low / median) / s, b = log(high / median) / s, moment[4];
        for (int n = 0; n <= 3; n++)
            moment[n] = pow(median, n) * exp(n * n * s * s / 2) * normal_share(a - n * s, b - n * s);
        expect_moments(moment[1] / moment[0], moment[2] / moment[0], moment[3] / moment[0], 1e-9);
    }
}

static double power_integral(double power, double low, double high)
{
    return power == -1 ? log(high / low) : (pow(high, power + 1) - pow(low, power + 1)) / (power + 1);
}

static void power_law_sizes(void **unused)
{
    (void)unused;
    const double exponents[] = {2.5, 1, -1, 4, 0};
    for (int k = 0; k < 5; k++) {
        const double low = 0.2e-3, high = 1.5e-3, n = exponents[k];
        biaxial_config_set(&c, 100);
        *OWN(&c.sizes, scree_power_law_config, power_law, "particles") = (scree_power_law_config){low, high, n};
        build(SCREE_SLOT_power_law, 3);
        double whole = power_integral(-n, low, high);
        expect_moments(power_integral(1 - n, low, high) / whole, power_integral(2 - n, low, high) / whole,
                       power_integral(3 - n, low, high) / whole, 1e-10);
    }
}

static void sizes_of_a_table(void **unused)
{
    (void)unused;
    scree_table_size sizes[] = {{0.4e-3, 0.5}, {1e-3, 0.2}, {0.6e-3, 0.3}};
    for (int by = SCREE_TABLE_BY_NUMBER; by <= SCREE_TABLE_BY_MASS; by++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            biaxial_config_set(&c, 100);
            *OWN(&c.sizes, scree_table_config, table, "particles") = (scree_table_config){by, sizes, 3};
            build(SCREE_SLOT_table, dimension);
            double whole = 0, moment[4] = {0};
            for (int i = 0; i < 3; i++) {
                double r = sizes[i].radius, number = sizes[i].share / (by ? pow(r, dimension) : 1);
                whole += number;
                for (int n = 1; n <= 3; n++) moment[n] += number * pow(r, n);
            }
            expect_moments(moment[1] / whole, moment[2] / whole, moment[3] / whole, 1e-12);
            assert_true(model.radius_min == 0.4e-3 && model.radius_max == 1e-3);
        }
}

/// Number of grains between two radii, and sums of powers of theirs, by quadrature of a density of mass.
static void add_piece(double a, double b, double share, bool logarithmic, int dimension, double sum[4])
{
    enum { STEPS = 2000 };
    for (int i = 0; i < STEPS; i++) {
        const double u = (i + 0.5) / STEPS, r = logarithmic ? a * pow(b / a, u) : a + u * (b - a);
        for (int n = 0; n <= 3; n++) sum[n] += share / STEPS * pow(r, n - dimension);
    }
}

static void sizes_of_a_grading(void **unused)
{
    (void)unused;
    // With a step: 20 % of the mass lie on one sieve.
    scree_sieve grading[] = {{0.2e-3, 0}, {0.5e-3, 0.1}, {1e-3, 0.4}, {1e-3, 0.6}, {1.5e-3, 0.6}, {4e-3, 1}};
    for (int between = SCREE_GRADING_LOGARITHM; between <= SCREE_GRADING_SIZE; between++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            biaxial_config_set(&c, 100);
            *OWN(&c.sizes, scree_grading_config, grading, "particles") = (scree_grading_config){grading, 6, between};
            build(SCREE_SLOT_grading, dimension);
            double sum[4] = {0};
            for (int i = 0; i + 1 < 6; i++)
                add_piece(0.5 * grading[i].sieve, 0.5 * grading[i + 1].sieve,
                          grading[i + 1].passing - grading[i].passing, between == SCREE_GRADING_LOGARITHM, dimension,
                          sum);
            expect_moments(sum[1] / sum[0], sum[2] / sum[0], sum[3] / sum[0], 1e-6);
            assert_true(model.radius_min == 0.1e-3 && model.radius_max == 2e-3);
        }
}

/// What is drawn passes the sieves as it should: shares of the mass, within four standard errors.
static void draws_pass_the_sieves(void **unused)
{
    (void)unused;
    scree_sieve grading[] = {{0.4e-3, 0}, {0.6e-3, 0.2}, {1e-3, 0.7}, {1.6e-3, 1}};
    biaxial_config_set(&c, 100);
    *OWN(&c.sizes, scree_grading_config, grading, "particles") = (scree_grading_config){grading, 4, 0};
    build(SCREE_SLOT_grading, 2);
    double passed[4] = {0}, squares = 0, whole = 0;
    for (uint64_t id = 0; id < DRAWS; id++) {
        const double r = scree_model_drawn_radius(&model, id), mass = r * r;
        whole += mass;
        squares += mass * mass;
        for (int i = 0; i < 4; i++)
            if (2 * r < grading[i].sieve) passed[i] += mass;
    }
    for (int i = 0; i < 4; i++) assert_true(fabs(passed[i] / whole - grading[i].passing) < 4 * sqrt(squares) / whole);
}

/// Whatever the order of the numbers and how many there are.
static void radii_are_functions_of_seed_and_number(void **unused)
{
    (void)unused;
    static double radius[1000];
    biaxial_config_set(&c, 100);
    *OWN(&c.sizes, scree_log_normal_config, log_normal, "particles") =
        (scree_log_normal_config){0.1e-3, 2e-3, 0.7e-3, 1.4};
    build(SCREE_SLOT_log_normal, 2);
    for (uint64_t id = 0; id < 1000; id++) radius[id] = scree_model_drawn_radius(&model, id);
    c.config.particles.count = 1000;
    build(SCREE_SLOT_log_normal, 2);
    for (uint64_t k = 0; k < 1000; k++) {
        uint64_t id = 7 * k % 1000;
        assert_true(scree_model_drawn_radius(&model, id) == radius[id]);
    }
    c.config.seed++;
    build(SCREE_SLOT_log_normal, 2);
    assert_true(scree_model_drawn_radius(&model, 5) != radius[5]);
}

static void expect_refused(int distribution, const char *field, const char *message)
{
    scree_error error;
    c.config.particles.distribution = distribution;
    assert_int_equal(scree_model_build(&c.config, &model, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, field);
    if (!strstr(error.message, message)) fail_msg("%s", error.message);
}

static void wrong_keys_are_refused(void **unused)
{
    (void)unused;
    scree_table_size sizes[] = {{0.4e-3, 0.5}, {1e-3, 0.2}};
    biaxial_config_set(&c, 100);
    *OWN(&c.sizes, scree_power_law_config, power_law, "particles") = (scree_power_law_config){2e-3, 1e-3, 2};
    expect_refused(SCREE_SLOT_power_law, "particles.radius_min", "above radius_max");
    *OWN(&c.sizes, scree_normal_config, normal, "particles") = (scree_normal_config){1e-3, 2e-3, 0.1e-3, 0.01e-3};
    expect_refused(SCREE_SLOT_normal, "particles.mean", "lie 0 of the distribution");
    *OWN(&c.sizes, scree_log_normal_config, log_normal, "particles") = (scree_log_normal_config){1, 2, 0.1, 1.1};
    expect_refused(SCREE_SLOT_log_normal, "particles.median", "of the distribution");
    *OWN(&c.sizes, scree_table_config, table, "particles") = (scree_table_config){0, sizes, 2};
    expect_refused(SCREE_SLOT_table, "particles.sizes", "add up to 70 %");
    scree_sieve falls[] = {{1e-3, 0}, {2e-3, 0.5}, {3e-3, 0.4}, {4e-3, 1}}, open[] = {{1e-3, 0.1}, {2e-3, 1}},
                cut[] = {{1e-3, 0}, {2e-3, 0.9}}, turned[] = {{2e-3, 0}, {1e-3, 1}};
    scree_grading_config *own = OWN(&c.sizes, scree_grading_config, grading, "particles");
    *own = (scree_grading_config){falls, 4, 0};
    expect_refused(SCREE_SLOT_grading, "particles.grading", "50 % pass the sieve of 2 mm, and 40 % that of 3 mm");
    *own = (scree_grading_config){open, 2, 0};
    expect_refused(SCREE_SLOT_grading, "particles.grading", "10 % pass the finest sieve (1 mm)");
    *own = (scree_grading_config){cut, 2, 0};
    expect_refused(SCREE_SLOT_grading, "particles.grading", "only 90 % pass the coarsest sieve (2 mm)");
    *own = (scree_grading_config){turned, 2, 0};
    expect_refused(SCREE_SLOT_grading, "particles.grading", "list them from fine to coarse");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limits_and_equal_sizes), cmocka_unit_test(normal_sizes),
        cmocka_unit_test(log_normal_sizes),       cmocka_unit_test(power_law_sizes),
        cmocka_unit_test(sizes_of_a_table),       cmocka_unit_test(radii_are_functions_of_seed_and_number),
        cmocka_unit_test(sizes_of_a_grading),     cmocka_unit_test(draws_pass_the_sieves),
        cmocka_unit_test(wrong_keys_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
