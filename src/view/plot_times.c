/// Charts over time of runs without a loading stage, over all of their rows: a hopper, a drum, a heap, a relaxation.
/// A row names columns, or the end of their names, so that every wall of a case gets a curve.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CURVES = 12, BESIDE = 2, LABEL = 64 };

/// A straight line beside the curves.
typedef struct slope {
    double x[2], y[2];
    char label[LABEL];
} slope;

typedef struct column_label {
    const char *column; ///< name, or with a "*" in front the end of the names
    const char *label;  ///< with a "*": what stands behind the beginning of the name
} column_label;

typedef struct time_row {
    scree_figure figure;
    const char *title, *y_label; ///< "@" stands for the SI prefix that suits the values
    /// What stands beside the curves, at most BESIDE lines; returns how many. NULL: nothing.
    size_t (*beside)(const scree_plot_run *run, slope *line);
    column_label curve[CURVES]; ///< ended by a column that is NULL
} time_row;

/// The column between its rows. time: s
static double value_at(const scree_series *series, const double *column, double time)
{
    const double *at = scree_series_get(series, "time");
    for (size_t k = 1; k < series->row_count; k++)
        if (at[k] >= time && at[k] > at[k - 1])
            return column[k - 1] + (column[k] - column[k - 1]) * (time - at[k - 1]) / (at[k] - at[k - 1]);
    return column[series->row_count - 1];
}

/// Mean rate of the outflow, and Beverloo's, from where the steady part begins: masses as numbers of particles of the
/// mean mass.
static size_t rates_of_outflow(const scree_plot_run *run, slope *line)
{
    const double *number = scree_series_get(&run->series, "outflow"), *mass;
    const double rate[BESIDE] = {scree_plot_result(run, "outflow_rate"), scree_plot_result(run, "beverloo_rate")};
    const double begin = scree_plot_result(run, "outflow_begin"), end = scree_plot_result(run, "outflow_end");
    size_t count = 0;
    if (!number || !(mass = scree_series_get(&run->series, "outflow_mass")) || !(begin < end)) return 0;
    const size_t last = run->series.row_count - 1;
    const double from = value_at(&run->series, number, begin), of_mass = number[last] / mass[last];
    for (; count < BESIDE && rate[count] > 0; count++) {
        const double to =
            fmin(end, begin + (number[last] - from) / (rate[count] * of_mass)); // none comes out after all
        line[count] = (slope){{begin, to}, {from, from + rate[count] * of_mass * (to - begin)}, ""};
        (void)snprintf(line[count].label, LABEL, "%s: %.4g 1/s, %.3g kg/s", count ? "Beverloo" : "steady",
                       rate[count] * of_mass, rate[count]);
    }
    return count;
}

// clang-format off
static const time_row rows[] = {
    {{"energy-time", "kinetic and elastic energy and losses over time, without a loading stage", SCREE_USUAL},
     "Energy", "energy (@J)", NULL, {
        {"kinetic", "kinetic"}, {"elastic_normal", "elastic, normal"}, {"elastic_tangential", "elastic, tangential"},
        {"work_gravity", "work of gravity"}, {"dissipated_friction", "lost to friction"},
        {"dissipated_damping", "lost to damping"}}},
    {{"wall-forces", "forces on the walls of the case over time, without a loading stage", SCREE_USUAL},
     "Forces on walls", "force (@N)", NULL, {
        {"*_force_x", ", x"}, {"*_force_y", ", y"}, {"*_force_z", ", z"}}},
    {{"coordination-time", "contacts per particle over time, without a loading stage", SCREE_ON_REQUEST},
     "Coordination", "contacts per particle (1)", NULL, {
        {"coordination", "all particles"}, {"coordination_without_rattlers", "without rattlers"}}},
    {{"outflow", "particles that have come out over time, with the steady rate and Beverloo's", SCREE_USUAL},
     "Outflow", "particles (1)", rates_of_outflow, {{"outflow", "all outlets"}}},
    {{"surface-angle", "angle of the free surface over time", SCREE_USUAL},
     "Angle of the free surface", "angle (degrees)", NULL, {{"surface_angle", "by a fit"}}},
};
// clang-format on

