/// A pile that was poured: its outline with the lines of the angles of repose, and its growth over time.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { OUTLINE, GROWTH };

typedef struct pile_row {
    scree_figure figure;
    int kind;
} pile_row;

static const pile_row rows[] = {
    {{"pile-outline", "outline of the heap, with a tenth of it beside, and its angles of repose", SCREE_USUAL},
     OUTLINE},
    {{"pile-growth", "height and width of the pile over time", SCREE_USUAL}, GROWTH},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    (void)figure;
    return scree_series_get(&run->series, "pile_grains") != NULL;
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (run->series.row_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows", SCREE_FILE_SERIES);
}

/// Ends of the heap and a tenth of it at both sides. False: the table has none.
static bool find_heap(const scree_series *table, double ends[2])
{
    const double *place = scree_series_get(table, "x"), *heap = scree_series_get(table, "heap");
    ends[0] = INFINITY, ends[1] = -INFINITY;
    for (size_t k = 0; place && heap && k < table->row_count; k++) {
        if (heap[k] == 0) continue;
        ends[0] = fmin(ends[0], place[k]);
        ends[1] = fmax(ends[1], place[k]);
    }
    const double beside = 0.1 * (ends[1] - ends[0]);
    ends[0] -= beside, ends[1] += beside;
    return ends[0] < ends[1];
}

static scree_status read_outline(const scree_plot_run *run, scree_series *table, scree_error *error)
{
    char file[PATH_MAX];
    scree_status status = scree_path_join(file, sizeof file, run->directory, SCREE_FILE_OUTLINE, error);
    return status ? status : scree_series_read(table, file, error);
}

bool scree_plot_heap(const scree_plot_run *run, double ends[2])
{
    scree_series table = {0};
    scree_error ignored;
    if (!scree_series_get(&run->series, "pile_grains")) return false;
    const bool found = !read_outline(run, &table, &ignored) && find_heap(&table, ends);
    scree_series_destroy(&table);
    return found;
}

/// From foot to apex to foot: the angles by the corners. mm
typedef struct corners {
    double x[3], y[3];
} corners;

static corners find_corners(const scree_plot_run *run)
{
    const double height = 1e3 * scree_plot_result(run, "pile_height"), apex = 1e3 * scree_plot_result(run, "pile_apex");
    const double left = scree_plot_result(run, "angle_of_repose_left") * M_PI / 180;
    const double right = scree_plot_result(run, "angle_of_repose_right") * M_PI / 180;
    return (corners){{apex - height / tan(left), apex, apex + height / tan(right)}, {0, height, 0}};
}

/// The line of a fit on one side (-1 left, 1 right), from the foot up, through the centre of what was fitted.
static void find_fit(const scree_plot_run *run, const scree_series *table, int side, double x[2], double y[2])
{
    const double *place = scree_series_get(table, "x"), *surface = scree_series_get(table, "height");
    const double *heap = scree_series_get(table, "heap");
    const double angle =
        scree_plot_result(run, side < 0 ? "angle_of_surface_left" : "angle_of_surface_right") * M_PI / 180;
    const double height = scree_plot_result(run, "pile_height"), apex = scree_plot_result(run, "pile_apex"),
                 slope = -side * tan(angle);
    double count = 0, middle = 0, level = 0;
    for (size_t k = 0; k < table->row_count; k++) {
        if (heap[k] == 0 || side * (place[k] - apex) < 0) continue;
        if (!(surface[k] > 0.1 * height && surface[k] < 0.9 * height)) continue;
        count++, middle += place[k], level += surface[k];
    }
    middle /= count, level /= count;
    for (int k = 0; k < 2; k++) {
        y[k] = 1e3 * (k ? height : 0);
        x[k] = 1e3 * (middle + ((k ? height : 0) - level) / slope);
    }
}

static scree_status draw_outline(const scree_plot_run *run, const char *path, scree_error *error)
{
    char title[120];
    scree_series table = {0};
    double *x = NULL, *y = NULL, fit_x[2][2], fit_y[2][2], ends[2];
    size_t count = 0;
    scree_status status = read_outline(run, &table, error);
    if (!status && table.row_count == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows", SCREE_FILE_OUTLINE);
    if (!status) status = scree_allocate(&x, table.row_count, sizeof *x, error);
    if (!status) status = scree_allocate(&y, table.row_count, sizeof *y, error);
    (void)find_heap(&table, ends); // without one all lies beyond
    for (size_t k = 0; k < table.row_count && !status; k++) {
        const double place = scree_series_get(&table, "x")[k];
        if (place < ends[0] || place > ends[1]) continue;
        x[count] = 1e3 * place;
        y[count++] = 1e3 * scree_series_get(&table, "height")[k];
    }
    corners c = find_corners(run);
    for (int side = 0; side < 2 && !status; side++) find_fit(run, &table, side ? 1 : -1, fit_x[side], fit_y[side]);
    (void)snprintf(title, sizeof title,
                   "Outline of the heap: %.1f and %.1f degrees by its corners, %.1f and %.1f by fits",
                   scree_plot_result(run, "angle_of_repose_left"), scree_plot_result(run, "angle_of_repose_right"),
                   scree_plot_result(run, "angle_of_surface_left"), scree_plot_result(run, "angle_of_surface_right"));
    const scree_chart_line line[] = {
        {.x = x, .y = y, .count = count, .label = "surface", .points = true, .bare = true, .colour = 1},
        {.x = c.x, .y = c.y, .count = 3, .label = "corners", .colour = 2},
        {.x = fit_x[0], .y = fit_y[0], .count = 2, .label = "fit, left", .dashed = true, .colour = 3},
        {.x = fit_x[1], .y = fit_y[1], .count = 2, .label = "fit, right", .dashed = true, .colour = 4}};
    const scree_chart chart = {
        .title = title, .x_label = "x (mm)", .y_label = "height above the plate (mm)", .line = line, .line_count = 4};
    if (!status) status = scree_chart_draw(path, &chart, error);
    scree_series_destroy(&table);
    scree_release(&x);
    scree_release(&y);
    return status;
}

static scree_status draw_growth(const scree_plot_run *run, const char *path, scree_error *error)
{
    const double *time = scree_series_get(&run->series, "time"), *of[2];
    const size_t count = run->series.row_count;
    double *y[2] = {NULL};
    of[0] = scree_series_get(&run->series, "pile_height");
    of[1] = scree_series_get(&run->series, "pile_width");
    if (!time || !of[0] || !of[1])
        return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no column of a pile", SCREE_FILE_SERIES);
    scree_status status = SCREE_OK;
    for (int i = 0; i < 2 && !status; i++) {
        status = scree_allocate(&y[i], count, sizeof **y, error);
        for (size_t k = 0; k < count && !status; k++) y[i][k] = 1e3 * of[i][k];
    }
    const scree_chart_line line[] = {{.x = time, .y = y[0], .count = count, .label = "height", .colour = 1},
                                     {.x = time, .y = y[1], .count = count, .label = "width of the foot", .colour = 2}};
    const scree_chart chart = {
        .title = "Growth of the pile", .x_label = "time (s)", .y_label = "length (mm)", .line = line, .line_count = 2};
    if (!status) status = scree_chart_draw(path, &chart, error);
    for (int i = 0; i < 2; i++) scree_release(&y[i]);
    return status;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return ((const pile_row *)job->figure)->kind == OUTLINE ? draw_outline(run, job->path, error)
                                                            : draw_growth(run, job->path, error);
}

const scree_figure_family scree_figures_pile = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
