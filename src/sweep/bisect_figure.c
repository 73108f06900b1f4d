/// What the runs of a search for a limit did: a column of their series over time, of those that stood and those that
/// did not, as a chart (as M's figs. 3.5, 3.7, 3.11, 3.13). A curve ends where it leaves what the standing ones keep to
/// by more than BEYOND times: further out it would hide them.
#include "sweep/bisect.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "io/series.h"
#include "view/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define BEYOND 2.0

static const char *unit_of(const scree_series *series, const char *name)
{
    for (size_t k = 0; k < series->column_count; k++)
        if (strcmp(series->name[k], name) == 0) return series->unit[k];
    return "1";
}

static double largest_of(const double *value, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) most = fmax(most, fabs(value[k]));
    return most;
}

/// ms, in the place of its seconds.
static const double *time_of(scree_series *series)
{
    for (size_t k = 0; k < series->column_count; k++) {
        if (strcmp(series->name[k], "time") != 0) continue;
        for (size_t row = 0; row < series->row_count; row++) series->value[k][row] *= 1e3;
        return series->value[k];
    }
    return NULL;
}

/// Rows up to the one that is out of bounds.
static size_t rows_within(const double *value, size_t count, double bound)
{
    size_t k = 0;
    while (k < count && fabs(value[k]) <= bound) k++;
    return k;
}

static scree_status read_all(const scree_bisection_curve *curve, size_t count, scree_series *series, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < count && !status; k++) {
        char path[PATH_MAX];
        status = scree_path_join(path, sizeof path, curve[k].folder, SCREE_FILE_SERIES, error);
        if (!status) status = scree_series_read(&series[k], path, error);
    }
    return status;
}

static scree_status draw(const char *path, const char *title, const char *column, const scree_bisection_curve *curve,
                         scree_series *series, size_t count, scree_error *error)
{
    scree_chart_line line[SCREE_BISECTION_CURVES] = {0};
    char label[128];
    double bound = 0;
    for (size_t k = 0; k < count; k++) {
        const double *y = scree_series_get(&series[k], column);
        if (!y) return scree_error_set(error, SCREE_ERROR_INPUT, "series.csv of the runs has no column '%s'", column);
        if (curve[k].stands) bound = fmax(bound, BEYOND * largest_of(y, series[k].row_count));
    }
    for (size_t k = 0; k < count; k++) {
        const double *y = scree_series_get(&series[k], column);
        line[k] = (scree_chart_line){.x = time_of(&series[k]),
                                     .y = y,
                                     .count = rows_within(y, series[k].row_count, bound),
                                     .label = curve[k].label,
                                     .dashed = !curve[k].stands};
    }
    (void)snprintf(label, sizeof label, "%s (%s)", column, unit_of(&series[0], column));
    for (char *c = label; *c; c++)
        if (*c == '_') *c = ' ';
    const scree_chart chart = {
        .title = title, .x_label = "time (ms)", .y_label = label, .line = line, .line_count = count};
    return scree_chart_draw(path, &chart, error);
}

scree_status scree_bisection_figure(const char *output, const char *title, const char *column,
                                    const scree_bisection_curve *curve, size_t count, scree_error *error)
{
    scree_series series[SCREE_BISECTION_CURVES] = {{0}};
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, output, SCREE_FOLDER_FIGURES, error);
    if (!status) status = scree_folders_make(path, error);
    if (!status) status = scree_path_join(path, sizeof path, output, SCREE_FOLDER_FIGURES "/runs", error);
    if (!status) status = read_all(curve, count, series, error);
    if (!status) status = draw(path, title, column, curve, series, count, error);
    for (size_t k = 0; k < count; k++) scree_series_destroy(&series[k]);
    return status;
}
