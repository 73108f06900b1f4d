/// Space-time transform. For each wavenumber k the displacements are summed with exp(-i k x), then transformed in time
/// (GSL, radix 2) under a Hann window and with four times as many times, zeros, behind: the largest power of both
/// senses, by a parabola through its logarithm, is the frequency. A sample that does not repeat itself has a Hann
/// window in space, too, which makes its waves some 2 pi / length wide.
///
/// Limits: frequencies are resolved to about 2 pi / (time), and found to a hundredth of that where one wave is far
/// stronger than all others; waves above half of the rate of recording are folded. Cost: layers^2 records / 2, and a
/// transform a wavenumber.
#include "measure/dispersion.h"

#include "base/memory.h"
#include "measure/arrival.h"

#include <gsl/gsl_fft_complex.h>
#include <math.h>

enum { PADDING = 4, WIDTH = 2 * PADDING };

static double hann(size_t k, size_t count)
{
    return 0.5 - 0.5 * cos(2 * M_PI * ((double)k + 0.5) / (double)count);
}

/// Amplitude of a wavenumber over time, less its mean: `records` complex numbers.
static void project(const double *value, size_t layers, size_t records, double turn, bool periodic, double *wave)
{
    double mean[2] = {0};
    for (size_t n = 0; n < records; n++) {
        wave[2 * n] = wave[2 * n + 1] = 0;
        for (size_t j = 0; j < layers; j++) {
            const double u = value[n * layers + j] * (periodic ? 1 : hann(j, layers)), phase = turn * (double)j;
            wave[2 * n] += u * cos(phase);
            wave[2 * n + 1] -= u * sin(phase);
        }
        for (int c = 0; c < 2; c++) mean[c] += wave[2 * n + (size_t)c] / (double)records;
    }
    for (size_t n = 0; n < records; n++)
        for (int c = 0; c < 2; c++) wave[2 * n + (size_t)c] = (wave[2 * n + (size_t)c] - mean[c]) * hann(n, records);
}

/// Power of both senses at the frequency of number k.
static double power_of(const double *wave, size_t size, size_t k)
{
    const size_t other = (size - k) % size;
    return wave[2 * k] * wave[2 * k] + wave[2 * k + 1] * wave[2 * k + 1] + wave[2 * other] * wave[2 * other] +
           wave[2 * other + 1] * wave[2 * other + 1];
}

static void find_peak(const double *wave, size_t size, double interval, scree_dispersion_point *point)
{
    size_t most = 1;
    double all = 0, around = 0;
    for (size_t k = 1; k < size / 2; k++) {
        all += power_of(wave, size, k);
        if (power_of(wave, size, k) > power_of(wave, size, most)) most = k;
    }
    for (size_t k = most > WIDTH ? most - WIDTH : 1; k <= most + WIDTH && k < size / 2; k++)
        around += power_of(wave, size, k);
    const double side[3] = {log(power_of(wave, size, most - 1)), log(power_of(wave, size, most)),
                            log(power_of(wave, size, most + 1))};
    const double place = (double)most + scree_parabola_vertex(side[0], side[1], side[2]);
    point->frequency = all > 0 ? 2 * M_PI * place / ((double)size * interval) : (double)NAN;
    point->share = all > 0 ? around / all : 0;
}

scree_status scree_dispersion_find(const double *value, size_t layers, size_t records, double spacing, double interval,
                                   bool periodic, scree_dispersion_point *point, scree_error *error)
{
    size_t size = 1;
    double *wave;
    if (layers < 4 || records < 16)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "%zu layers at %zu times are too few for a dispersion relation: 4 layers and 16 times",
                               layers, records);
    while (size < PADDING * records) size *= 2;
    scree_status status = scree_allocate(&wave, 2 * size, sizeof *wave, error);
    if (status) return status;
    for (size_t m = 1; m <= layers / 2; m++) {
        const double turn = 2 * M_PI * (double)m / (double)layers;
        for (size_t k = 2 * records; k < 2 * size; k++) wave[k] = 0;
        project(value, layers, records, turn, periodic, wave);
        // It fails for sizes that are no power of 2 alone.
        (void)gsl_fft_complex_radix2_forward(wave, 1, size);
        point[m - 1].wavenumber = turn / spacing;
        find_peak(wave, size, interval, &point[m - 1]);
    }
    scree_release(&wave);
    return SCREE_OK;
}
