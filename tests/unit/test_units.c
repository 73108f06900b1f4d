/// Values with units: conversion, dimensions, and what is refused.
#include "base/memory.h"
#include "base/units.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/// Every value must be the double that the compiler makes of the SI number: no tolerance. The second time factors are
/// those that are kept from the first.
static void values_are_exact(void **state)
{
    (void)state;
    static const struct {
        const char *text, *unit;
        double value;
    } cases[] = {
        {"100 kPa", "Pa", 1e5},
        {"0.75 mm", "m", 0.75e-3},
        {"5e-3 1/s", "1/s", 5e-3},
        {"10 %", "1", 0.1},
        {"7 %", "1", 0.07},
        {"3", "m", 3},
        {"30GPa", "Pa", 30e9},
        {"2.675e8 kg/m3", "kg/m3", 2.675e8},
        {"10 N/mm", "N/m", 1e4},
        {"5 \u00b5m", "m", 5e-6},
        {"5 \u03bcm", "m", 5e-6},
        {"5 um", "m", 5e-6},
        {"-9.81 m/s2", "m/s2", -9.81},
        {"9.81 m/s^2", "m/s2", 9.81},
        {"9.81 m s-2", "m/s2", 9.81},
        {"2 g/cm3", "kg/m3", 2000},
        {"1 bar", "Pa", 1e5},
        {".5 mm", "m", 5e-4},
        {"5. mm", "m", 5e-3},
        {"+1 s", "s", 1},
        {"1 min", "s", 60},
        {"  2 m  ", "m", 2},
        {"5 /s", "1/s", 5},
        {"1e-2 Hz", "1/s", 1e-2},
        {"3 m**2", "m2", 3},
        {"0.1 mm", "m", 1e-4},
        {"15 %", "1", 0.15},
        {"1 mm/m", "1", 1e-3},
        {"2 m\u00b2", "m2", 2},
        {"1E3 Pa", "Pa", 1000},
    };
    enum { CASES = sizeof cases / sizeof *cases };
    for (size_t k = 0; k < 2 * CASES; k++) {
        const size_t i = k % CASES;
        double value = NAN;
        scree_error error = {0};
        if (scree_units_parse(cases[i].text, cases[i].unit, &value, &error))
            fail_msg("'%s': %s", cases[i].text, error.message);
        if (memcmp(&value, &cases[i].value, sizeof value) != 0)
            fail_msg("'%s' is %.17g, not %.17g", cases[i].text, value, cases[i].value);
    }
}

static void negative_zero_is_zero(void **state)
{
    (void)state;
    double value = 1;
    assert_int_equal(scree_units_parse("-0", "m", &value, NULL), SCREE_OK);
    assert_int_equal(signbit(value), 0);
    assert_int_equal(scree_units_parse("-0.0 mm", "m", &value, NULL), SCREE_OK);
    assert_int_equal(signbit(value), 0);
}

