/// Arrivals and dispersion relations of signals that are known.
#include "testing.h"

#include "measure/arrival.h"
#include "measure/dispersion.h"

#include <math.h>
#include <stdlib.h>

enum { COUNT = 400 };

static double bell(double t, double centre, double width)
{
    return exp(-0.5 * pow((t - centre) / width, 2));
}

/// A parabola through three samples of a bell of width w is off by some 1 / (12 w^2) of a sample at most: 1e-3 for 10.
static void peaks_between_samples(void **unused)
{
    (void)unused;
    double signal[COUNT], later[COUNT];
    for (int k = 0; k < COUNT; k++) {
        signal[k] = -3 * bell(k, 100.3, 10);
        // What comes back is larger, and does not matter; before the wave comes there is a ripple.
        later[k] = -2 * bell(k, 163.8, 10) - 2.6 * bell(k, 330, 10) + 0.02 * sin(k);
    }
    const scree_pulse a = scree_pulse_find(signal, COUNT), b = scree_pulse_find(later, COUNT);
    assert_true(fabs(a.peak - 100.3) < 1e-3);
    // The ripple moves the top of the bell, 2 / 100 steep a sample beside it, by one sample at most.
    assert_true(fabs(b.peak - 163.8) < 1);
    assert_true(a.begin < 90 && a.end > 110 && b.end < 230);
    const double lag = scree_pulse_lag(signal, &a, later, &b);
    print_message("peaks %.4f and %.4f, lag %.4f\n", a.peak, b.peak, lag);
    assert_true(fabs(lag - 63.5) < 0.1);
}

static void signals_without_a_peak(void **unused)
{
    (void)unused;
    double rising[COUNT], still[COUNT] = {0}, falling[COUNT];
    for (int k = 0; k < COUNT; k++) {
        rising[k] = k;
        falling[k] = COUNT - k;
    }
    assert_true(isnan(scree_pulse_find(rising, COUNT).peak));
    assert_true(isnan(scree_pulse_find(falling, COUNT).peak));
    assert_true(isnan(scree_pulse_find(still, COUNT).peak));
    assert_true(isnan(scree_pulse_find(rising, 2).peak));
    const scree_pulse none = scree_pulse_find(still, COUNT), some = {.begin = 1, .end = 9, .peak = 4};
    assert_true(isnan(scree_pulse_lag(still, &none, rising, &some)));
}

/// Standing waves of a chain, w = 2 sin(k / 2), all wavenumbers at once. The time is some 25 periods of the longest and
/// the parabola finds a peak to a hundredth of a bin: 2 pi / 400 / 100 of 0.2 is 1e-3.
static void chain(void **unused)
{
    (void)unused;
    enum { LAYERS = 32, RECORDS = 2000 };
    const double interval = 0.4;
    double *value = calloc(LAYERS * RECORDS, sizeof *value);
    scree_dispersion_point point[LAYERS / 2];
    scree_error error;
    for (int n = 0; n < RECORDS; n++)
        for (int j = 0; j < LAYERS; j++)
            for (int m = 1; m <= LAYERS / 2; m++) {
                const double k = 2 * M_PI * m / LAYERS, w = 2 * sin(k / 2);
                value[n * LAYERS + j] += cos(k * j) * cos(w * interval * n + m) + 5e-3;
            }
    check(scree_dispersion_find(value, LAYERS, RECORDS, 2, interval, true, point, &error), &error);
    double worst = 0;
    for (int m = 1; m <= LAYERS / 2; m++) {
        const double k = 2 * M_PI * m / LAYERS, w = 2 * sin(k / 2);
        assert_true(fabs(point[m - 1].wavenumber - k / 2) < 1e-12);
        worst = fmax(worst, fabs(point[m - 1].frequency / w - 1));
        assert_true(point[m - 1].share > 0.9);
    }
    print_message("largest deviation %.2g\n", worst);
    assert_true(worst < 1e-3);
    assert_int_equal(scree_dispersion_find(value, 3, RECORDS, 2, interval, true, point, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_dispersion_find(value, LAYERS, 15, 2, interval, true, point, &error), SCREE_ERROR_INPUT);
    free(value);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(peaks_between_samples),
        cmocka_unit_test(signals_without_a_peak),
        cmocka_unit_test(chain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
