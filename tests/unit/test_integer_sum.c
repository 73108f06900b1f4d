/// Sums in integers: free of the order of their terms and of how they are cut into parts, as exact as they say, and never
/// wrong in silence.
#include "testing.h"

#include "base/integer_sum.h"
#include "base/random.h"

#include <float.h>
#include <math.h>

enum { TERMS = 1000 };

/// Terms of both signs over many magnitudes.
static void draw(double term[TERMS], double scale)
{
    for (uint64_t k = 0; k < TERMS; k++) {
        double u = scree_random_uniform(3, SCREE_RANDOM_TEST, 2 * k);
        double size = ldexp(scale, (int)(30 * scree_random_uniform(3, SCREE_RANDOM_TEST, 2 * k + 1)) - 30);
        term[k] = (2 * u - 1) * size;
    }
}

/// Place k of the terms in one of several orders.
static size_t place(int order, size_t k)
{
    return order == 0 ? k : order == 1 ? TERMS - 1 - k : 387 * k % TERMS; // 387 and 1000 have no common factor
}

static double sum_in_order(const double term[TERMS], int order)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1))
        for (size_t k = 0; k < TERMS; k++) scree_integer_sum_add(&sum, term[place(order, k)]);
    return scree_integer_sum_total(&sum);
}

/// The same by `parts` that know nothing of each other, joined from the last to the first.
static double sum_in_parts(const double term[TERMS], size_t parts)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1)) {
        scree_integer_sum part[TERMS];
        for (size_t p = 0; p < parts; p++) {
            part[p] = sum;
            for (size_t k = p; k < TERMS; k += parts) scree_integer_sum_add(&part[p], term[k]);
        }
        for (size_t p = parts; p-- > 0;) scree_integer_sum_join(&sum, &part[p]);
    }
    return scree_integer_sum_total(&sum);
}

static void order_and_parts_do_not_show(void **unused)
{
    (void)unused;
    static const double scales[] = {1, 1e-200, 3e250};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        double term[TERMS], plain[2] = {0};
        draw(term, scales[s]);
        double sum = sum_in_order(term, 0);
        for (int order = 1; order < 3; order++) assert_true(sum_in_order(term, order) == sum);
        for (size_t parts = 1; parts <= TERMS; parts = 3 * parts + 1) assert_true(sum_in_parts(term, parts) == sum);
        // The terms are such that a sum of doubles shows their order.
        for (size_t k = 0; k < TERMS; k++) {
            plain[0] += term[k];
            plain[1] += term[place(2, k)];
        }
        assert_true(plain[0] != plain[1]);
        assert_true(fabs(plain[0] - sum) < TERMS * DBL_EPSILON * scales[s]);
    }
}

/// A large term and its opposite leave the small ones, each to half a quantum.
static void cancelling_terms_leave_the_rest(void **unused)
{
    (void)unused;
    double term[TERMS];
    long double exact = 0;
    draw(term, 1);
    for (size_t k = 0; k < TERMS; k++) term[k] *= 1e-6;
    term[17] = 1;
    term[700] = -1;
    for (size_t k = 0; k < TERMS; k++) exact += k == 17 || k == 700 ? 0 : term[k];
    assert_true(fabsl(sum_in_order(term, 0) - exact) <= TERMS * 0x1p-62);
}

static void few_terms_are_exact(void **unused)
{
    (void)unused;
    scree_integer_sum none = {0}, one = {0}, zero = {0};
    while (scree_integer_sum_next(&none, 1)) continue;
    assert_true(scree_integer_sum_total(&none) == 0);
    while (scree_integer_sum_next(&zero, 1)) scree_integer_sum_add(&zero, 0);
    assert_true(scree_integer_sum_total(&zero) == 0);
    static const double values[] = {0.1, -DBL_MAX, 1e-300, 0x1p-1022, 3};
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        one = (scree_integer_sum){0};
        while (scree_integer_sum_next(&one, 1)) scree_integer_sum_add(&one, values[k]);
        // Half a quantum: 2^-1021 is the least.
        assert_true(fabs(scree_integer_sum_total(&one) - values[k]) <= (values[k] < 1e-299 ? 0x1p-1021 : 0));
    }
}

/// What cannot be summed is not a number, never a wrong one.
static void no_term_overflows_in_silence(void **unused)
{
    (void)unused;
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    double term[TERMS];
    for (size_t k = 0; k < 3; k++) {
        draw(term, 1);
        term[500] = bad[k];
        assert_true(isnan(sum_in_order(term, 0)));
        assert_true(isnan(sum_in_parts(term, 7)));
    }
    // A loop whose second pass finds a larger term than its first.
    scree_integer_sum sum = {0};
    for (double value = 1; scree_integer_sum_next(&sum, 1); value = 5) scree_integer_sum_add(&sum, value);
    assert_true(isnan(scree_integer_sum_total(&sum)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_and_parts_do_not_show),
        cmocka_unit_test(cancelling_terms_leave_the_rest),
        cmocka_unit_test(few_terms_are_exact),
        cmocka_unit_test(no_term_overflows_in_silence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
