/// Fits of theories to made-up stresses: exact ones give the parameters back, noisy ones give them with the errors that
/// the fit says, chi^2 has its distribution, and AIC finds the theory that made the stresses.
#include "testing.h"

#include "base/random.h"
#include "theory/fit.h"

#include <math.h>
#include <string.h>

enum { MOST = 400, SEEDS = 300 };

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance))) fail_msg("%s = %.12g, not %.12g", #value, value_, expected_);  \
    } while (0)

static scree_fit begin(const char *theory)
{
    scree_fit fit;
    scree_error error = {0};
    check(scree_fit_begin(theory, &fit, &error), &error);
    return fit;
}

static void set(scree_fit *fit, const char *name, double value, bool free)
{
    scree_error error = {0};
    check(scree_fit_set(fit, name, value, free, &error), &error);
}

static bool is_layer(const char *theory)
{
    return strncmp(theory, "layer", 5) == 0 || strcmp(theory, "flamant") == 0;
}

/// Cuts of a pile at two depths, or of a layer at three.
static size_t lay_out(const char *theory, scree_fit_point *points)
{
    size_t count = 0;
    for (int cut = 1; cut <= 3; cut++)
        for (double x = -1.62; x < 1.63; x += 0.06)
            points[count++] = is_layer(theory) ? (scree_fit_point){.x = 1.3 * x, .y = 0.33 * cut}
                                               : (scree_fit_point){.x = x * 0.31 * cut, .y = 0.31 * cut};
    return count;
}

/// The theory's stresses with noise of a known size; without a seed exact ones with that error.
static size_t make_points(const scree_fit *truth, const char *theory, double noise, uint64_t seed,
                          scree_fit_point *points)
{
    static scree_stress_2d stress[MOST];
    scree_error error = {0};
    const size_t count = lay_out(theory, points);
    check(scree_fit_stress(truth, count, points, stress, &error), &error);
    for (size_t k = 0; k < count; k++) {
        double number[3] = {0};
        for (uint64_t i = 0; i < 3 && seed > 0; i++) number[i] = scree_random_normal(seed, 7, 3 * k + i);
        points[k].stress = (scree_stress_2d){stress[k].xx + noise * number[0], stress[k].yy + noise * number[1],
                                             stress[k].xy + 0.5 * noise * number[2]};
        points[k].error = (scree_stress_2d){noise, noise, 0.5 * noise};
    }
    return count;
}

typedef struct truth_row {
    const char *theory;
    struct {
        const char *name;
        double truth, start;
    } parameter[4];
} truth_row;

/// Free parameters with their truth and a start some way off; a start of 0: held.
static const truth_row truths[] = {
    {"ife", {{"weight", 39000, 30000}, {"slope", 0.5, 0}}},
    {"bcc", {{"weight", 39000, 30000}, {"apex_x", 0.03, 1e-3}, {"apex_y", 0.05, 0.01}, {"slope", 0.5, 0.48}}},
    {"fpa", {{"weight", 39000, 50000}, {"slope", 0.5, 0}}},
    {"osl", {{"weight", 39000, 30000}, {"eta", 0.74, 0.9}, {"slope", 0.5, 0}}},
    {"oriented", {{"weight", 39000, 30000}, {"eta", 0.74, 0.6}, {"mu", -0.31, -0.1}, {"slope", 0.5, 0}}},
    {"wedge_dip", {{"weight", 39000, 30000}, {"slope_left", 0.5, 0}, {"slope_right", 0.4, 0}}},
    {"wedge_smooth", {{"weight", 39000, 30000}, {"slope_left", 0.5, 0}, {"slope_right", 0.4, 0}}},
    {"wedge_peak", {{"weight", 39000, 30000}, {"slope_left", 0.5, 0}, {"slope_right", 0.4, 0}}},
    {"wedge_core", {{"weight", 39000, 30000}, {"core", 0.61, 0.75}, {"slope_left", 0.5, 0}, {"slope_right", 0.5, 0}}},
    {"flamant", {{"force", 300, 200}, {"load_x", 0.02, 1e-3}}},
    {"layer_smooth", {{"force", 300, 200}, {"load_x", 0.02, 1e-3}, {"thickness", 1, 0}}},
    {"layer_bonded", {{"force", 300, 200}, {"poisson_ratio", 0.3, 0.1}, {"thickness", 1, 0}}},
};
enum { TRUTHS = sizeof truths / sizeof truths[0] };

