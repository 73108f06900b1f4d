/// The path of a test in stress, over all of its loading stages: q over p, and q over the axial strain that runs on
/// through them.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>

typedef struct path_row {
    scree_figure figure;
    const char *title, *x_column, *x_label, *y_column, *y_label;
    double x_factor;
} path_row;

static const path_row rows[] = {
    {{"path-p-q", "deviator stress q over mean stress p, of all loading stages", SCREE_USUAL},
     "Stress path",
     "p",
     "mean stress p (kPa)",
     "q",
     "deviator stress q, axial less lateral (kPa)",
     1e-3},
    {{"path-strain", "deviator stress q over the axial strain, of all loading stages", SCREE_OF_PATHS},
     "Deviator stress over all loading stages",
     "strain_axial",
     "axial strain since the first loading (%), compression positive",
     "q",
     "deviator stress q, axial less lateral (kPa)",
     100},
};

/// A column; of the axial strain that of the last axis.
static const double *column_of(const scree_plot_run *run, const char *name)
{
    const double *solid = scree_series_get(&run->series, "strain_zz"), *x = scree_series_get(&run->series, name);
    if (x || !solid) return x;
    const bool three = run->series.row_count > 0 && isfinite(solid[run->series.row_count - 1]);
    return three ? solid : scree_series_get(&run->series, "strain_yy");
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    (void)figure;
    return !run->series_status && scree_series_get(&run->series, "strain_yy") && run->row_count > 0;
}

static scree_status has_columns(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const path_row *row = (const path_row *)job->figure;
    if (column_of(run, row->x_column) && scree_series_get(&run->series, row->y_column)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no columns p, q and strain_yy", SCREE_FILE_SERIES);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const path_row *row = (const path_row *)job->figure;
    const double *x = column_of(run, row->x_column), *y = scree_series_get(&run->series, row->y_column);
    const double *strain = column_of(run, "strain_axial");
    const size_t count = run->series.row_count;
    double *value = NULL;
    scree_status status = scree_allocate(&value, 2 * count, sizeof *value, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) {
        const bool loaded = isfinite(strain[k]);
        value[k] = loaded ? row->x_factor * x[k] : NAN;
        value[count + k] = loaded ? 1e-3 * y[k] : NAN;
    }
    const scree_chart_line line = {.x = value, .y = value + count, .count = count, .colour = 1};
    const scree_chart chart = {
        .title = row->title, .x_label = row->x_label, .y_label = row->y_label, .line = &line, .line_count = 1};
    status = scree_chart_draw(job->path, &chart, error);
    scree_release(&value);
    return status;
}

const scree_figure_family scree_figures_paths = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = has_columns,
    .draw = draw,
};
