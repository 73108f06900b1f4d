/// Maps of the Delaunay cells of a run (P figs. 3.10, 3.11), the distortion of strain windows with their shear bands,
/// and the pressure over growing circles (P fig. 3.12), spheres in 3D. Tetrahedra are drawn where a plane cuts them.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/cell_file.h"
#include "io/run_directory.h"
#include "measure/localisation.h"
#include "view/cell_section.h"
#include "view/chart.h"
#include "view/projection.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

/// Draws the cells of a scene, of tetrahedra the section of view/projection.h.
static scree_status draw_cells(const char *path, const scree_snapshot *snapshot, scree_scene *scene, scree_error *error)
{
    if (scene->cells->dimension == 2) return scree_scene_draw(path, snapshot, scene, error);
    scree_snapshot plane = {0};
    scree_cell_section section = {0};
    scree_status status = scree_section_create(snapshot, &plane, error);
    if (!status)
        status = scree_cell_section_create(scene->cells, scene->cell_place, scene->cell_field,
                                           scree_section_place(snapshot), &section, error);
    if (!status) {
        scene->section = true;
        scene->cells = &section.cells;
        scene->cell_place = section.place;
        scene->cell_field = section.field;
        scene->band = NULL; // its edges are planes, which cut this one anywhere
        status = scree_scene_draw(path, &plane, scene, error);
    }
    scree_cell_section_destroy(&section);
    scree_snapshot_destroy(&plane);
    return status;
}

// ---- maps --------------------------------------------------------------------------------------------------------

typedef struct map_row {
    scree_figure figure;
    const char *title;
    scree_plot_when when;
    bool pressure;    ///< else the rate of distortion
    double threshold; ///< shaded above so many times the mean; 0: coloured
} map_row;

static const map_row map_rows[] = {
    {{"distortion-rate-peak", "cells that distort fast, at the peak of the stress ratio", SCREE_ON_REQUEST},
     "Rate of distortion at the peak of the stress ratio",
     SCREE_AT_PEAK,
     .threshold = 2},
    {{"distortion-rate-window", "cells that distort fast, in the middle of the first strain window", SCREE_ON_REQUEST},
     "Rate of distortion in the first strain window",
     SCREE_AT_WINDOW,
     .threshold = 2},
    {{"distortion-rate-end", "cells that distort fast, at the end", SCREE_ON_REQUEST},
     "Rate of distortion at the end",
     SCREE_AT_END,
     .threshold = 2},
    {{"distortion-rate-colour-end", "cells at the end, coloured by their rate of distortion", SCREE_ON_REQUEST},
     "Rate of distortion at the end",
     SCREE_AT_END,
     .pressure = false},
    {{"pressure-peak", "cells under high pressure, at the peak of the stress ratio", SCREE_ON_REQUEST},
     "Pressure at the peak of the stress ratio",
     SCREE_AT_PEAK,
     .pressure = true,
     .threshold = 1.75},
    {{"pressure-window", "cells under high pressure, in the middle of the first strain window", SCREE_ON_REQUEST},
     "Pressure in the first strain window",
     SCREE_AT_WINDOW,
     .pressure = true,
     .threshold = 1.75},
    {{"pressure-end", "cells under high pressure, at the end", SCREE_ON_REQUEST},
     "Pressure at the end",
     SCREE_AT_END,
     .pressure = true,
     .threshold = 1.75},
    {{"pressure-colour-end", "cells at the end, coloured by their pressure", SCREE_WITH_LOADING},
     "Pressure at the end",
     SCREE_AT_END,
     .pressure = true},
};

static scree_status has_cells(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t which;
    scree_status status = scree_plot_find_snapshot(run, ((const map_row *)job->figure)->when, &which, error);
    return status ? status : scree_cell_snapshot_find(run->directory, which, error);
}

/// Pressures in the unit that suits them.
static void scale_pressure(scree_cells *cells, char *label, size_t size)
{
    const double scale = scree_plot_label(label, size, "mean pressure p of the cells (@Pa)",
                                          scree_plot_largest(cells->pressure, cells->count));
    for (size_t k = 0; k < cells->count; k++) cells->pressure[k] *= scale;
}

static scree_status draw_map(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const map_row *row = (const map_row *)job->figure;
    size_t which;
    scree_snapshot snapshot;
    scree_cell_snapshot cells;
    scree_status status = scree_plot_find_snapshot(run, row->when, &which, error);
    if (!status) status = scree_snapshot_read(run->directory, which, &snapshot, error);
    if (status) return status;
    status = scree_cell_snapshot_read(run->directory, which, &cells, error);
    if (!status) {
        char label[64] = "rate of distortion L_II of the cells (1/s)";
        if (row->pressure) scale_pressure(&cells.cells, label, sizeof label);
        scree_scene scene = {.title = row->title,
                             .field_name = label,
                             .cells = &cells.cells,
                             .cell_place = cells.assembly.position,
                             .cell_field = row->pressure ? cells.cells.pressure : cells.cells.distortion,
                             .cell_threshold = row->threshold,
                             .of_cell = run->of_cell,
                             .plates = true};
        status = draw_cells(job->path, &snapshot, &scene, error);
        scree_cell_snapshot_destroy(&cells);
    }
    scree_snapshot_destroy(&snapshot);
    return status;
}

