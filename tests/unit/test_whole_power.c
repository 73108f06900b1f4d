/// Friction of hertz_brilliantov as a function of the slip alone: whole exponents without functions of a library
/// against pow, and the implicit equation against a bisection.
#include "testing.h"

#include "contact/hertz_brilliantov.h"

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))

static law_settings settings_of(double exponent)
{
    law_settings settings = {.step = 1};
    brilliantov_numbers(1, exponent, 1, settings.number);
    return settings;
}

static const double exponents[] = {1, 2, 3, 7, 50, 51, 50.5, 200, 1000, 1024, 1e5};

static void roots_are_those_of_pow(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < COUNT_OF(exponents); ++k) {
        const law_settings settings = settings_of(exponents[k]);
        double worst = 0;
        for (double decade = -140; decade < 120; decade += 0.0137) {
            const double slip = pow(10, decade);
            worst = fmax(worst, fabs(regularised_slip(slip, &settings) / pow(slip, 1 / exponents[k]) - 1));
        }
        print_message("c = %g: %.2g\n", exponents[k], worst);
        // Round-off: a power of c has about 2 log2(c) of them, divided by c; c = 3 is the worst whole one.
        assert_true(worst < 3e-14);
        assert_true(regularised_slip(0, &settings) == 0);
    }
}

/// y of y^c + g y = b by halving.
static double root_by_halving(double b, double g, double c)
{
    double low = 0, high = fmin(b / g, pow(b, 1 / c)) * (1 + 1e-12);
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        *(pow(middle, c) + g * middle > b ? &high : &low) = middle;
    }
    return low;
}

static void implicit_friction_solves_its_equation(void **unused)
{
    (void)unused;
    const double cases[][2] = {{2, 1e-3}, {50, 1e-3}, {50.5, 1e-3}, {200, 2e-3}}; // c, error (the head of the law)
    for (size_t k = 0; k < COUNT_OF(cases); ++k) {
        const law_settings settings = settings_of(cases[k][0]);
        double worst = 0;
        for (double b = 1e-9; b < 1e6; b *= 1.31)
            for (double g = 1e-9; g < 1e6; g *= 1.37)
                worst = fmax(worst, fabs(mobilised_friction(b, g, &settings) / root_by_halving(b, g, cases[k][0]) - 1));
        print_message("c = %g: %.2g\n", cases[k][0], worst);
        assert_true(worst < cases[k][1]);
        assert_true(mobilised_friction(0, 1, &settings) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_those_of_pow),
        cmocka_unit_test(implicit_friction_solves_its_equation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
