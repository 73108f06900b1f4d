/// Figures of elements as points: constants against the fabric, invariants of stress against those of strain.
#include "library/measure.h"

#include "io/run_directory.h"
#include "view/chart.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

enum { MOST_LINES = 7 };

#define LEAST_INSIDE 0.5 /* elements of which less lies in the sample are left out */

typedef struct cloud {
    const char *file, *title;
    const char *x, *x_label, *y, *y_label;
    double x_factor, y_factor;
} cloud;

#define AGAINST_FABRIC "trace of the fabric tensor"
static const cloud clouds[] = {
    {"fabric-bulk-modulus", "Bulk modulus and fabric", "fabric_trace", AGAINST_FABRIC, "bulk_modulus", "K (MPa)", 1,
     1e-6},
    {"fabric-shear-modulus", "Shear modulus and fabric", "fabric_trace", AGAINST_FABRIC, "shear_modulus", "G (MPa)", 1,
     1e-6},
    {"fabric-young-modulus", "Young's modulus and fabric", "fabric_trace", AGAINST_FABRIC, "young_modulus", "E (MPa)",
     1, 1e-6},
    {"fabric-poisson-ratio", "Poisson's ratio and fabric", "fabric_trace", AGAINST_FABRIC, "poisson_ratio", "nu", 1, 1},
    {"fabric-density", "Fabric and volume fraction", "volume_fraction", "volume fraction", "fabric_trace",
     AGAINST_FABRIC, 1, 1},
    {"invariants", "Change of the traces of strain and stress", "strain_trace", "trace of the strain (1e-6)",
     "stress_change_trace", "trace of the change of stress (Pa)", 1e6, 1},
};

/// The elements of a cut that lie in the sample.
static scree_status take(const measure_plan *plan, const scree_average_table *cuts, const cloud *c, size_t cut,
                         double **x, double **y, size_t *count, scree_error *error)
{
    const size_t inside = scree_average_table_find(cuts, "inside"), n = plan->average.points;
    const size_t column[2] = {scree_average_table_find(cuts, c->x), scree_average_table_find(cuts, c->y)};
    scree_status status = scree_allocate(x, n, sizeof **x, error);
    if (!status) status = scree_allocate(y, n, sizeof **y, error);
    *count = 0;
    for (size_t row = cut * n; row < (cut + 1) * n && !status; row++) {
        const double a = scree_average_table_get(cuts, row, column[0]),
                     b = scree_average_table_get(cuts, row, column[1]);
        if (!(scree_average_table_get(cuts, row, inside) >= LEAST_INSIDE) || !isfinite(a) || !isfinite(b)) continue;
        (*x)[*count] = c->x_factor * a;
        (*y)[(*count)++] = c->y_factor * b;
    }
    return status;
}

static scree_status draw(const char *folder, const measure_plan *plan, const measure_found *found, const cloud *c,
                         scree_error *error)
{
    const scree_average_table *cuts = &found->mean.of[MEASURE_CUTS];
    const size_t most = plan->average.cuts < MOST_LINES ? plan->average.cuts : MOST_LINES;
    scree_chart_line line[MOST_LINES] = {{0}};
    double *x[MOST_LINES] = {NULL}, *y[MOST_LINES] = {NULL};
    char label[MOST_LINES][32], path[PATH_MAX];
    size_t lines = 0;
    if (scree_average_table_find(cuts, c->x) == SIZE_MAX || scree_average_table_find(cuts, c->y) == SIZE_MAX)
        return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, folder, c->file, error);
    for (size_t k = 0; k < most && !status; k++) {
        size_t count;
        status = take(plan, cuts, c, k, &x[k], &y[k], &count, error);
        if (status || count == 0) continue;
        (void)snprintf(label[k], sizeof label[k], "height %.2g", plan->average.height[k]);
        line[lines++] =
            (scree_chart_line){.x = x[k], .y = y[k], .count = count, .label = label[k], .points = true, .bare = true};
    }
    const scree_chart chart = {
        .title = c->title, .x_label = c->x_label, .y_label = c->y_label, .line = line, .line_count = lines};
    if (!status && lines > 0) status = scree_chart_draw(path, &chart, error);
    for (size_t k = 0; k < MOST_LINES; k++) {
        scree_release(&x[k]);
        scree_release(&y[k]);
    }
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

scree_status measure_draw_clouds(const char *folder, const measure_plan *plan, const measure_found *found,
                                 scree_error *error)
{
    scree_status status = SCREE_OK;
    if (scree_average_table_find(&found->mean.of[MEASURE_CUTS], "bulk_modulus") == SIZE_MAX) return SCREE_OK;
    for (size_t k = 0; k < sizeof clouds / sizeof *clouds && !status; k++)
        status = draw(folder, plan, found, &clouds[k], error);
    return status;
}
