#include "io/loading_stage.h"

#include <math.h>
#include <string.h>

scree_loading_rows scree_loading_rows_find(const scree_series *series)
{
    const double *stage = scree_series_get(series, "stage"), *strain = scree_series_get(series, "axial_strain");
    scree_loading_rows rows = {0};
    if (!stage || !strain) return rows;
    rows.last = series->row_count;
    while (rows.last > 0 && !isfinite(strain[rows.last - 1])) rows.last--;
    rows.first = rows.last;
    while (rows.first > 0 && stage[rows.first - 1] == stage[rows.last - 1]) rows.first--;
    return rows;
}

/// Mean of the ratio over the rows about row k.
static double running_mean(const double *ratio, const double *strain, scree_loading_rows rows, size_t k)
{
    double sum = ratio[k], count = 1, half = 0.5 * SCREE_PEAK_WINDOW;
    for (size_t j = k; j > rows.first && strain[k] - strain[j - 1] <= half; j--, count++) sum += ratio[j - 1];
    for (size_t j = k + 1; j < rows.last && strain[j] - strain[k] <= half; j++, count++) sum += ratio[j];
    return sum / count;
}

scree_peak scree_peak_find(const double *ratio, const double *strain, scree_loading_rows rows)
{
    scree_peak peak = {NAN, NAN};
    for (size_t k = rows.first; k < rows.last; k++) {
        double value = running_mean(ratio, strain, rows, k);
        if (value > peak.value || (isnan(peak.value) && !isnan(value))) peak = (scree_peak){value, strain[k]};
    }
    return peak;
}

bool scree_snapshot_begins_stage(const char *before, const char *now, double strain)
{
    return strcmp(before, now) != 0 || strain == 0;
}
