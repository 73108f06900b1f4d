/// Arrivals: the peak of a pulse ("peak to peak" of Madan 2019, 5.2), and cross-correlation of two.
#include "measure/arrival.h"

#include <math.h>

double scree_parabola_vertex(double left, double middle, double right)
{
    const double bend = left - 2 * middle + right;
    return bend < 0 ? 0.5 * (left - right) / bend : 0;
}

/// Sample of the largest magnitude in [begin, end).
static size_t find_largest(const double *signal, size_t begin, size_t end)
{
    size_t most = begin;
    for (size_t k = begin; k < end; k++)
        if (fabs(signal[k]) > fabs(signal[most])) most = k;
    return most;
}

scree_pulse scree_pulse_find(const double *signal, size_t count)
{
    scree_pulse pulse = {.peak = NAN};
    if (count < 3) return pulse;
    const double half = 0.5 * fabs(signal[find_largest(signal, 0, count)]);
    size_t begin = 0;
    if (!(half > 0)) return pulse;
    while (fabs(signal[begin]) < half) begin++;
    size_t end = begin;
    while (end < count && fabs(signal[end]) >= half) end++;
    const size_t most = find_largest(signal, begin, end);
    const double least = 0.1 * fabs(signal[most]);
    // A signal that begins or ends at its largest value has no peak there.
    if (most == 0 || most + 1 == count) return pulse;
    pulse.peak =
        (double)most + scree_parabola_vertex(fabs(signal[most - 1]), fabs(signal[most]), fabs(signal[most + 1]));
    for (pulse.begin = most; pulse.begin > 0 && fabs(signal[pulse.begin - 1]) > least;) pulse.begin--;
    for (pulse.end = most + 1; pulse.end < count && fabs(signal[pulse.end]) > least;) pulse.end++;
    return pulse;
}

static double product(const double *a, const scree_pulse *first, const double *b, const scree_pulse *second, long lag)
{
    double sum = 0;
    for (size_t k = first->begin; k < first->end; k++) {
        const long other = (long)k + lag;
        if (other >= (long)second->begin && other < (long)second->end) sum += a[k] * b[other];
    }
    return sum;
}

double scree_pulse_lag(const double *a, const scree_pulse *first, const double *b, const scree_pulse *second)
{
    if (isnan(first->peak) || isnan(second->peak)) return NAN;
    const long from = (long)second->begin - (long)first->end + 1, to = (long)second->end - (long)first->begin;
    long best = from;
    double most = -INFINITY;
    for (long lag = from; lag < to; lag++) {
        const double sum = product(a, first, b, second, lag);
        if (!(sum > most)) continue;
        most = sum;
        best = lag;
    }
    return (double)best +
           scree_parabola_vertex(product(a, first, b, second, best - 1), most, product(a, first, b, second, best + 1));
}
