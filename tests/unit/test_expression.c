/// The expressions of the tables of statements: values, precedence, names, what is not known, and every refusal.
#include "testing.h"

#include "sweep/expression.h"

#include <math.h>
#include <string.h>

/// x = 3, case/a-b.two = 2, c/0.3_k=1e-2.r = 7; nothing else is known. Counts the calls.
static double look_up(void *user, const char *name)
{
    ++*(int *)user;
    if (strcmp(name, "x") == 0) return 3;
    if (strcmp(name, "case/a-b.two") == 0) return 2;
    if (strcmp(name, "c/0.3_k=1e-2.r") == 0) return 7;
    return NAN;
}

static double value_of(const char *text)
{
    double value;
    int calls = 0;
    scree_error error = {0};
    if (scree_expression_evaluate(text, look_up, &calls, &value, &error)) fail_msg("'%s': %s", text, error.message);
    return value;
}

/// All results are exact in binary, so they are compared without tolerance.
static void arithmetic_has_its_usual_precedence(void **state)
{
    (void)state;
    assert_true(value_of("2") == 2);
    assert_true(value_of(" 1 + 2 * 3 ") == 7);
    assert_true(value_of("(1 + 2) * 3") == 9);
    assert_true(value_of("8 / 4 / 2") == 1);
    assert_true(value_of("8 - 4 - 2") == 2);
    assert_true(value_of("-2 * -3") == 6);
    assert_true(value_of("--2") == 2);
    assert_true(value_of("2.5e1 / .5") == 50);
    assert_true(value_of("1e-2 * 100") == 1);
    assert_true(isinf(value_of("1 / 0")));
}

static void names_may_hold_signs_and_spaces_part_them(void **state)
{
    (void)state;
    assert_true(value_of("x") == 3);
    assert_true(value_of("x - 1") == 2);
    assert_true(value_of("case/a-b.two * x") == 6);
    assert_true(value_of("x / case/a-b.two") == 1.5);
    assert_true(value_of("c/0.3_k=1e-2.r - 7") == 0);
    assert_true(isnan(value_of("x-1")));
}

static void comparisons_are_one_or_zero(void **state)
{
    (void)state;
    assert_true(value_of("x > 2") == 1);
    assert_true(value_of("x < 2") == 0);
    assert_true(value_of("x >= 3") == 1);
    assert_true(value_of("x <= 3") == 1);
    assert_true(value_of("x > 3") == 0);
    assert_true(value_of("1 + 1 > 1 * 1") == 1);
    assert_true(value_of("(x > 2) * (x < 4)") == 1);
    assert_true(value_of("(x > 2) * (x > 4) > 0") == 0);
}

/// "differs" must not be said of what was never measured.
static void the_unknown_stays_unknown(void **state)
{
    (void)state;
    assert_true(isnan(value_of("y")));
    assert_true(isnan(value_of("y + 1")));
    assert_true(isnan(value_of("0 * y")));
    assert_true(isnan(value_of("y > 0")));
    assert_true(isnan(value_of("x < y")));
    assert_true(isnan(value_of("(y > 0) * 0 < 1")));
}

static void every_name_is_looked_up_once_an_occurrence(void **state)
{
    (void)state;
    double value;
    int calls = 0;
    assert_int_equal(scree_expression_evaluate("x + y * (x - y)", look_up, &calls, &value, NULL), SCREE_OK);
    assert_int_equal(calls, 4);
}

static void what_is_no_expression_is_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {"",     " ",     "1 +",    "* 2",       "(1",     "1)",    "1 2",  "x x",
                                        "1..2", "0x10",  "1e",     "x > 1 > 0", "x == 3", "a ^ 2", "f(2)", "1 > ",
                                        "<",    "x = 3", "1e400x", "$",         "()",     "2x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        double value = 1;
        int calls = 0;
        scree_error error = {0};
        if (scree_expression_evaluate(wrong[i], look_up, &calls, &value, &error) != SCREE_ERROR_INPUT)
            fail_msg("'%s' is taken for %g", wrong[i], value);
        assert_true(isnan(value));
        assert_true(error.message[0]);
    }
    char deep[200], name[400];
    memset(deep, '(', sizeof deep - 1);
    deep[sizeof deep - 1] = 0;
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = 0;
    double value;
    int calls = 0;
    assert_int_equal(scree_expression_evaluate(deep, look_up, &calls, &value, NULL), SCREE_ERROR_INPUT);
    assert_int_equal(scree_expression_evaluate(name, look_up, &calls, &value, NULL), SCREE_ERROR_INPUT);
    assert_int_equal(calls, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_has_its_usual_precedence),
        cmocka_unit_test(names_may_hold_signs_and_spaces_part_them),
        cmocka_unit_test(comparisons_are_one_or_zero),
        cmocka_unit_test(the_unknown_stays_unknown),
        cmocka_unit_test(every_name_is_looked_up_once_an_occurrence),
        cmocka_unit_test(what_is_no_expression_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