const scree_figure_family scree_figures_cell_maps = {
    SCREE_FIGURE_ROWS(map_rows),
    .meant = scree_plot_has_snapshot,
    .applies = has_cells,
    .draw = draw_map,
};

// ---- distortion of strain windows --------------------------------------------------------------------------------

/// Distortion of the cells of `first` on the way to `second`, in percent, and the band in it.
static scree_status find_distortion(const scree_cell_snapshot *first, const scree_cell_snapshot *second,
                                    double **distortion, scree_band *band, scree_error *error)
{
    scree_localisation found;
    uint8_t *inside = NULL;
    double *body = NULL, diameter = 0;
    size_t bodies = first->assembly.count;
    scree_status status = scree_cells_window_distortion(&first->cells, first->assembly.position,
                                                        second->assembly.position, distortion, error);
    if (!status) status = scree_allocate(&body, bodies, sizeof *body, error);
    if (!status) status = scree_allocate(&inside, bodies, 1, error);
    for (size_t i = 0; i < bodies; i++) diameter += 2 * first->assembly.radius[i] / (double)bodies;
    if (!status)
        status = scree_localisation_measure(&first->cells, first->assembly.position, *distortion, diameter, &found,
                                            body, inside, error);
    if (!status) *band = found.band;
    for (size_t k = 0; k < first->cells.count && !status; k++) (*distortion)[k] *= 100;
    scree_release(&body);
    scree_release(&inside);
    return status;
}

/// Discs and title are of `from`, the snapshot `first`.
static scree_status draw_between(const scree_plot_run *run, const scree_snapshot *from, size_t first, size_t second,
                                 const scree_figure_job *job, scree_error *error)
{
    char begin[16], end[16], title[160];
    scree_cell_snapshot a = {0}, b = {0};
    scree_band band;
    double *distortion = NULL;
    scree_status status = scree_cell_snapshot_read(run->directory, first, &a, error);
    if (!status) status = scree_cell_snapshot_read(run->directory, second, &b, error);
    if (!status && !scree_cell_snapshots_agree(&a, &b))
        status = scree_error_set(error, SCREE_ERROR_INPUT, "the snapshots are not of the same grains");
    if (!status) status = find_distortion(&a, &b, &distortion, &band, error);
    if (!status) {
        scree_plot_percent(begin, sizeof begin, a.axial_strain, false);
        scree_plot_percent(end, sizeof end, b.axial_strain, false);
        (void)snprintf(title, sizeof title, "Distortion, %s %s to %s %%", scree_strain_name(run->of_cell), begin, end);
        scree_scene scene = {.title = title,
                             .field_name = "distortion of the cells (%)",
                             .cells = &a.cells,
                             .cell_place = a.assembly.position,
                             .cell_field = distortion,
                             .band = &band,
                             .of_cell = run->of_cell,
                             .plates = true};
        status = draw_cells(job->path, from, &scene, error);
    }
    scree_release(&distortion);
    scree_cell_snapshot_destroy(&a);
    scree_cell_snapshot_destroy(&b);
    return status;
}

static scree_status has_window(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t first, second;
    scree_status status = scree_plot_find_window(run, job->window, &first, &second, error);
    if (!status) status = scree_cell_snapshot_find(run->directory, first, error);
    return status ? status : scree_cell_snapshot_find(run->directory, second, error);
}

/// What fluctuations of the same window show as shear between blocks is distortion here.
static scree_status draw_distortion(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_snapshot from;
    size_t first, second;
    scree_status status = scree_plot_find_window(run, job->window, &first, &second, error);
    if (!status) status = scree_snapshot_read(run->directory, first, &from, error);
    if (status) return status;
    status = draw_between(run, &from, first, second, job, error);
    scree_snapshot_destroy(&from);
    return status;
}

static const scree_figure distortion_rows[] = {
    {"distortion", "distortion of the cells in a strain window, with the shear band found in it", SCREE_USUAL},
};

const scree_figure_family scree_figures_distortion = {
    SCREE_FIGURE_ROWS(distortion_rows),
    .of_windows = true,
    .meant = scree_plot_has_snapshot,
    .applies = has_window,
    .draw = draw_distortion,
};

// ---- circles -----------------------------------------------------------------------------------------------------

