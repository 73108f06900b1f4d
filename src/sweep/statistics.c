/// Statistics over realisations. Values are added in the order of the members, so results do not depend on scheduling.
#include "sweep/statistics.h"

#include "base/memory.h"

#include <gsl/gsl_cdf.h>

#include <math.h>
#include <stdbool.h>

scree_estimate scree_estimate_mean(const double *value, size_t count, double confidence)
{
    scree_estimate e = {0, count, NAN, NAN, NAN, {NAN, NAN}};
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) continue;
        sum += value[i];
        e.range[0] = fmin(e.range[0], value[i]);
        e.range[1] = fmax(e.range[1], value[i]);
        e.count++;
    }
    if (e.count == 0) return e;
    double n = (double)e.count;
    e.mean = sum / n;
    if (e.count < 2) return e;
    for (size_t i = 0; i < count; i++)
        if (isfinite(value[i])) squares += (value[i] - e.mean) * (value[i] - e.mean);
    e.deviation = sqrt(squares / (n - 1));
    e.half = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, n - 1) * e.deviation / sqrt(n);
    return e;
}

scree_status scree_curve_from_series(const double *x, const double *y, const double *stage, size_t rows,
                                     scree_curve *curve, scree_error *error)
{
    *curve = (scree_curve){0};
    scree_status status = scree_allocate(&curve->x, rows, sizeof *curve->x, error);
    if (!status) status = scree_allocate(&curve->y, rows, sizeof *curve->y, error);
    if (status) {
        scree_curve_destroy(curve);
        return status;
    }
    double last_stage = 0;
    for (size_t i = 0; i < rows; i++) {
        if (!isfinite(x[i]) || !isfinite(y[i])) continue;
        bool below = curve->count > 0 && x[i] <= curve->x[curve->count - 1];
        if (below && stage && stage[i] != last_stage) curve->count = 0;
        if (stage) last_stage = stage[i];
        if (curve->count > 0 && x[i] <= curve->x[curve->count - 1]) continue;
        curve->x[curve->count] = x[i];
        curve->y[curve->count++] = y[i];
    }
    return SCREE_OK;
}

void scree_curve_destroy(scree_curve *curve)
{
    scree_release(&curve->x);
    scree_release(&curve->y);
    *curve = (scree_curve){0};
}

double scree_curve_at(const scree_curve *curve, double x)
{
    size_t low = 0, high = curve->count;
    if (high == 0 || !(x >= curve->x[0]) || !(x <= curve->x[high - 1])) return NAN;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (curve->x[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    if (low + 1 == curve->count) return curve->y[low];
    double part = (x - curve->x[low]) / (curve->x[low + 1] - curve->x[low]);
    return curve->y[low] + part * (curve->y[low + 1] - curve->y[low]);
}

scree_status scree_curves_average(const scree_curve *curve, size_t count, double confidence, size_t places, double *x,
                                  scree_estimate *estimate, scree_error *error)
{
    double from = -INFINITY, to = INFINITY, *value;
    for (size_t i = 0; i < count; i++) {
        if (curve[i].count == 0) return scree_error_set(error, SCREE_ERROR_INPUT, "a curve has no point");
        from = fmax(from, curve[i].x[0]);
        to = fmin(to, curve[i].x[curve[i].count - 1]);
    }
    if (count == 0 || places < 2 || !(from < to))
        return scree_error_set(error, SCREE_ERROR_INPUT, "the curves have no range in common");
    scree_status status = scree_allocate(&value, count, sizeof *value, error);
    if (status) return status;
    for (size_t k = 0; k < places; k++) {
        // The last place is the end itself, not what rounding makes of it.
        x[k] = k + 1 == places ? to : from + (to - from) * (double)k / (double)(places - 1);
        for (size_t i = 0; i < count; i++) value[i] = scree_curve_at(&curve[i], x[k]);
        estimate[k] = scree_estimate_mean(value, count, confidence);
    }
    scree_release(&value);
    return SCREE_OK;
}
