/// Bonds that broke: how many over the strain of the loading, or over time where nothing measures a strain, and which
/// particles they left.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>

enum { CHART, SCENE };

typedef struct break_row {
    scree_figure figure;
    int kind;
} break_row;

static const break_row rows[] = {
    {{"broken-bonds", "bonds that have broken in tension and in shear"}, CHART},
    {{"cracks", "particles at the end, coloured by the number of their bonds that have broken"}, SCENE},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    const bool has_bonds = scree_series_get(&run->series, "broken_tension") != NULL;
    return has_bonds && (((const break_row *)figure)->kind == CHART || run->dimension == 2);
}

static bool any_finite(const double *value, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) return true;
    return false;
}

static scree_status draw_chart(const scree_plot_run *run, const char *path, scree_error *error)
{
    const double *strain = scree_series_get(&run->series, "axial_strain"),
                 *time = scree_series_get(&run->series, "time");
    const double *tension = scree_series_get(&run->series, "broken_tension"),
                 *shear = scree_series_get(&run->series, "broken_shear");
    const bool strained = strain && any_finite(strain + run->first_row, run->row_count);
    const size_t first = strained ? run->first_row : 0, count = strained ? run->row_count : run->series.row_count;
    double *x = NULL;
    if (!shear || !time) return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no broken bonds", SCREE_FILE_SERIES);
    scree_status status = scree_allocate(&x, count, sizeof *x, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) x[k] = strained ? 100 * strain[first + k] : 1e3 * time[first + k];
    const scree_chart_line line[] = {{.x = x, .y = tension + first, .count = count, .label = "in tension", .colour = 1},
                                     {.x = x, .y = shear + first, .count = count, .label = "in shear", .colour = 2}};
    const scree_chart chart = {.title = "Broken bonds",
                               .x_label = strained ? "axial strain (%)" : "time (ms)",
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
