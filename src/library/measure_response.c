/// Profiles of the response of layers to a load on one grain: those of response.csv of each run
/// (run/response_curves.h), at the same places of all of them, and figures of their means.
///
/// Lengths are over the thickness H of the layer, pressures times H and the width across the plane over the load, so
/// that layers of one kind are one ensemble. Rows: eight depths, and places x from the load to PLACES GAP, means of
/// both sides (a layer and its mirror image are one sample); between the places of a run values are linear, beyond its
/// ends there are none.
#include "library/measure.h"

#include "io/file_names.h"
#include "io/run_directory.h"
#include "io/series.h"
#include "run/response_curves.h"
#include "view/chart.h"

#include <scree/scree.h>

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PLACES = 41, LEVELS = SCREE_RESPONSE_LEVELS, SHOWN = 4, MOST_LINES = 4 };
#define GAP 0.05 /* thicknesses */

// ---- the table of a run ------------------------------------------------------------------------------------------

static const char *const columns[] = {
    "vertical",          "horizontal",        "half_space", "smooth", "bonded", "half_space_horizontal",
    "smooth_horizontal", "bonded_horizontal", "strain"};
enum { COLUMNS = sizeof columns / sizeof *columns };

/// A response as it is read.
typedef struct reading {
    scree_series csv;
    size_t points;                     ///< of a depth
    double thickness, element, factor; ///< m, m, 1/Pa
    const double *depth, *x, *value[COLUMNS];
} reading;

static double result_of(const char *directory, const char *name)
{
    char text[64];
    scree_error ignored;
    if (scree_result_get(directory, name, text, sizeof text, &ignored)) return NAN;
    return strtod(text, NULL);
}

static scree_status read_response(const char *path, const char *directory, double thickness, reading *r,
                                  scree_error *error)
{
    bool whole = true;
    *r = (reading){.thickness = result_of(directory, "response_thickness"),
                   .element = result_of(directory, "response_element")};
    r->factor = r->thickness * thickness / result_of(directory, "response_force");
    scree_status status = scree_series_read(&r->csv, path, error);
    if (status) return status;
    r->points = r->csv.row_count / LEVELS;
    r->depth = scree_series_get(&r->csv, "depth");
    r->x = scree_series_get(&r->csv, "x");
    for (size_t k = 0; k < COLUMNS; k++) {
        r->value[k] = scree_series_get(&r->csv, columns[k]);
        whole = whole && r->value[k];
    }
    if (whole && r->depth && r->x && r->points >= 2 && r->csv.row_count % LEVELS == 0 && isfinite(r->factor))
        return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "'%s' is no table of a response at %d depths", path, LEVELS);
}

/// A column of a depth at x [m].
static double value_at(const reading *r, size_t level, const double *value, double x)
{
    const size_t first = level * r->points;
    const double at = x / (r->x[first + 1] - r->x[first]);
    const size_t k = (size_t)at;
    if (at > (double)(r->points - 1) * (1 + 1e-12)) return NAN;
    if (k + 1 >= r->points) return value[first + r->points - 1];
    return value[first + k] + (at - (double)k) * (value[first + k + 1] - value[first + k]);
}

static scree_status tell_place(const reading *r, size_t level, size_t place, scree_average_table *table,
                               scree_error *error)
{
    const double x = GAP * (double)place;
    scree_status status = scree_average_table_begin_row(table, error);
    if (status) return status;
    scree_average_table_take(table, "depth", "1", r->depth[level * r->points] / r->thickness);
    scree_average_table_take(table, "x", "1", x);
    scree_average_table_take(table, "element", "1", r->element / r->thickness);
    for (size_t k = 0; k < COLUMNS; k++) {
        const bool strain = strcmp(columns[k], "strain") == 0;
        const double value = value_at(r, level, r->value[k], x * r->thickness);
        scree_average_table_take(table, columns[k], "1", (strain ? 1 : r->factor) * value);
    }
    return scree_average_table_end_row(table, error);
}

scree_status measure_response(const char *directory, double thickness, scree_average_table *table, scree_error *error)
{
    char path[PATH_MAX];
    reading r;
    if (!isfinite(result_of(directory, "response_force"))) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_RESPONSE, error);
    if (status || access(path, R_OK) != 0) return status;
    status = read_response(path, directory, thickness, &r, error);
    for (size_t level = 0; level < LEVELS && !status; level++)
        for (size_t place = 0; place < PLACES && !status; place++) status = tell_place(&r, level, place, table, error);
    scree_series_destroy(&r.csv);
    return status;
}

// ---- figures -----------------------------------------------------------------------------------------------------

