/// Lowest and highest pressures under heaps that are not symmetric.
#include "average/minimum.h"

#include "average/table.h"

#include <math.h>

enum { PLACE, DEPTH, HIGHEST, NUMBERS };

/// What a mean profile says. apex: from the axis, -1 to 1; rim: room for as many.
static void look(const double *mean, size_t points, double apex, double *rim, double number[NUMBERS])
{
    const double gap = 2 / (double)(points - 1);
    size_t least = 0, most = 0;
    double largest = -INFINITY, deepest = 0;
    for (size_t j = 0; j < points; j++) {
        rim[j] = largest;
        largest = fmax(largest, mean[j]);
        if (mean[j] > mean[most]) most = j;
    }
    largest = -INFINITY;
    for (size_t j = points; j-- > 0;) {
        rim[j] = fmin(rim[j], largest);
        largest = fmax(largest, mean[j]);
        if (!(rim[j] - mean[j] > deepest)) continue;
        deepest = rim[j] - mean[j];
        least = j;
    }
    number[PLACE] = deepest > 0 ? (double)least * gap - 1 - apex : NAN;
    number[DEPTH] = deepest > 0 ? deepest / rim[least] : 0;
    number[HIGHEST] = (double)most * gap - 1 - apex;
    if (mean[most] > 0) return;
    for (int k = 0; k < NUMBERS; k++) number[k] = NAN; // there is no pressure
}

/// Mean of the heaps of a resample (SIZE_MAX: each once) and of their apexes.
static double take_mean(const double *profile, const double *apex, size_t heaps, size_t points, size_t resample,
                        double *mean)
{
    double at = 0;
    for (size_t j = 0; j < points; j++) mean[j] = 0;
    for (size_t i = 0; i < heaps; i++) {
        const size_t which = resample == SIZE_MAX ? i : scree_average_drawn(resample, i, heaps);
        at += apex[which] / (double)heaps;
        for (size_t j = 0; j < points; j++) {
            const double value = profile[which * points + j];
            mean[j] += (isfinite(value) ? value : 0) / (double)heaps;
        }
    }
    return at;
}

scree_status scree_average_minimum_find(const double *profile, const double *apex, size_t heaps, size_t points,
                                        scree_average_minimum *minimum, scree_error *error)
{
    enum { DRAWS = SCREE_AVERAGE_BOOTSTRAP };
    scree_average_between *const of[NUMBERS] = {&minimum->place, &minimum->depth, &minimum->highest};
    double *mean = NULL, *rim = NULL, *draw = NULL, number[NUMBERS];
    scree_status status = scree_allocate(&mean, points, sizeof *mean, error);
    if (!status) status = scree_allocate(&rim, points, sizeof *rim, error);
    if (!status) status = scree_allocate(&draw, (size_t)NUMBERS * DRAWS, sizeof *draw, error);
    if (!status) {
        look(mean, points, take_mean(profile, apex, heaps, points, SIZE_MAX, mean), rim, number);
        for (int k = 0; k < NUMBERS; k++) *of[k] = (scree_average_between){number[k], NAN, NAN};
        minimum->share = NAN;
    }
    if (!status && heaps > 1) {
        size_t found = 0;
        for (size_t b = 0; b < DRAWS; b++) {
            look(mean, points, take_mean(profile, apex, heaps, points, b, mean), rim, number);
            for (size_t k = 0; k < NUMBERS; k++) draw[k * DRAWS + b] = number[k];
            found += isfinite(number[PLACE]);
        }
        minimum->share = (double)found / DRAWS;
        for (size_t k = 0; k < NUMBERS; k++) {
            of[k]->low = scree_average_quantile(draw + k * DRAWS, DRAWS, scree_average_tail(heaps));
            of[k]->high = scree_average_quantile(draw + k * DRAWS, DRAWS, 1 - scree_average_tail(heaps));
        }
    }
    scree_release(&mean);
    scree_release(&rim);
    scree_release(&draw);
    return status;
}
