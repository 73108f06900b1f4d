/// Response of a layer to a load: along cuts by depth, by depth beside the half-space and the finite elastic layers,
/// and at the base beside them.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <scree/scree.h>

#include <stdio.h>
#include <string.h>

enum { MOST_LINES = 7, SHOWN = 4, LEVELS = 8 };

typedef enum response_kind { CUTS, HORIZONTAL, STRAIN, BASE, DEPTHS } response_kind;

typedef struct response_row {
    scree_figure figure;
    response_kind kind;
} response_row;

static const response_row rows[] = {
    {{"response-vertical", "vertical response to a load along cuts at four depths", SCREE_USUAL}, CUTS},
    {{"response-horizontal", "horizontal response along the same cuts", SCREE_USUAL}, HORIZONTAL},
    {{"response-strain", "vertical strain by the load along the same cuts", SCREE_USUAL}, STRAIN},
    {{"response-base", "vertical response at the base, beside a half-space and elastic layers", SCREE_USUAL}, BASE},
    {{"response-depths", "peak of the vertical response by depth, beside a half-space and elastic layers", SCREE_USUAL},
     DEPTHS},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    char text[64];
    scree_error ignored;
    (void)figure;
    return !scree_result_get(run->directory, "response_force", text, sizeof text, &ignored);
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    return is_meant(run, NULL)
               ? SCREE_OK
               : scree_error_set(error, SCREE_ERROR_INPUT, "the run has no response to a load (measure.response_load)");
}

static scree_status read_table(const scree_plot_run *run, const char *name, scree_series *table, scree_error *error)
{
    char file[PATH_MAX];
    scree_status status = scree_path_join(file, sizeof file, run->directory, name, error);
    if (!status) status = scree_series_read(table, file, error);
    if (!status && table->row_count < LEVELS)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "%s has too few rows", name);
    return status;
}

/// Values of a column times a factor; mirrored: of both sides of the load, from left to right, with `odd` one side less
/// than zero.
static scree_status take(const double *column, size_t count, double factor, bool odd, double **value,
                         scree_error *error)
{
    scree_status status = scree_allocate(value, 2 * count - 1, sizeof **value, error);
    for (size_t k = 0; k < count && !status; k++) {
        (*value)[count - 1 + k] = factor * column[k];
        (*value)[count - 1 - k] = (odd ? -1 : 1) * factor * column[k];
    }
    return status;
}

/// A line of a cut.
typedef struct wanted {
    const char *column, *label;
    size_t level;
    bool dashed;
    int colour;
} wanted;

static scree_status draw_lines(const scree_plot_run *run, const char *path, const wanted *want, size_t count,
                               double factor, const char *title, const char *label, scree_error *error)
{
    scree_series table = {0};
    double *x[MOST_LINES] = {NULL}, *y[MOST_LINES] = {NULL};
    char text[MOST_LINES][48];
    scree_chart_line line[MOST_LINES] = {{0}};
    scree_status status = read_table(run, SCREE_FILE_RESPONSE, &table, error);
    const size_t points = table.row_count / LEVELS;
    for (size_t k = 0; k < count && !status; k++) {
        const double *column = scree_series_get(&table, want[k].column), *place = scree_series_get(&table, "x");
        const size_t first = want[k].level * points;
        status = take(place + first, points, 1e3, true, &x[k], error);
        if (!status) status = take(column + first, points, factor, false, &y[k], error);
        (void)snprintf(text[k], sizeof text[k], "depth %.3g mm",
                       status ? 0 : 1e3 * scree_series_get(&table, "depth")[first]);
        line[k] = (scree_chart_line){.x = x[k],
                                     .y = y[k],
                                     .count = 2 * points - 1,
                                     .label = want[k].label ? want[k].label : text[k],
                                     .dashed = want[k].dashed,
                                     .colour = want[k].colour};
    }
    const scree_chart chart = {
        .title = title, .x_label = "x from the load (mm)", .y_label = label, .line = line, .line_count = count};
    if (!status) status = scree_chart_draw(path, &chart, error);
    for (size_t k = 0; k < count; k++) {
        scree_release(&x[k]);
        scree_release(&y[k]);
    }
    scree_series_destroy(&table);
    return status;
}

static scree_status draw_cuts(const scree_plot_run *run, const char *path, response_kind kind, scree_error *error)
{
    static const char *const column[] = {"vertical", "horizontal", "strain"};
    static const char *const title[] = {"Vertical response by depth, mean of both sides",
                                        "Horizontal response by depth, mean of both sides",
                                        "Vertical strain by depth, mean of both sides"};
    static const char *const label[] = {"vertical response (kPa)", "horizontal response (kPa)",
                                        "vertical strain, compression positive (10^{-3})"};
    wanted want[SHOWN];
    for (int k = 0; k < SHOWN; k++)
        want[k] = (wanted){.column = column[kind], .level = (size_t)(2 * k + 1), .colour = k + 1};
    return draw_lines(run, path, want, SHOWN, kind == STRAIN ? 1e3 : 1e-3, title[kind], label[kind], error);
}

static scree_status draw_base(const scree_plot_run *run, const char *path, scree_error *error)
{
    static const wanted want[] = {{"vertical", "grains", LEVELS - 1, false, 1},
                                  {"half_space", "half-space", LEVELS - 1, true, 2},
                                  {"smooth", "layer, smooth base", LEVELS - 1, true, 3},
                                  {"bonded", "layer, bonded base", LEVELS - 1, true, 4}};
    return draw_lines(run, path, want, 4, 1e-3, "Vertical response at the base, mean of both sides",
                      "vertical response (kPa)", error);
}

static scree_status draw_depths(const scree_plot_run *run, const char *path, scree_error *error)
{
    static const char *const column[] = {"peak", "half_space_peak", "smooth_peak", "bonded_peak"};
    static const char *const label[] = {"grains", "half-space", "layer, smooth base", "layer, bonded base"};
    scree_series table = {0};
    double x[LEVELS], y[4][LEVELS];
    scree_chart_line line[4];
    scree_status status = read_table(run, SCREE_FILE_RESPONSE_DEPTHS, &table, error);
    for (int c = 0; c < 4 && !status; c++) {
        const double *depth = scree_series_get(&table, "depth"), *value = scree_series_get(&table, column[c]);
        const double *unit = scree_series_get(&table, "half_space_peak");
        for (size_t k = 0; k < LEVELS; k++) x[k] = 1e3 * depth[k], y[c][k] = value[k] / unit[k];
        line[c] = (scree_chart_line){
            .x = x, .y = y[c], .count = LEVELS, .label = label[c], .points = c == 0, .dashed = c > 0, .colour = c + 1};
    }
    const scree_chart chart = {.title = "Largest vertical response by depth",
                               .x_label = "depth (mm)",
                               .y_label = "largest vertical response over that of the half-space",
                               .line = line,
                               .line_count = 4};
    if (!status) status = scree_chart_draw(path, &chart, error);
    scree_series_destroy(&table);
    return status;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const response_kind kind = ((const response_row *)job->figure)->kind;
    if (kind == BASE) return draw_base(run, job->path, error);
    return kind == DEPTHS ? draw_depths(run, job->path, error) : draw_cuts(run, job->path, kind, error);
}

const scree_figure_family scree_figures_response = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