/// A fit with the truth in it, and one that begins elsewhere.
static void both(const truth_row *row, scree_fit *truth, scree_fit *fit)
{
    *truth = *fit = begin(row->theory);
    for (int k = 0; k < 4 && row->parameter[k].name; k++) {
        const double start = row->parameter[k].start;
        set(truth, row->parameter[k].name, row->parameter[k].truth, false);
        set(fit, row->parameter[k].name, start != 0 ? start : row->parameter[k].truth, start != 0);
    }
}

/// The size of the noise: a hundredth of a typical stress.
static double noise_of(const char *theory)
{
    return is_layer(theory) ? 5 : 200;
}

static void exact_stresses_give_parameters_back(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < TRUTHS; i++) {
        scree_fit_point points[MOST];
        scree_error error = {0};
        scree_fit truth, fit;
        both(&truths[i], &truth, &fit);
        const size_t count = make_points(&truth, truths[i].theory, noise_of(truths[i].theory), 0, points);
        check(scree_fit_solve(&fit, count, points, &error), &error);
        for (int k = 0; k < 4 && truths[i].parameter[k].name; k++) {
            const scree_fit_parameter *p = scree_fit_find(&fit, truths[i].parameter[k].name);
            // To a small part of the error that they would have.
            assert_near(p->value, truths[i].parameter[k].truth, 1e-5 * p->error);
            assert_true((p->error > 0) == (truths[i].parameter[k].start != 0));
        }
        assert_true(fit.chi_square < 1e-8);
        assert_true(fit.values == 3 * count);
    }
}

/// Over many seeds: (found - true) / error has mean 0 and variance 1, chi^2 the mean of its degrees of freedom, its
/// probability is uniform. Bounds are five standard errors of the mean over the seeds.
static void errors_are_right(void **unused)
{
    (void)unused;
    static const char *const theories[] = {"osl", "oriented", "wedge_core", "layer_bonded", "flamant"};
    for (size_t t = 0; t < sizeof theories / sizeof theories[0]; t++) {
        const truth_row *row = truths;
        while (strcmp(row->theory, theories[t]) != 0) row++;
        const int seeds = is_layer(row->theory) && strcmp(row->theory, "flamant") != 0 ? SEEDS / 10 : SEEDS;
        double sum[4] = {0}, square[4] = {0}, chi = 0, probability = 0, freedom = 0;
        for (int seed = 1; seed <= seeds; seed++) {
            scree_fit_point points[MOST];
            scree_error error = {0};
            scree_fit truth, fit;
            both(row, &truth, &fit);
            const size_t count = make_points(&truth, row->theory, noise_of(row->theory), (uint64_t)seed, points);
            check(scree_fit_solve(&fit, count, points, &error), &error);
            for (int k = 0; k < 4 && row->parameter[k].name; k++) {
                const scree_fit_parameter *p = scree_fit_find(&fit, row->parameter[k].name);
                const double z = row->parameter[k].start != 0 ? (p->value - row->parameter[k].truth) / p->error : 0;
                sum[k] += z / seeds;
                square[k] += z * z / seeds;
            }
            chi += fit.chi_square / seeds;
            probability += fit.probability / seeds;
            freedom = (double)(fit.values - fit.free);
            assert_near(fit.information, fit.chi_square + 2 * (double)fit.free, 1e-9);
            assert_near(fit.reduced, fit.chi_square / freedom, 1e-12);
        }
        for (int k = 0; k < 4 && row->parameter[k].name; k++) {
            if (row->parameter[k].start == 0) continue;
            print_message("%s, %s: mean %.3f, variance %.3f of %d seeds\n", row->theory, row->parameter[k].name, sum[k],
                          square[k], seeds);
            assert_near(sum[k], 0, 5 / sqrt(seeds));
            assert_near(square[k], 1, 5 * sqrt(2. / seeds));
        }
        assert_near(chi, freedom, 5 * sqrt(2 * freedom / seeds));
        assert_near(probability, 0.5, 5 / sqrt(12. * seeds));
    }
}