static void wrong_values_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *unit, *message;
    } cases[] = {
        {"3 kPa", "m", "'3 kPa' is a pressure; expected a length, e.g. 0.5 mm"},
        {"5 s", "1/s", "is a time; expected a rate"}, // udunits2 itself would convert a reciprocal
        {"5 1/s", "s", "is a rate; expected a time"},
        {"3 mm", "1", "is a length; expected a plain number"},
        {"30 degrees", "1", "is an angle; expected a plain number"},
        {"3 A", "m", "has the wrong dimension; expected a length"},
        {"20 degC", "K", "has the wrong dimension"},
        {"100 kpa", "Pa", "unknown unit 'kpa'; did you mean 'kPa'?"},
        {"100 kiloglorps", "Pa", "unknown unit 'kiloglorps'; expected a pressure, e.g. 100 kPa"},
        {"3 mmm", "m", "unknown unit 'mmm'; expected a length"},
        {"0,5 mm", "m", "has a decimal comma"},
        {"abc", "m", "'abc' is not a number; expected a length, e.g. 0.5 mm"},
        {"", "m", "is not a number"},
        {"mm", "m", "is not a number"},
        {"nan", "m", "is not a number"},
        {"inf", "m", "is not a number"},
        {"-inf m", "m", "is not a number"},
        {"0x10", "m", "unknown unit 'x10'"},
        {".", "m", "is not a number"},
        {"+-1", "m", "is not a number"},
        {"1e400", "m", "too large"},
        {"1e308 km", "m", "too large"},
        {"1 000 kPa", "Pa", "unknown unit '000 kPa'"},
        {"2 3 m", "m", "unknown unit '3 m'"},
        {"5 m @ 3", "m", "unknown unit"},
        {"5 s since 1990-01-01", "s", "unknown unit"},
        {"5 lg(re 1 mW)", "1", "unknown unit"},
        {"5 m^999999999", "m", "unknown unit"},
        {"5 ((((((((m", "m", "unknown unit"},
        {"5 mmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmm", "m", "unknown unit"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 7;
        scree_error error = {0};
        if (!scree_units_parse(cases[i].text, cases[i].unit, &value, &error))
            fail_msg("'%s' is accepted as %g", cases[i].text, value);
        assert_int_equal(error.status, SCREE_ERROR_INPUT);
        if (!strstr(error.message, cases[i].message)) fail_msg("'%s': %s", cases[i].text, error.message);
        assert_true(value == 7);
    }
}

/// Digits beyond any buffer.
static void long_numbers_are_safe(void **state)
{
    (void)state;
    char text[2000];
    double value;
    memset(text, '1', sizeof text);
    text[sizeof text - 1] = 0;
    assert_int_equal(scree_units_parse(text, "m", &value, NULL), SCREE_ERROR_INPUT);
    text[200] = 0;
    assert_int_equal(scree_units_parse(text, "m", &value, NULL), SCREE_OK);
}

static void *convert_often(void *failures)
{
    for (int i = 0; i < 300; i++) {
        double value = 0;
        if (scree_units_parse("100 kPa", "Pa", &value, NULL) || value != 1e5) ++*(int *)failures;
        if (!scree_units_parse("100 kPa", "m", &value, NULL)) ++*(int *)failures;
    }
    return NULL;
}

static void threads_may_convert_at_once(void **state)
{
    (void)state;
    pthread_t threads[4];
    int failures[4] = {0};
    for (int i = 0; i < 4; i++) assert_int_equal(pthread_create(&threads[i], NULL, convert_often, &failures[i]), 0);
    for (int i = 0; i < 4; i++) pthread_join(threads[i], NULL);
    for (int i = 0; i < 4; i++) assert_int_equal(failures[i], 0);
}

/// Before the database is read, and after; a factor that is known needs none.
static void memory_that_runs_out_is_told(void **state)
{
    (void)state;
    static const char *const texts[] = {"5 mm", "0.5 cm"};
    for (int k = 0; k < 2; k++) {
        double value = 0;
        scree_error error;
        (void)scree_allocation_fail_after(1);
        assert_int_equal(scree_units_parse(texts[k], "m", &value, &error), SCREE_ERROR_IO);
        (void)scree_allocation_fail_after(0);
        assert_non_null(strstr(error.message, "out of memory"));
        assert_int_equal(scree_units_parse(texts[k], "m", &value, &error), SCREE_OK);
        assert_true(value == 5e-3);
        value = 0;
        (void)scree_allocation_fail_after(1);
        assert_int_equal(scree_units_parse(texts[k], "m", &value, &error), SCREE_OK);
        (void)scree_allocation_fail_after(0);
        assert_true(value == 5e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_that_runs_out_is_told), cmocka_unit_test(values_are_exact),
        cmocka_unit_test(negative_zero_is_zero),        cmocka_unit_test(wrong_values_are_refused),
        cmocka_unit_test(long_numbers_are_safe),        cmocka_unit_test(threads_may_convert_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
