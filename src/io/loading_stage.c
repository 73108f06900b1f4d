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

static double range_of(const double *strain, scree_loading_rows rows)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = rows.first; k < rows.last && strain; k++) {
        low = fmin(low, strain[k]);
        high = fmax(high, strain[k]);
    }
    return high > low ? high - low : 0;
}

static bool have_plates_worked(const scree_series *series, scree_loading_rows rows)
{
    const double *work = scree_series_get(series, "work_plates");
    for (size_t k = rows.first; work && k < rows.last; k++)
        if (work[k] != 0 && !isnan(work[k])) return true;
    return false;
}

scree_loading_path scree_loading_path_find(const scree_series *series)
{
    scree_loading_path path = {.rows = scree_loading_rows_find(series),
                               .strain = scree_series_get(series, "axial_strain")};
    const double *flat = scree_series_get(series, "strain_yy"), *solid = scree_series_get(series, "strain_zz"),
                 *shear = scree_series_get(series, "strain_shear");
    scree_loading_rows all = {0, path.rows.last};
    while (flat && all.first < path.rows.first && !isfinite(flat[all.first])) all.first++;
    path.plates = have_plates_worked(series, flat ? all : path.rows);
    if (!flat || path.rows.last == 0) return path;
    const double *axial = solid && isfinite(solid[all.last - 1]) ? solid : flat;
    // Between plates a sample may lean to a side while it is pressed; a cell shears where it is told to.
    path.sheared = !path.plates && range_of(shear, all) > range_of(axial, all);
    if (all.first == path.rows.first) return path;
    path.rows = all;
    path.strain = path.sheared ? shear : axial;
    path.label = path.sheared ? "shear strain since the first loading (%)"
                              : "axial strain since the first loading (%), compression positive";
    return path;
}

/// The end of the branch that begins with the first of these rows: behind the row at which the strain turns, by more
/// than a hundredth of the window.
static size_t branch_end(const double *strain, scree_loading_rows rows)
{
    const double turn = 0.01 * SCREE_PEAK_WINDOW;
    size_t extreme = rows.first;
    double direction = 0;
    for (size_t k = rows.first; k < rows.last; k++) {
        const double way = strain[k] - strain[rows.first], on = strain[k] - strain[extreme];
        if (direction == 0 && fabs(way) > turn) direction = way > 0 ? 1 : -1;
        if (direction == 0 ? fabs(way) > fabs(strain[extreme] - strain[rows.first]) : direction * on > 0) extreme = k;
        if (direction * on < -turn) return extreme + 1;
    }
    return rows.last;
}

/// Of the window: a stage that ends at a strain ends a little before it.
static const double ENOUGH = 0.99;

/// Mean of the ratio over the rows about row k.
static double running_mean(const double *ratio, const double *strain, scree_loading_rows rows, size_t k)
{
    double sum = ratio[k], count = 1, half = 0.5 * SCREE_PEAK_WINDOW;
    for (size_t j = k; j > rows.first && fabs(strain[k] - strain[j - 1]) <= half; j--, count++) sum += ratio[j - 1];
    for (size_t j = k + 1; j < rows.last && fabs(strain[j] - strain[k]) <= half; j++, count++) sum += ratio[j];
    return sum / count;
}

scree_peak scree_peak_find(const double *ratio, const double *strain, scree_loading_rows rows)
{
    scree_peak peak = {NAN, NAN};
    for (scree_loading_rows branch = {rows.first, rows.first}; branch.last < rows.last;) {
        branch.last = branch_end(strain, (scree_loading_rows){branch.first, rows.last});
        const bool whole = branch.last - branch.first == rows.last - rows.first;
        const bool wide = whole || range_of(strain, branch) >= ENOUGH * SCREE_PEAK_WINDOW;
        for (size_t k = branch.first; k < branch.last && wide; k++) {
            if (!isfinite(strain[k])) continue;
            double value = running_mean(ratio, strain, branch, k);
            if (value > peak.value || (isnan(peak.value) && !isnan(value))) peak = (scree_peak){value, strain[k]};
        }
        // The row of the turn is of both branches.
        branch.first = branch.last - 1;
    }
    return peak;
}

scree_first_peak scree_first_peak_find(const double *value, const double *strain, scree_loading_rows rows, double fall)
{
    scree_first_peak peak = {NAN, NAN, NAN};
    double lowest = 0, highest = 0;
    bool followed = false;
    for (size_t k = rows.first; k < rows.last; k++) highest = fmax(highest, value[k]);
    for (size_t k = rows.first; k < rows.last; k++) {
        if (!followed && value[k] > 0 && value[k] >= SCREE_PEAK_SHARE * highest && !(value[k] <= peak.value)) {
            peak = (scree_first_peak){value[k], strain[k], NAN};
            lowest = value[k];
        }
        if (isnan(peak.value) || !(value[k] < lowest)) continue;
        lowest = value[k];
        followed = followed || lowest <= (1 - fall) * peak.value;
    }
    if (!followed) return (scree_first_peak){NAN, NAN, NAN};
    peak.dip = 1 - lowest / peak.value;
    return peak;
}

/// Counts the maxima; the rows of the first two go into `row` (NULL: not wanted).
static size_t count_maxima(const double *value, scree_loading_rows rows, double share, size_t *row)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t k = rows.first; k < rows.last; k++) {
        least = fmin(least, value[k]);
        most = fmax(most, value[k]);
    }
    double apart = share * (most - least);
    if (!(apart > 0)) return 0;
    // The extreme since the last turn; a turn counts when the curve has come back from it by `apart`.
    size_t count = 0, highest = rows.first;
    double low = value[rows.first];
    bool rose = false;
    for (size_t k = rows.first; k < rows.last; k++) {
        if (value[k] > value[highest]) highest = k;
        low = fmin(low, value[k]);
        if (!rose && value[k] >= low + apart) {
            rose = true;
            highest = k;
        } else if (rose && value[k] <= value[highest] - apart) {
            if (row && count < 2) row[count] = highest;
            rose = false;
            low = value[k];
            count++;
        }
    }
    return count;
}

size_t scree_maxima_count(const double *value, scree_loading_rows rows, double share)
{
    return count_maxima(value, rows, share, NULL);
}

bool scree_maxima_most(const double *value, scree_loading_rows rows, size_t row[2])
{
    double low = 0, high = 1; // shares of the range with two maxima and more, and with fewer
    while (high - low > 1e-12) {
        const double share = 0.5 * (low + high);
        if (count_maxima(value, rows, share, NULL) >= 2)
            low = share;
        else
            high = share;
    }
    return count_maxima(value, rows, low, row) >= 2;
}

bool scree_snapshot_begins_stage(const char *before, const char *now, double strain)
{
    return strcmp(before, now) != 0 || strain == 0;
}
