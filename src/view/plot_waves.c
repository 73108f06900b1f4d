/// Waves: displacements at the receivers over time, from receivers.csv, and the dispersion relation of the layers with
/// the curve of the lattice, from dispersion.csv.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { RECEIVERS, DISPERSION, COMPONENTS = 3, BRANCHES = 6, MOST_LINES = 10, BLACK = 7 };

typedef struct wave_row {
    scree_figure figure;
    const char *file;
} wave_row;

static const wave_row rows[] = {
    [RECEIVERS] = {{"wave-receivers", "displacements at the receivers over time", SCREE_USUAL}, SCREE_FILE_RECEIVERS},
    [DISPERSION] = {{"dispersion", "frequency of the waves of the layers over their wavenumber", SCREE_USUAL},
                    SCREE_FILE_DISPERSION},
};

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    char path[PATH_MAX];
    const wave_row *row = (const wave_row *)figure;
    return !scree_path_join(path, sizeof path, run->directory, row->file, NULL) && access(path, F_OK) == 0;
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)run, (void)job, (void)error;
    return SCREE_OK;
}

static scree_status read_table(const scree_plot_run *run, const char *name, scree_series *table, scree_error *error)
{
    char path[PATH_MAX];
    *table = (scree_series){0};
    scree_status status = scree_path_join(path, sizeof path, run->directory, name, error);
    if (!status) status = scree_series_read(table, path, error);
    if (!status && table->row_count == 0) status = scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows", name);
    return status;
}

// ---- receivers ---------------------------------------------------------------------------------------------------

static double largest(const double *value, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) most = fmax(most, fabs(value[k]));
    return most;
}

/// The component of all receivers that moves most: 'x', 'y' or 'z'.
static char find_component(const scree_series *table)
{
    double most = -1;
    char component = 'x';
    for (size_t k = 1; k < table->column_count; k++) {
        const double here = largest(table->value[k], table->row_count);
        if (here > most) component = table->name[k][strlen(table->name[k]) - 1];
        most = fmax(most, here);
    }
    return component;
}

static scree_status draw_receivers(const char *path, const scree_series *table, double *room, scree_error *error)
{
    const size_t count = table->row_count;
    const char component = find_component(table);
    char label[MOST_LINES][40], title[64];
    scree_chart_line line[MOST_LINES];
    size_t lines = 0;
    for (size_t k = 0; k < count; k++) room[k] = 1e6 * table->value[0][k];
    for (size_t c = 1; c < table->column_count && lines < MOST_LINES; c++) {
        const size_t length = strlen(table->name[c]);
        if (table->name[c][length - 1] != component) continue;
        double *y = room + (lines + 1) * count;
        for (size_t k = 0; k < count; k++) y[k] = 1e6 * table->value[c][k];
        (void)snprintf(label[lines], sizeof label[lines], "%.*s", (int)length - 2, table->name[c]);
        // Two by two they are a pair.
        line[lines] = (scree_chart_line){.x = room,
                                         .y = y,
                                         .count = count,
                                         .label = label[lines],
                                         .colour = 1 + (int)(lines / 2),
                                         .dashed = lines % 2 == 1};
        lines++;
    }
    (void)snprintf(title, sizeof title, "Displacement along %c at the receivers", component);
    const scree_chart chart = {
        .title = title, .x_label = "time (µs)", .y_label = "displacement (µm)", .line = line, .line_count = lines};
    return scree_chart_draw(path, &chart, error);
}

// ---- dispersion --------------------------------------------------------------------------------------------------

typedef struct dispersion_columns {
    const double *component, *wavenumber, *frequency, *share;
} dispersion_columns;

/// A line of the values of a column in the rows of one component; clear: with a clear frequency only.
static void add_line(const dispersion_columns *c, const double *value, size_t count, int component, bool clear,
                     double *room, scree_chart_line *line, size_t *lines)
{
    bool any = false;
    for (size_t k = 0; k < count; k++) {
        const bool here = (int)c->component[k] == component && (!clear || c->share[k] > 0.5);
        room[k] = here ? value[k] : NAN;
        any = any || isfinite(room[k]);
    }
    if (any) line[(*lines)++] = (scree_chart_line){.x = c->wavenumber, .y = room, .count = count};
}

/// All waves of the lattice, and points of the components over them.
static scree_status draw_dispersion(const char *path, const scree_series *table, double *room, scree_error *error)
{
    static const char *const names[COMPONENTS] = {"along x", "along y", "along z"};
    const dispersion_columns c = {scree_series_get(table, "component"), scree_series_get(table, "wavenumber"),
                                  scree_series_get(table, "frequency"), scree_series_get(table, "share")};
    scree_chart_line line[COMPONENTS + BRANCHES];
    size_t lines = 0, count = table->row_count;
    if (!c.component || !c.wavenumber || !c.frequency || !c.share)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%s lacks a column", SCREE_FILE_DISPERSION);
    for (int b = 0; b < BRANCHES; b++, room += count) {
        char name[24];
        (void)snprintf(name, sizeof name, "wave_%d", b + 1);
        const double *wave = scree_series_get(table, name);
        if (wave) add_line(&c, wave, count, (int)c.component[0], false, room, line, &lines);
    }
    for (size_t k = 0; k < lines; k++) line[k].colour = BLACK;
    if (lines > 0) line[0].label = "waves of the lattice";
    for (int i = 0; i < COMPONENTS; i++, room += count) {
        const size_t before = lines;
        add_line(&c, c.frequency, count, i, true, room, line, &lines);
        if (lines == before) continue;
        line[before].label = names[i];
        line[before].colour = 1 + i;
        line[before].points = line[before].bare = true;
    }
    const scree_chart chart = {.title = "Dispersion relation of the layers",
                               .x_label = "wavenumber (rad/m)",
                               .y_label = "circular frequency (rad/s)",
                               .line = line,
                               .line_count = lines};
    return scree_chart_draw(path, &chart, error);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const wave_row *row = (const wave_row *)job->figure;
    scree_series table;
    double *room = NULL;
    scree_status status = read_table(run, row->file, &table, error);
    if (!status) status = scree_allocate(&room, (MOST_LINES + 1) * table.row_count, sizeof *room, error);
    if (!status)
        status = row == &rows[RECEIVERS] ? draw_receivers(job->path, &table, room, error)
                                         : draw_dispersion(job->path, &table, room, error);
    scree_release(&room);
    scree_series_destroy(&table);
    return status;
}

const scree_figure_family scree_figures_waves = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