/// A line: a column at a depth, on both sides of the load.
typedef struct wanted {
    const char *column, *label; ///< NULL: the depth
    size_t level;
    bool dashed;
} wanted;

typedef struct response_figure {
    const char *file, *title, *label;
    double factor;
    size_t count;
    wanted line[MOST_LINES];
} response_figure;

#define BY_DEPTH(name)                                                                                                 \
    {                                                                                                                  \
        {name, NULL, 1, false}, {name, NULL, 3, false}, {name, NULL, 5, false},                                        \
        {                                                                                                              \
            name, NULL, 7, false                                                                                       \
        }                                                                                                              \
    }
static const response_figure figures[] = {
    {"response-vertical", "Vertical response by depth", "vertical response times thickness / load", 1, SHOWN,
     BY_DEPTH("vertical")},
    {"response-horizontal", "Horizontal response by depth", "horizontal response times thickness / load", 1, SHOWN,
     BY_DEPTH("horizontal")},
    {"response-strain", "Vertical strain by depth", "vertical strain, compression positive (10^{-3})", 1e3, SHOWN,
     BY_DEPTH("strain")},
    {"response-base",
     "Vertical response at the base, beside elastic bodies",
     "vertical response times thickness / load",
     1,
     4,
     {{"vertical", "grains", LEVELS - 1, false},
      {"half_space", "half-space", LEVELS - 1, true},
      {"smooth", "layer, smooth base", LEVELS - 1, true},
      {"bonded", "layer, bonded base", LEVELS - 1, true}}},
    {"response-base-horizontal",
     "Horizontal response at the base, beside elastic bodies",
     "horizontal response times thickness / load",
     1,
     4,
     {{"horizontal", "grains", LEVELS - 1, false},
      {"half_space_horizontal", "half-space", LEVELS - 1, true},
      {"smooth_horizontal", "layer, smooth base", LEVELS - 1, true},
      {"bonded_horizontal", "layer, bonded base", LEVELS - 1, true}}},
};

enum { WIDE = 2 * PLACES - 1 };

/// From the left to the right of the load.
static void unfold(const scree_average_table *table, size_t level, size_t column, double factor, bool odd,
                   double value[WIDE])
{
    for (size_t k = 0; k < PLACES; k++) {
        const double here = factor * scree_average_table_get(table, level * PLACES + k, column);
        value[PLACES - 1 + k] = here;
        value[PLACES - 1 - k] = odd ? -here : here;
    }
}

static scree_status draw_figure(const char *folder, const measure_found *found, const response_figure *figure,
                                scree_error *error)
{
    const scree_average_table *mean = &found->mean.of[MEASURE_RESPONSE];
    const bool bands = found->responses > 1 && found->low.of[MEASURE_RESPONSE].rows > 0;
    double x[WIDE], part[MOST_LINES][3][WIDE];
    char path[PATH_MAX], label[MOST_LINES][32];
    scree_chart_line line[MOST_LINES] = {{0}};
    scree_status status = scree_path_join(path, sizeof path, folder, figure->file, error);
    unfold(mean, 0, scree_average_table_find(mean, "x"), 1, true, x);
    for (size_t k = 0; k < figure->count; k++) {
        const wanted *w = &figure->line[k];
        const size_t column = scree_average_table_find(mean, w->column);
        const scree_average_table *of[3] = {mean, &found->low.of[MEASURE_RESPONSE], &found->high.of[MEASURE_RESPONSE]};
        for (int i = 0; i < (bands ? 3 : 1); i++) unfold(of[i], w->level, column, figure->factor, false, part[k][i]);
        (void)snprintf(label[k], sizeof label[k], "depth %.2g", scree_average_table_get(mean, w->level * PLACES, 0));
        line[k] = (scree_chart_line){.x = x,
                                     .y = part[k][0],
                                     .low = bands && !w->dashed ? part[k][1] : NULL,
                                     .high = bands && !w->dashed ? part[k][2] : NULL,
                                     .count = WIDE,
                                     .label = w->label ? w->label : label[k],
                                     .dashed = w->dashed};
    }
    const scree_chart chart = {.title = figure->title,
                               .x_label = "x from the load / thickness",
                               .y_label = figure->label,
                               .line = line,
                               .line_count = figure->count};
    if (!status) status = scree_chart_draw(path, &chart, error);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status; // nothing to draw
}

scree_status measure_draw_response(const char *folder, const measure_found *found, scree_error *error)
{
    scree_status status = SCREE_OK;
    if (found->mean.of[MEASURE_RESPONSE].rows == 0) return SCREE_OK;
    for (size_t k = 0; k < sizeof figures / sizeof *figures && !status; k++)
        status = draw_figure(folder, found, &figures[k], error);
    return status;
}
