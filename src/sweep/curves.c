/// Curves of series.csv, averaged over the realisations of each point of the grid.
#include "sweep/results.h"

#include "base/memory.h"
#include "io/loading_stage.h"
#include "io/run_directory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static size_t column_of(const scree_series *series, const char *name)
{
    size_t k = 0;
    while (k < series->column_count && strcmp(series->name[k], name) != 0) k++;
    return k;
}

/// The curve of one finished member, with the units of its columns.
static scree_status read_curve(const scree_sweep_results *results, size_t member, scree_mean_curve *mean,
                               scree_curve *curve, scree_error *error)
{
    char path[PATH_MAX];
    scree_member_paths paths;
    scree_series series = {0};
    *curve = (scree_curve){0};
    scree_status status = scree_member_find(results->sweep, member, results->options->output, &paths, error);
    if (!status) status = scree_path_join(path, sizeof path, paths.folder, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_read(&series, path, error);
    if (status) return status;
    size_t x = column_of(&series, mean->name_x), y = column_of(&series, mean->name_y);
    if (x == series.column_count || y == series.column_count) {
        status = scree_error_set(error, SCREE_ERROR_INPUT, "'%s' has no column '%s'", path,
                                 x == series.column_count ? mean->name_x : mean->name_y);
    } else {
        (void)snprintf(mean->unit_x, sizeof mean->unit_x, "%s", series.unit[x]);
        (void)snprintf(mean->unit_y, sizeof mean->unit_y, "%s", series.unit[y]);
        // A curve over the strain is that of the loading stage.
        scree_loading_rows rows = {0, series.row_count};
        if (strcmp(mean->name_x, "axial_strain") == 0) rows = scree_loading_rows_find(&series);
        const double *stage = scree_series_get(&series, "stage");
        status = scree_curve_from_series(series.value[x] + rows.first, series.value[y] + rows.first,
                                         stage ? stage + rows.first : NULL, rows.last - rows.first, curve, error);
    }
    scree_series_destroy(&series);
    return status;
}

/// The mean at one point; a point without a finished member has none.
static scree_status average_point(const scree_sweep_results *results, size_t point, scree_mean_curve *mean,
                                  scree_curve *curve, scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    size_t count = 0;
    scree_status status = SCREE_OK;
    for (size_t r = 0; r < sweep->realisations && !status; r++) {
        size_t member = r * sweep->point_count + point;
        if (results->state[member] != SCREE_MEMBER_DONE) continue;
        status = read_curve(results, member, mean, &curve[count], error);
        if (!status && curve[count].count > 1)
            count++;
        else
            scree_curve_destroy(&curve[count]);
    }
    if (!status && count > 0) {
        scree_error none;
        mean->there[point] = !scree_curves_average(curve, count, sweep->config.confidence, SCREE_CURVE_PLACES,
                                                   mean->x + point * SCREE_CURVE_PLACES,
                                                   mean->estimate + point * SCREE_CURVE_PLACES, &none);
    }
    for (size_t i = 0; i < count; i++) scree_curve_destroy(&curve[i]);
    return status;
}

scree_status scree_mean_curve_make(const scree_sweep_results *results, size_t index, scree_mean_curve *curve,
                                   scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    scree_curve *member = NULL;
    bool any = false;
    const scree_sweep_curve *said = &sweep->config.curves[index];
    *curve = (scree_mean_curve){.name_x = said->x, .name_y = said->y, .log_y = said->log_y};
    size_t places = sweep->point_count * SCREE_CURVE_PLACES;
    scree_status status = scree_allocate(&curve->there, sweep->point_count, sizeof *curve->there, error);
    if (!status) status = scree_allocate(&curve->x, places, sizeof *curve->x, error);
    if (!status) status = scree_allocate(&curve->estimate, places, sizeof *curve->estimate, error);
    if (!status) status = scree_allocate(&member, sweep->realisations, sizeof *member, error);
    for (size_t point = 0; point < sweep->point_count && !status; point++) {
        status = average_point(results, point, curve, member, error);
        any |= curve->there[point];
    }
    scree_release(&member);
    if (!status && !any)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "no member has a curve of %s over %s", curve->name_y,
                                 curve->name_x);
    if (status) scree_mean_curve_destroy(curve);
    return status;
}

void scree_mean_curve_destroy(scree_mean_curve *curve)
{
    scree_release(&curve->there);
    scree_release(&curve->x);
    scree_release(&curve->estimate);
}

scree_status scree_mean_curve_write(const scree_sweep_results *results, const scree_mean_curve *curve,
                                    scree_error *error)
{
    char path[PATH_MAX], name[160];
    FILE *file;
    (void)snprintf(name, sizeof name, "curves/%s-over-%s.csv", curve->name_y, curve->name_x);
    scree_status status = scree_path_join(path, sizeof path, results->options->output, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    (void)fprintf(file, "point [1],%s [%s],%s [%s],deviation [%s],low [%s],high [%s],n [1]\n", curve->name_x,
                  curve->unit_x, curve->name_y, curve->unit_y, curve->unit_y, curve->unit_y, curve->unit_y);
    for (size_t point = 0; point < results->sweep->point_count; point++)
        for (size_t k = 0; k < SCREE_CURVE_PLACES && curve->there[point]; k++) {
            const scree_estimate *e = &curve->estimate[point * SCREE_CURVE_PLACES + k];
            const double shown[] = {curve->x[point * SCREE_CURVE_PLACES + k], e->mean, e->deviation, e->mean - e->half,
                                    e->mean + e->half};
            (void)fprintf(file, "%zu", point);
            for (size_t j = 0; j < sizeof shown / sizeof *shown; j++)
                (void)(isfinite(shown[j]) ? fprintf(file, ",%.15g", shown[j]) : fputs(",nan", file));
            (void)fprintf(file, ",%zu\n", e->count);
        }
    return scree_replace_finish(path, file, true, error);
}
