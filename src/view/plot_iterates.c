/// Changes of the strains from iterate to iterate, in the stages `iterate` of a run.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>

static const scree_figure rows[] = {
    {"iterates", "change of the strains of deformable particles in each iterate of the forces", SCREE_USUAL},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    (void)figure;
    return scree_series_get(&run->series, "iteration_change") != NULL;
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const double *change = scree_series_get(&run->series, "iteration_change");
    (void)job;
    for (size_t k = 0; k < run->series.row_count; k++)
        if (change[k] > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no iterate that changes anything", SCREE_FILE_SERIES);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const scree_chart_line line = {.x = scree_series_get(&run->series, "iteration"),
                                   .y = scree_series_get(&run->series, "iteration_change"),
                                   .count = run->series.row_count,
                                   .points = true};
    const scree_chart chart = {.title = "Iterates of the strains",
                               .x_label = "iterate (1)",
                               .y_label = "change of the strain, rms of the particles (1)",
                               .line = &line,
                               .line_count = 1,
                               .log_y = true};
    return scree_chart_draw(job->path, &chart, error);
}

const scree_figure_family scree_figures_iterates = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
