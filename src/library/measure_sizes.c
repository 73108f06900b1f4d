/// Figures of averages against the size of their elements: the components of each tensor, and the scatter over runs.
#include "library/measure.h"

#include "io/run_directory.h"
#include "view/chart.h"

#include <limits.h>
#include <stdio.h>

enum { LINES = 3 };

/// A tensor over elements of growing size.
typedef struct size_figure {
    const char *file, *title, *label;
    const char *column[LINES], *upright[LINES], *name[LINES]; ///< upright: in 3D
    double factor;
} size_figure;

static const size_figure figures[] = {
    {"sizes-stress",
     "Stress by the size of the element",
     "pressure, shear stress (kPa)",
     {"stress_yy", "stress_xx", "stress_xy"},
     {"stress_zz", "stress_xx", "stress_xz"},
     {"vertical", "horizontal", "shear"},
     -1e-3},
    {"sizes-strain",
     "Strain by the size of the element",
     "compression, shear (10^{-6})",
     {"cundall_yy", "cundall_xx", "cundall_xy"},
     {"cundall_zz", "cundall_xx", "cundall_xz"},
     {"vertical", "horizontal", "shear"},
     -1e6},
    {"sizes-fabric",
     "Fabric tensor by the size of the element",
     "component of the fabric tensor",
     {"fabric_yy", "fabric_xx", "fabric_xy"},
     {"fabric_zz", "fabric_xx", "fabric_xz"},
     {"vertical", "horizontal", "mixed"},
     1},
};

/// Values of a column times a factor; NULL when memory ran out.
static double *take(const scree_average_table *table, size_t column, double factor, scree_error *error)
{
    double *value = NULL;
    if (scree_allocate(&value, table->rows, sizeof *value, error)) return NULL;
    for (size_t k = 0; k < table->rows; k++) value[k] = factor * scree_average_table_get(table, k, column);
    return value;
}

static scree_status draw_lines(const char *folder, const char *file, const char *title, const char *label, bool log_y,
                               const scree_average_table *table, const scree_average_table *low,
                               const scree_average_table *high, const size_t column[LINES], const size_t ends[LINES][2],
                               const char *const name[LINES], double factor, scree_error *error)
{
    scree_chart_line line[LINES];
    double *part[LINES][4] = {{NULL}};
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, folder, file, error);
    for (int k = 0; k < LINES && !status; k++) {
        part[k][0] = take(table, 0, 1, error);
        part[k][1] = take(table, column[k], factor, error);
        part[k][2] = low ? take(factor > 0 ? low : high, ends[k][factor > 0 ? 0 : 1], factor, error) : NULL;
        part[k][3] = low ? take(factor > 0 ? high : low, ends[k][factor > 0 ? 1 : 0], factor, error) : NULL;
        if (!part[k][0] || !part[k][1] || (low && (!part[k][2] || !part[k][3]))) status = SCREE_ERROR_IO;
        line[k] = (scree_chart_line){.x = part[k][0],
                                     .y = part[k][1],
                                     .low = part[k][2],
                                     .high = part[k][3],
                                     .count = table->rows,
                                     .label = name[k],
                                     .points = true};
    }
    const scree_chart chart = {.title = title,
                               .x_label = "grains in the element",
                               .y_label = label,
                               .line = line,
                               .line_count = LINES,
                               .log_x = true,
                               .log_y = log_y};
    if (!status) status = scree_chart_draw(path, &chart, error);
    for (int k = 0; k < LINES; k++)
        for (int i = 0; i < 4; i++) scree_release(&part[k][i]);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status; // nothing to draw
}

static scree_status draw_scatter(const char *folder, const scree_average_table *scatter, scree_error *error)
{
    size_t column[LINES], ends[LINES][2];
    for (size_t k = 0; k < LINES; k++) {
        column[k] = 1 + 3 * k;
        ends[k][0] = 2 + 3 * k;
        ends[k][1] = 3 + 3 * k;
    }
    return draw_lines(folder, "sizes-scatter", "Scatter from run to run by the size of the element",
                      "standard deviation over the mean", true, scatter, scatter, scatter, column,
                      (const size_t(*)[2])ends, scree_average_sized_names, 1, error);
}

scree_status measure_draw_sizes(const char *folder, const measure_found *found, scree_error *error)
{
    const scree_average_table *sizes = &found->mean.of[MEASURE_SIZES], *scatter = &found->mean.of[MEASURE_SCATTER];
    const bool bands = found->runs > 1 && found->low.of[MEASURE_SIZES].rows > 0;
    const bool in_3d = sizes->rows > 0 && scree_average_table_find(sizes, "stress_zz") != SIZE_MAX;
    scree_status status = SCREE_OK;
    for (size_t f = 0; f < sizeof figures / sizeof *figures && !status && sizes->rows > 0; f++) {
        size_t column[LINES], ends[LINES][2];
        bool there = true;
        for (int k = 0; k < LINES; k++) {
            column[k] = scree_average_table_find(sizes, in_3d ? figures[f].upright[k] : figures[f].column[k]);
            ends[k][0] = ends[k][1] = column[k];
            there = there && column[k] != SIZE_MAX;
        }
        if (there)
            status = draw_lines(folder, figures[f].file, figures[f].title, figures[f].label, false, sizes,
                                bands ? &found->low.of[MEASURE_SIZES] : NULL, &found->high.of[MEASURE_SIZES], column,
                                (const size_t(*)[2])ends, figures[f].name, figures[f].factor, error);
    }
    if (!status && found->runs > 2 && scatter->rows > 0) status = draw_scatter(folder, scatter, error);
    return status;
}
