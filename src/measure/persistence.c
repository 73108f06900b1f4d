/// What consecutive strain windows have in common, and what kind of localisation that makes.
///
/// PERCOLATES, OVERLAPS, CORRELATED and PERSISTENT are decisions: a band counts as spanning the sample when a connected
/// part of it reaches over 80 % of its length; as there still when half of the bodies in either band are in both, or
/// the distortions at the bodies are correlated by half or more: of two bands that cross, now one and now the other is
/// the stronger, though neither moves. Persistent is what holds for two thirds of the pairs of windows. P calls bands
/// persistent that stay where they are and intensify (figs. 3.7, 3.8), and intermittent those that do not propagate
/// through the subsequent window (fig. 3.9).
#include "measure/localisation.h"

#include <math.h>

#define PERCOLATES 0.8
#define OVERLAPS   0.5
#define CORRELATED 0.5
#define PERSISTENT (2.0 / 3)

double scree_field_correlation(const double *first, const double *second, size_t count)
{
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(first[i]) || !isfinite(second[i])) continue;
        n++;
        x += first[i];
        y += second[i];
    }
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(first[i]) || !isfinite(second[i])) continue;
        double dx = first[i] - x / n, dy = second[i] - y / n;
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    return xx > 0 && yy > 0 ? xy / sqrt(xx * yy) : NAN;
}

double scree_band_overlap(const uint8_t *first, const uint8_t *second, size_t count)
{
    size_t both = 0, either = 0;
    for (size_t i = 0; i < count; i++) {
        both += first[i] && second[i];
        either += first[i] || second[i];
    }
    return either > 0 ? (double)both / (double)either : 0;
}

static bool spans(const scree_band_window *window)
{
    return window->localisation.band.found && window->localisation.band.percolation >= PERCOLATES;
}

scree_band_kind scree_bands_classify(const scree_band_window *window, size_t count, double *persistence)
{
    *persistence = NAN;
    if (count == 0) return SCREE_BANDS_NONE;
    size_t first = count / 2, pairs = 0, kept = 0;
    if (first > 0 && count - first < 2) first--;
    bool any = false;
    double sum = 0;
    for (size_t k = first; k < count; k++) {
        any = any || window[k].localisation.localised || window[k].localisation.band.found;
        if (k == first) continue;
        pairs++;
        if (!spans(&window[k]) || !spans(&window[k - 1])) continue;
        sum += fmax(window[k].overlap, window[k].correlation);
        kept += window[k].overlap >= OVERLAPS || window[k].correlation >= CORRELATED;
    }
    if (pairs > 0) *persistence = sum / (double)pairs;
    if (pairs > 0 && (double)kept >= PERSISTENT * (double)pairs) return SCREE_BANDS_PERSISTENT;
    return any ? SCREE_BANDS_INTERMITTENT : SCREE_BANDS_NONE;
}
