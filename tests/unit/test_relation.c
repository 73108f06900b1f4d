/// How two numbers go together: ranks, lines and parabolas that are known.
#include "testing.h"

#include "average/relation.h"

#include <math.h>

enum { COUNT = 9 };
static const double x[COUNT] = {3, -1, 0.5, 7, 2, 2.5, 11, -4, 6};

static void ranks_do_not_ask_for_a_line(void **unused)
{
    (void)unused;
    double y[COUNT];
    for (size_t k = 0; k < COUNT; k++) y[k] = exp(x[k]);
    assert_true(fabs(scree_average_rank_correlation(x, y, COUNT) - 1) < 1e-14);
    for (size_t k = 0; k < COUNT; k++) y[k] = -y[k];
    assert_true(fabs(scree_average_rank_correlation(x, y, COUNT) + 1) < 1e-14);
    // Ranks 0.5, 2, 2, 3.5 against 0.5, 1.5, 2.5, 3.5: 4.5 / sqrt(4.5 * 5).
    const double tied[] = {1, 4, 4, 9}, rising[] = {1, 2, 3, 4};
    assert_true(fabs(scree_average_rank_correlation(tied, rising, 4) - sqrt(0.9)) < 1e-14);
    assert_true(isnan(scree_average_rank_correlation(x, y, 2)));
}

static void a_line_has_no_bend(void **unused)
{
    (void)unused;
    double y[COUNT];
    for (size_t k = 0; k < COUNT; k++) y[k] = 2 - 3 * x[k];
    assert_true(scree_average_bend(x, y, COUNT) < 1e-28);
    assert_true(isnan(scree_average_bend(x, y, 3)));
}

/// On -2 ... 2 the line and x^2 - 2 are orthogonal with squares 10 and 14.
static void a_bend_is_its_share(void **unused)
{
    (void)unused;
    const double even[] = {-2, -1, 0, 1, 2};
    double y[5];
    for (size_t k = 0; k < 5; k++) y[k] = 5 + 3 * even[k] + 2 * even[k] * even[k];
    assert_true(fabs(scree_average_bend(even, y, 5) - 4 * 14 / (9 * 10 + 4 * 14.0)) < 1e-14);
    // Units and origins do not matter.
    double moved[5];
    for (size_t k = 0; k < 5; k++) {
        moved[k] = 100 + 1e-3 * even[k];
        y[k] *= -1e6;
    }
    assert_true(fabs(scree_average_bend(moved, y, 5) - 56 / 146.0) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks_do_not_ask_for_a_line),
        cmocka_unit_test(a_line_has_no_bend),
        cmocka_unit_test(a_bend_is_its_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