enum { BOTTOM, CENTRE, TOP, MEAN, CIRCLE_LINES };

enum { CIRCLE_COLUMNS = 4 };
static const char *const circle_column[CIRCLE_COLUMNS] = {"snapshot", "position", "diameter_ratio", "pressure_ratio"};

/// Draws the rows of one snapshot; x and y have room for all of them.
static scree_status draw_circles(const char *path, const scree_series *circles, const scree_cell_snapshot *snapshot,
                                 double *x, double *y, scree_error *error)
{
    static const char *const labels[CIRCLE_LINES] = {"near the bottom", "centre", "near the top", "whole sample"};
    const double *column[CIRCLE_COLUMNS];
    char title[160], label[2][80];
    scree_chart_line line[CIRCLE_LINES];
    size_t used = 0;
    for (int k = 0; k < CIRCLE_COLUMNS; k++) column[k] = scree_series_get(circles, circle_column[k]);
    for (int p = BOTTOM; p <= TOP; p++) {
        line[p] = (scree_chart_line){.x = x + used, .y = y + used, .label = labels[p], .colour = p + 1};
        for (size_t k = 0; k < circles->row_count; k++) {
            bool mine = fabs(column[0][k] - (double)snapshot->index) < 0.5 && fabs(column[1][k] - p) < 0.5;
            if (!mine || !isfinite(column[3][k])) continue;
            x[used] = column[2][k];
            y[used++] = column[3][k];
            line[p].count++;
        }
        if (line[p].count < 2)
            return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no circles of this snapshot", SCREE_FILE_CELLS);
    }
    double ends[2] = {line[CENTRE].x[0], line[CENTRE].x[line[CENTRE].count - 1]}, one[2] = {1, 1};
    line[MEAN] =
        (scree_chart_line){.x = ends, .y = one, .count = 2, .label = labels[MEAN], .dashed = true, .colour = 7};
    const char *shape = snapshot->cells.dimension == 3 ? "sphere" : "circle";
    (void)snprintf(title, sizeof title, "Mean pressure over growing %ss, axial strain %.1f %%", shape,
                   100 * snapshot->axial_strain);
    (void)snprintf(label[0], sizeof label[0], "diameter of the %s / mean diameter (1)", shape);
    (void)snprintf(label[1], sizeof label[1], "pressure in the %s / pressure of the sample (1)", shape);
    scree_chart chart = {
        .title = title, .x_label = label[0], .y_label = label[1], .line = line, .line_count = CIRCLE_LINES};
    return scree_chart_draw(path, &chart, error);
}

/// cells.csv with the columns that the figure needs. It is there for the caller to destroy in any case.
static scree_status read_circles(const scree_plot_run *run, scree_series *circles, scree_error *error)
{
    char path[PATH_MAX];
    *circles = (scree_series){0};
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_CELLS, error);
    if (status) return status;
    if (access(path, F_OK) != 0) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no %s", SCREE_FILE_CELLS);
    status = scree_series_read(circles, path, error);
    for (int k = 0; !status && k < CIRCLE_COLUMNS; k++)
        if (!scree_series_get(circles, circle_column[k]))
            status = scree_error_set(error, SCREE_ERROR_INPUT, "%s has other columns", SCREE_FILE_CELLS);
    return status;
}

static scree_status has_circles(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_series circles = {0};
    size_t which;
    (void)job;
    scree_status status = scree_plot_find_snapshot(run, SCREE_AT_WINDOW, &which, error);
    if (!status) status = scree_cell_snapshot_find(run->directory, which, error);
    if (!status) status = read_circles(run, &circles, error);
    scree_series_destroy(&circles);
    return status;
}

static scree_status plot_circles(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t which;
    scree_series circles;
    scree_cell_snapshot snapshot;
    double *value = NULL;
    scree_status status = scree_plot_find_snapshot(run, SCREE_AT_WINDOW, &which, error);
    if (!status) status = scree_cell_snapshot_read(run->directory, which, &snapshot, error);
    if (status) return status;
    status = read_circles(run, &circles, error);
    if (!status) status = scree_allocate(&value, 2 * circles.row_count, sizeof *value, error);
    if (!status) status = draw_circles(job->path, &circles, &snapshot, value, value + circles.row_count, error);
    scree_release(&value);
    scree_series_destroy(&circles);
    scree_cell_snapshot_destroy(&snapshot);
    return status;
}

static const scree_figure circle_rows[] = {
    {"pressure-circles", "mean pressure over growing circles or spheres, in the middle of the first strain window",
     SCREE_ON_REQUEST},
};

const scree_figure_family scree_figures_circles = {
    SCREE_FIGURE_ROWS(circle_rows),
    .meant = scree_plot_has_snapshot,
    .applies = has_circles,
    .draw = plot_circles,
};
