/// Bonds that broke: how many over the strain of the loading, or of the first gauge, or over time where nothing
/// measures a strain, and which particles they left.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CHART, SCENE };

typedef struct break_row {
    scree_figure figure;
    int kind;
} break_row;

static const break_row rows[] = {
    {{"broken-bonds", "bonds that have broken in tension and in shear", SCREE_USUAL}, CHART},
    {{"cracks", "particles at the end, coloured by the number of their bonds that have broken", SCREE_USUAL}, SCENE},
};

static bool any_broken(const scree_plot_run *run)
{
    const double *tension = scree_series_get(&run->series, "broken_tension"),
                 *shear = scree_series_get(&run->series, "broken_shear");
    const size_t last = run->series.row_count - 1;
    return run->series.row_count > 0 && tension && shear && tension[last] + shear[last] > 0;
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    return any_broken(run) && (((const break_row *)figure)->kind == CHART || run->dimension == 2);
}

static bool any_finite(const double *value, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) return true;
    return false;
}

/// What the bonds broke over: rows of the series, and how their values are called.
typedef struct abscissa {
    const double *value;
    double factor;
    char label[96];
    size_t first, count;
} abscissa;

/// Strain of the first gauge (NAME_strain beside NAME_shortening) in the last stage; false: there is none.
static bool find_gauge(const scree_series *series, abscissa *x)
{
    const double *stage = scree_series_get(series, "stage");
    for (size_t c = 0; c < series->column_count && stage; c++) {
        char other[128], name[64];
        const size_t length = strlen(series->name[c]), ending = strlen("_strain");
        if (length <= ending || length >= sizeof name || strcmp(series->name[c] + length - ending, "_strain") != 0)
            continue;
        (void)snprintf(name, sizeof name, "%.*s", (int)(length - ending), series->name[c]);
        (void)snprintf(other, sizeof other, "%s_shortening", name);
        if (!scree_series_get(series, other)) continue;
        *x = (abscissa){.value = series->value[c], .factor = 100, .first = series->row_count - 1};
        while (x->first > 0 && stage[x->first - 1] == stage[x->first]) x->first--;
        x->count = series->row_count - x->first;
        (void)snprintf(x->label, sizeof x->label, "%s strain (%%)", name);
        return any_finite(x->value + x->first, x->count);
    }
    return false;
}

/// Axial strain of the loading, else that of a gauge, else time.
static abscissa find_abscissa(const scree_plot_run *run)
{
    const double *strain = scree_series_get(&run->series, "axial_strain");
    abscissa x = {
        .value = strain, .factor = 100, .label = "axial strain (%)", .first = run->first_row, .count = run->row_count};
    if (strain && any_finite(strain + x.first, x.count)) return x;
    if (run->series.row_count > 0 && find_gauge(&run->series, &x)) return x;
    return (abscissa){.value = scree_series_get(&run->series, "time"),
                      .factor = 1e3,
                      .label = "time (ms)",
                      .count = run->series.row_count};
}

static scree_status draw_chart(const scree_plot_run *run, const char *path, scree_error *error)
{
    const abscissa over = find_abscissa(run);
    const double *tension = scree_series_get(&run->series, "broken_tension"),
                 *shear = scree_series_get(&run->series, "broken_shear");
    double *x = NULL;
    if (!shear || !over.value)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no broken bonds", SCREE_FILE_SERIES);
    scree_status status = scree_allocate(&x, over.count, sizeof *x, error);
    if (status) return status;
    for (size_t k = 0; k < over.count; k++) x[k] = over.factor * over.value[over.first + k];
    const scree_chart_line line[] = {
        {.x = x, .y = tension + over.first, .count = over.count, .label = "in tension", .colour = 1},
        {.x = x, .y = shear + over.first, .count = over.count, .label = "in shear", .colour = 2}};
    const scree_chart chart = {.title = "Broken bonds",
                               .x_label = over.label,
                               .y_label = "bonds that have broken (1)",
                               .line = line,
                               .line_count = 2};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&x);
    return status;
}

/// Number of broken bonds of each particle of a snapshot, which is in the order of ids.
static scree_status count_breaks(const scree_plot_run *run, const scree_snapshot *now, double *field,
                                 scree_error *error)
{
    char path[PATH_MAX], line[512];
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_BREAKS, error);
    if (status) return status;
    FILE *file = fopen(path, "r");
    if (!file) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no %s", SCREE_FILE_BREAKS);
    while (fgets(line, sizeof line, file)) {
        unsigned id[2];
        if (sscanf(line, "%*[^,],%*[^,],%u,%u", &id[0], &id[1]) != 2) continue; // the names of the columns
        for (int i = 0; i < 2; i++)
            for (size_t low = 0, high = now->count; low < high;) {
                const size_t middle = (low + high) / 2;
                if (now->id[middle] == id[i]) field[middle]++;
                if (now->id[middle] == id[i]) break;
                if (now->id[middle] < id[i])
                    low = middle + 1;
                else
                    high = middle;
            }
    }
    (void)fclose(file);
    return SCREE_OK;
}

static scree_status draw_scene(const scree_plot_run *run, const char *path, scree_error *error)
{
    scree_snapshot now;
    double *field = NULL;
    size_t which;
    scree_status status = scree_plot_find_snapshot(run, SCREE_AT_END, &which, error);
    if (!status) status = scree_snapshot_read(run->directory, which, &now, error);
    if (status) return status;
    status = scree_allocate(&field, now.count, sizeof *field, error);
    if (!status) status = count_breaks(run, &now, field, error);
    const scree_scene scene = {.title = "Cracks at the end",
                               .field = field,
                               .field_name = "bonds of the particle that have broken (1)",
                               .map = SCREE_COLOUR_SEQUENTIAL,
                               .of_cell = run->of_cell,
                               .plates = true};
    if (!status) status = scree_scene_draw(path, &now, &scene, error);
    scree_release(&field);
    scree_snapshot_destroy(&now);
    return status;
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t which;
    if (((const break_row *)job->figure)->kind == SCENE)
        return scree_plot_find_snapshot(run, SCREE_AT_END, &which, error);
    if (run->series.row_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows", SCREE_FILE_SERIES);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return ((const break_row *)job->figure)->kind == CHART ? draw_chart(run, job->path, error)
                                                           : draw_scene(run, job->path, error);
}

const scree_figure_family scree_figures_breaks = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