/// Covariances: those of eta and mu from many seeds are those of one fit.
static void covariances_are_right(void **unused)
{
    (void)unused;
    const truth_row *row = truths;
    while (strcmp(row->theory, "oriented") != 0) row++;
    double products = 0, said = 0;
    for (int seed = 1; seed <= SEEDS; seed++) {
        scree_fit_point points[MOST];
        scree_error error = {0};
        scree_fit truth, fit;
        both(row, &truth, &fit);
        const size_t count = make_points(&truth, row->theory, 200, (uint64_t)seed, points);
        check(scree_fit_solve(&fit, count, points, &error), &error);
        const scree_fit_parameter *eta = scree_fit_find(&fit, "eta"), *mu = scree_fit_find(&fit, "mu");
        const size_t a = (size_t)(eta - fit.parameter), b = (size_t)(mu - fit.parameter);
        assert_near(fit.covariance[a][b], fit.covariance[b][a], 1e-15);
        products += (eta->value - 0.74) * (mu->value + 0.31) / (eta->error * mu->error) / SEEDS;
        said += fit.covariance[a][b] / (eta->error * mu->error) / SEEDS;
    }
    print_message("correlation of eta and mu %.3f, said %.3f\n", products, said);
    assert_true(fabs(said) > 0.3);
    assert_near(products, said, 5 * sqrt((1 + said * said) / SEEDS));
}

/// AIC of a theory whose weight and, of OSL, eta are free; and the probability of its chi^2.
static double information_of(const char *theory, size_t count, const scree_fit_point *points, double *probability)
{
    scree_error error = {0};
    scree_fit fit = begin(theory);
    set(&fit, "weight", 35000, true);
    check(scree_fit_solve(&fit, count, points, &error), &error);
    *probability = fit.probability;
    return fit.information;
}

/// The theory that made the stresses has the smallest AIC, and alone a chi^2 that its freedom explains.
static void the_right_theory_wins(void **unused)
{
    (void)unused;
    // The smooth wedge is BCC's pile; OSL with its free number is every one of them but IFE (test_theory_piles.c).
    static const char *const rivals[] = {"ife", "bcc", "fpa", "wedge_dip", "wedge_peak"};
    enum { RIVALS = sizeof rivals / sizeof rivals[0] };
    for (size_t m = 0; m < RIVALS; m++) {
        const char *best = NULL;
        double least = INFINITY, probability;
        scree_fit_point points[MOST];
        scree_fit truth = begin(rivals[m]);
        set(&truth, "weight", 39000, false);
        const size_t count = make_points(&truth, rivals[m], 300, 11 + m, points);
        for (size_t r = 0; r < RIVALS; r++) {
            const double information = information_of(rivals[r], count, points, &probability);
            if (information < least) best = rivals[r], least = information;
            if (r == m)
                assert_true(probability > 1e-4);
            else
                assert_true(probability < 1e-6);
        }
        assert_string_equal(best, rivals[m]);
        (void)information_of("osl", count, points, &probability);
        assert_true(m == 0 ? probability < 1e-6 : probability > 1e-4);
    }
}

/// A number that is free without need pays by 2: it lowers chi^2 by more than that in one of six seeds (16 %).
static void needless_parameters_pay(void **unused)
{
    (void)unused;
    int wrong = 0;
    double probability;
    for (int seed = 1; seed <= SEEDS; seed++) {
        scree_fit_point points[MOST];
        scree_fit truth = begin("wedge_peak");
        set(&truth, "weight", 39000, false);
        const size_t count = make_points(&truth, "wedge_peak", 300, (uint64_t)seed, points);
        wrong += information_of("osl", count, points, &probability) <
                 information_of("wedge_peak", count, points, &probability);
    }
    // P(chi^2 of one degree of freedom > 2), with five standard errors.
    print_message("OSL preferred in %d of %d seeds\n", wrong, SEEDS);
    assert_near((double)wrong / SEEDS, 0.1573, 5 * sqrt(0.1573 * 0.8427 / SEEDS));
}

