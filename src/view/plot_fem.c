/// Finite elements beside a run (run/finite_elements.c): strain of the bar and of the specimen over time; force over
/// the approach of two discs, and the strain along the line of their centres.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>
#include <unistd.h>

enum { MOST_LINES = 3 };

/// A curve: two columns, each times a factor.
typedef struct fem_line {
    const char *x, *y, *label;
    bool dashed, points;
} fem_line;

typedef struct fem_row {
    scree_figure figure;
    const char *file, *title, *x_label, *y_label;
    double x_factor, y_factor;
    bool log_x;
    fem_line line[MOST_LINES];
} fem_row;

static const fem_row rows[] = {
    {.figure = {"fem-strain", "axial strain of the specimen and of a solid bar of finite elements over time",
                SCREE_USUAL},
     .file = SCREE_FILE_FEM_STRAIN,
     .title = "Axial strain over time",
     .x_label = "time (ms)",
     .y_label = "axial strain (10^{-6})",
     .x_factor = 1e3,
     .y_factor = 1e6,
     .line = {{"time", "run_strain", "specimen", false, false}, {"time", "strain", "finite elements", true, false}}},
    {.figure = {"fem-force", "force over the approach of two discs: run, finite elements, Hertz", SCREE_USUAL},
     .file = SCREE_FILE_FEM_FORCE,
     .title = "Force over the approach of two discs",
     .x_label = "approach of the centres (µm)",
     .y_label = "force (kN)",
     .x_factor = 1e6,
     .y_factor = 1e-3,
     .line = {{"theory_approach", "force", "Hertz, line contact", false, false},
              {"approach", "force", "finite elements", false, true},
              {"approach", "run_force", "deformable discs", true, false}}},
    {.figure = {"fem-axis", "strain along the line of the centres of two discs: finite elements, Hertz, mean",
                SCREE_USUAL},
     .file = SCREE_FILE_FEM_AXIS,
     .title = "Strain along the line of the centres",
     .x_label = "distance from the contact (mm)",
     .y_label = "strain (10^{-6})",
     .x_factor = 1e3,
     .y_factor = 1e6,
     .log_x = true,
     .line = {{"depth", "theory_strain", "Hertz, line contact", false, false},
              {"depth", "strain", "finite elements", false, true},
              {"depth", "average_strain", "deformable disc", true, false}}},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    char path[PATH_MAX];
    const fem_row *row = (const fem_row *)figure;
    return !scree_path_join(path, sizeof path, run->directory, row->file, NULL) && access(path, F_OK) == 0;
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)run, (void)job, (void)error;
    return SCREE_OK;
}

static scree_status draw_lines(const char *path, const fem_row *row, const scree_series *table, double *room,
                               scree_error *error)
{
    scree_chart_line line[MOST_LINES];
    size_t lines = 0;
    for (; lines < MOST_LINES && row->line[lines].x; lines++) {
        const fem_line *l = &row->line[lines];
        const double *x = scree_series_get(table, l->x), *y = scree_series_get(table, l->y);
        double *out = room + 2 * lines * table->row_count;
        if (!x || !y) return scree_error_set(error, SCREE_ERROR_INPUT, "%s lacks a column", row->file);
        for (size_t k = 0; k < table->row_count; k++) {
            out[k] = row->x_factor * x[k];
            out[table->row_count + k] = row->y_factor * y[k];
        }
        line[lines] = (scree_chart_line){.x = out,
                                         .y = out + table->row_count,
                                         .count = table->row_count,
                                         .label = l->label,
                                         .dashed = l->dashed,
                                         .points = l->points,
                                         .bare = l->points};
    }
    const scree_chart chart = {.title = row->title,
                               .x_label = row->x_label,
                               .y_label = row->y_label,
                               .line = line,
                               .line_count = lines,
                               .log_x = row->log_x};
    return scree_chart_draw(path, &chart, error);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const fem_row *row = (const fem_row *)job->figure;
    char path[PATH_MAX];
    scree_series table = {0};
    double *room = NULL;
    scree_status status = scree_path_join(path, sizeof path, run->directory, row->file, error);
    if (!status) status = scree_series_read(&table, path, error);
    if (!status && table.row_count == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows", row->file);
    if (!status) status = scree_allocate(&room, 2 * MOST_LINES * table.row_count, sizeof *room, error);
    if (!status) status = draw_lines(job->path, row, &table, room, error);
    scree_release(&room);
    scree_series_destroy(&table);
    return status;
}

const scree_figure_family scree_figures_fem = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
