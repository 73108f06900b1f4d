/// The path of a test in stress, over all of its loading stages: q over p, and q over the axial strain that runs on
/// through them. Of a sample that was sheared the shear stress stands in place of q, and the shear strain in place of
/// the axial one.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>

/// What stands along an axis.
typedef struct axis {
    const char *column, *label;
    double factor;
} axis;

typedef struct path_row {
    scree_figure figure;
    const char *title[2]; ///< and of a sample that was sheared
    axis x[2];
} path_row;

static const axis heights[2] = {{"q", "deviator stress q, axial less lateral (kPa)", 1e-3},
                                {"stress_shear", "shear stress (kPa)", 1e-3}};

static const path_row rows[] = {
    {{"path-p-q", "deviator stress q over mean stress p, of all loading stages", SCREE_USUAL},
     {"Stress path", "Stress path"},
     {{"p", "mean stress p (kPa)", 1e-3}, {"p", "mean stress p (kPa)", 1e-3}}},
    {{"path-strain", "deviator stress q over the axial strain, of all loading stages", SCREE_OF_PATHS},
     {"Deviator stress over all loading stages", "Shear stress over all loading stages"},
     {{"strain_axial", "logarithmic axial strain since the first loading (%), compression positive", 100},
      {"strain_shear", "shear strain since the first loading (%)", 100}}},
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
    const bool sheared = run->path.sheared;
    if (column_of(run, row->x[sheared].column) && column_of(run, heights[sheared].column)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no columns p, q and strain_yy", SCREE_FILE_SERIES);
}

/// Rows of the loading stages, NAN elsewhere. Returns the first of them.
static size_t gather(const scree_plot_run *run, const axis *of, double *value)
{
    const double *column = column_of(run, of->column), *strain = column_of(run, "strain_axial");
    size_t first = run->series.row_count;
    for (size_t k = run->series.row_count; k-- > 0;) {
        value[k] = isfinite(strain[k]) ? of->factor * column[k] : NAN;
        if (isfinite(value[k])) first = k;
    }
    return first;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const path_row *row = (const path_row *)job->figure;
    const bool sheared = run->path.sheared;
    const size_t count = run->series.row_count;
    double *value = NULL;
    scree_status status = scree_allocate(&value, 2 * count, sizeof *value, error);
    if (status) return status;
    (void)gather(run, &row->x[sheared], value);
    const size_t first = gather(run, &heights[sheared], value + count);
    const scree_chart_line line[] = {
        {.x = value, .y = value + count, .count = count, .colour = 1},
        {.x = value + first, .y = value + count + first, .count = 1, .label = "begin", .points = true, .bare = true}};
    const scree_chart chart = {.title = row->title[sheared],
                               .x_label = row->x[sheared].label,
                               .y_label = heights[sheared].label,
                               .line = line,
                               .line_count = first < count ? 2 : 1};
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
