/// Rows count whose load lies in the range, from the last time that it comes in before the peak. Rows that are no
/// numbers are left out. Cost: at most 136 ranges, a pass over the rows each.
#include "measure/linear_range.h"

#include <math.h>
#include <stdbool.h>

enum { LEAST_ROWS = 4, STEPS = 20, LEAST_STEPS = 4 };

static size_t peak_of(const scree_curve *c)
{
    size_t peak = 0;
    double most = 0;
    for (size_t k = 0; k < c->count; k++)
        if (fabs(c->load[k]) > most) {
            most = fabs(c->load[k]);
            peak = k;
        }
    return peak;
}

/// The first row of the range: behind the last one before `end` whose load is below.
static size_t begin_of(const scree_curve *c, size_t end, double low)
{
    size_t first = end;
    while (first > 0 && !(fabs(c->load[first - 1]) < low)) first--;
    return first;
}

/// Line through the rows between two shares; false: there are too few, or x stands still.
static bool fit(const scree_curve *c, size_t peak, double from, double to, scree_linear_range *r)
{
    const double most = fabs(c->load[peak]), low = from * most, high = to * most;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, least = INFINITY, largest = -INFINITY;
    *r = (scree_linear_range){.from = from, .to = to, .slope = NAN, .departure = INFINITY};
    const size_t first = begin_of(c, peak, low);
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = first; k <= peak; k++) {
            const double load = fabs(c->load[k]);
            if (!(load >= low && load <= high) || !isfinite(c->x[k]) || !isfinite(c->y[k])) continue;
            if (pass == 0) {
                n++;
                x += c->x[k];
                y += c->y[k];
                least = fmin(least, c->y[k]);
                largest = fmax(largest, c->y[k]);
            } else {
                xx += (c->x[k] - x / n) * (c->x[k] - x / n);
                xy += (c->x[k] - x / n) * (c->y[k] - y / n);
            }
        }
    r->rows = (size_t)n;
    if (n < LEAST_ROWS || !(xx > 0)) return false;
    r->slope = xy / xx;
    double off = 0;
    for (size_t k = first; k <= peak; k++) {
        const double load = fabs(c->load[k]);
        if (load >= low && load <= high && isfinite(c->x[k]) && isfinite(c->y[k]))
            off = fmax(off, fabs(c->y[k] - y / n - r->slope * (c->x[k] - x / n)));
    }
    // A y that does not change at all is straight.
    r->departure = largest > least ? off / (largest - least) : 0;
    return true;
}

/// The widest straight range; else *best is the straightest.
static bool search(const scree_curve *c, size_t peak, double straight, scree_linear_range *best)
{
    *best = (scree_linear_range){.departure = INFINITY};
    for (int width = STEPS; width >= LEAST_STEPS; width--)
        for (int low = 0; low + width <= STEPS; low++) {
            scree_linear_range r;
            if (!fit(c, peak, (double)low / STEPS, (double)(low + width) / STEPS, &r)) continue;
            if (r.departure < best->departure) *best = r;
            if (r.departure <= straight) return *best = r, true;
        }
    return false;
}

static scree_status find(const scree_curve *curve, size_t peak, double from, double to, double straight,
                         scree_linear_range *range, scree_error *error)
{
    *range = (scree_linear_range){.from = from, .to = to, .slope = NAN, .departure = NAN};
    if (curve->count == 0 || !(fabs(curve->load[peak]) > 0))
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no load");
    if (isnan(from) || isnan(to)) {
        if (search(curve, peak, straight, range)) return SCREE_OK;
        if (!isfinite(range->departure))
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "no range has %d samples or more: take more samples (measure.samples)", LEAST_ROWS);
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "there is no straight part: the best, from %.0f %% to %.0f %% of the peak, departs by "
                               "%.2g %% from its line (accepted %.2g %%)",
                               100 * range->from, 100 * range->to, 100 * range->departure, 100 * straight);
    }
    if (!fit(curve, peak, from, to, range))
        return scree_error_set(
            error, SCREE_ERROR_INPUT,
            "from %.0f %% to %.0f %% of the peak there are %zu samples, and %d are needed: take more "
            "samples (measure.samples)",
            100 * from, 100 * to, range->rows, LEAST_ROWS);
    if (range->departure <= straight) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "from %.0f %% to %.0f %% of the peak it is not straight: it departs by %.2g %% from its "
                           "line (accepted %.2g %%)",
                           100 * from, 100 * to, 100 * range->departure, 100 * straight);
}

scree_status scree_linear_range_find(const scree_curve *curve, double from, double to, double straight,
                                     scree_linear_range *range, scree_error *error)
{
    const size_t peak = peak_of(curve);
    const bool loaded = curve->count > 0 && fabs(curve->load[peak]) > 0;
    scree_status status = find(curve, peak, from, to, straight, range, error);
    range->peak = loaded ? fabs(curve->load[peak]) : (double)NAN;
    range->at = loaded ? curve->x[peak] : (double)NAN;
    return status;
}