/// The column that follows `after` (SIZE_MAX: the first) of those that are meant; SIZE_MAX: there is none.
static size_t next_column(const scree_series *series, const char *meant, size_t after)
{
    const bool ending = *meant == '*';
    const size_t length = strlen(meant) - ending;
    for (size_t k = after == SIZE_MAX ? 0 : after + 1; k < series->column_count; k++) {
        const char *name = series->name[k];
        const size_t size = strlen(name);
        if (!ending && strcmp(name, meant) == 0) return k;
        if (ending && size > length && strcmp(name + size - length, meant + 1) == 0 && !strstr(name, "_exerted_"))
            return k;
    }
    return SIZE_MAX;
}

/// Whether a column has something to show.
static bool says_something(const scree_series *series, size_t column)
{
    for (size_t k = 0; k < series->row_count; k++)
        if (isfinite(series->value[column][k]) && series->value[column][k] != 0) return true;
    return false;
}

/// The columns of a figure that say something; how many.
static size_t find_columns(const scree_series *series, const time_row *row, size_t *column, char (*label)[LABEL])
{
    size_t count = 0;
    for (const column_label *c = row->curve; c->column; c++)
        for (size_t k = SIZE_MAX; (k = next_column(series, c->column, k)) != SIZE_MAX && count < CURVES;) {
            if (!says_something(series, k)) continue;
            const int length = *c->column == '*' ? (int)(strlen(series->name[k]) - strlen(c->column) + 1) : 0;
            (void)snprintf(label[count], LABEL, "%.*s%s", length < 40 ? length : 40, series->name[k], c->label);
            column[count++] = k;
        }
    return count;
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    const time_row *row = (const time_row *)figure;
    size_t column[CURVES];
    char label[CURVES][LABEL];
    return !run->series_status && run->row_count == 0 && run->series.row_count > 1 &&
           find_columns(&run->series, row, column, label) > 0;
}

static scree_status has_time(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (scree_series_get(&run->series, "time")) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no column 'time'", SCREE_FILE_SERIES);
}

/// Puts what stands beside the curves behind them; `slope` has its values. Returns how many lines there are.
static size_t add_beside(const scree_plot_run *run, const time_row *row, slope *beside, scree_chart_line *line,
                         size_t lines)
{
    const size_t count = row->beside ? row->beside(run, beside) : 0;
    for (size_t k = 0; k < count; k++)
        line[lines + k] = (scree_chart_line){
            .x = beside[k].x, .y = beside[k].y, .count = 2, .label = beside[k].label, .dashed = k > 0};
    return lines + count;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const time_row *row = (const time_row *)job->figure;
    const scree_series *series = &run->series;
    const size_t count = series->row_count;
    size_t column[CURVES];
    char label[CURVES][LABEL], axis[128];
    scree_chart_line line[CURVES + BESIDE];
    slope beside[BESIDE];
    double *value, largest = 0;
    const size_t lines = find_columns(series, row, column, label);
    scree_status status = scree_allocate(&value, lines * count, sizeof *value, error);
    if (status) return status;
    for (size_t k = 0; k < lines; k++) largest = fmax(largest, scree_plot_largest(series->value[column[k]], count));
    const double scale = scree_plot_label(axis, sizeof axis, row->y_label, largest);
    const size_t all = add_beside(run, row, beside, line, lines);
    for (size_t k = 0; k < lines; k++) {
        for (size_t i = 0; i < count; i++) value[k * count + i] = scale * series->value[column[k]][i];
        line[k] = (scree_chart_line){.x = scree_series_get(series, "time"),
                                     .y = value + k * count,
                                     .count = count,
                                     .label = all > 1 ? label[k] : NULL};
    }
    const scree_chart chart = {
        .title = row->title, .x_label = "time (s)", .y_label = axis, .line = line, .line_count = all};
    status = scree_chart_draw(job->path, &chart, error);
    scree_release(&value);
    return status;
}

const scree_figure_family scree_figures_times = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = has_time,
    .draw = draw,
};