/// Components without an error do not count; a fit with nothing free compares.
static void components_may_be_missing(void **unused)
{
    (void)unused;
    scree_fit_point points[MOST];
    scree_error error = {0};
    scree_fit truth, fit;
    both(&truths[3], &truth, &fit);
    const size_t count = make_points(&truth, "osl", 200, 3, points);
    for (size_t k = 0; k < count; k++) {
        points[k].error.xy = 0;
        points[k].error.xx = NAN;
        points[k].stress.xx = points[k].stress.xy = 1e9;
    }
    check(scree_fit_solve(&fit, count, points, &error), &error);
    assert_true(fit.values == count && fit.reduced < 2);
    assert_near(scree_fit_find(&fit, "eta")->value, 0.74, 5 * scree_fit_find(&fit, "eta")->error);
    check(scree_fit_solve(&truth, count, points, &error), &error);
    assert_true(truth.free == 0 && truth.values == count);
    assert_true(truth.chi_square >= fit.chi_square && truth.chi_square < fit.chi_square + 30);
}

static void refused(void **unused)
{
    (void)unused;
    scree_fit_point points[MOST];
    scree_error error = {0};
    scree_fit truth, fit;
    assert_int_equal(scree_fit_begin("osc", &fit, &error), SCREE_ERROR_INPUT);
    both(&truths[3], &truth, &fit);
    const size_t count = make_points(&truth, "osl", 200, 3, points);
    assert_int_equal(scree_fit_set(&fit, "nu", 1, true, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "nu");
    assert_int_equal(scree_fit_solve(&fit, 0, points, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "fewer"));
    set(&fit, "eta", -1, true);
    assert_int_equal(scree_fit_solve(&fit, count, points, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "eta");
    // The place of a load and its size from the one stress under it: nothing tells them apart; nor do two values alone.
    fit = begin("flamant");
    set(&fit, "load_x", 0.1, true);
    scree_fit_point single[2] = {{.y = 1, .stress = {.yy = 3}, .error = {.yy = 0.1}},
                                 {.y = 2, .stress = {.yy = 1.5}, .error = {.yy = 0.1}}};
    single[1].x = single[0].x = 0;
    scree_fit same = fit;
    set(&same, "load_x", 0, true);
    assert_int_equal(scree_fit_solve(&same, 2, single, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "tell"));
    // Stresses of one component below the apex are one number: weight and eta act alike.
    both(&truths[3], &truth, &fit);
    scree_fit_point axis[5];
    for (int k = 0; k < 5; k++)
        axis[k] = (scree_fit_point){.y = 0.1 * (k + 1), .stress = {.yy = 2500 * (k + 1) + k % 2}, .error = {.yy = 10}};
    assert_int_equal(scree_fit_solve(&fit, 5, axis, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "tell"));
    // One value beside the axis that hardly counts does not change that.
    both(&truths[3], &truth, &fit);
    axis[4].x = 0.2;
    axis[4].error.yy = 1e8;
    assert_int_equal(scree_fit_solve(&fit, 5, axis, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "tell"));
    // Names end, and each begins.
    size_t names = 0;
    while (scree_fit_theory_name(names)) (void)begin(scree_fit_theory_name(names++));
    assert_int_equal(names, TRUTHS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_stresses_give_parameters_back),
        cmocka_unit_test(errors_are_right),
        cmocka_unit_test(covariances_are_right),
        cmocka_unit_test(the_right_theory_wins),
        cmocka_unit_test(needless_parameters_pay),
        cmocka_unit_test(components_may_be_missing),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
