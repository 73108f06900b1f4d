/// When a wave arrives: peaks of signals, and the lag of one behind another.
#ifndef SCREE_MEASURE_ARRIVAL_H
#define SCREE_MEASURE_ARRIVAL_H

#include <stddef.h>

/// A first pulse: where a signal is above a tenth of its peak without interruption.
typedef struct scree_pulse {
    size_t begin, end; ///< samples, end not included; nothing: none
    double peak;       ///< in samples from the first one; NAN: none
} scree_pulse;

/// The first pulse of a signal, in magnitude. Its peak is the largest value of the first stretch above half of the
/// largest of all, by a parabola through three samples: what comes back later does not matter, unless it arrives within
/// that stretch.
scree_pulse scree_pulse_find(const double *signal, size_t count);

/// By how many samples the first pulse of b comes behind that of a: the largest sum of a(t) b(t + lag), by a parabola;
/// each is zero outside of its pulse. NAN: one has none. Cost: the product of their lengths.
double scree_pulse_lag(const double *a, const scree_pulse *first, const double *b, const scree_pulse *second);

/// Place of the vertex of the parabola through (-1, left), (0, middle), (1, right), with the middle the largest.
double scree_parabola_vertex(double left, double middle, double right);

#endif
