/// What the grains of snapshots say together: distributions of forces and friction, the rose of contacts, profiles of
/// velocity and solid fraction over the height. Forces are those of the last snapshot; profiles are means over the
/// later half of the snapshots of its stage, at most SNAPSHOTS of them, with the interval of 95 % of that mean
/// (average/table.h).
#include "view/plot_parts.h"

#include "average/force_statistics.h"
#include "average/layers.h"
#include "io/sample_file.h"
#include "view/chart.h"
#include "view/force_figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SNAPSHOTS = 20, COMPONENTS = 3 };

typedef scree_status make_table(const scree_average_sample *sample, scree_average_table *table, scree_error *error);
typedef scree_status draw_table(const char *path, const scree_average_table *table, scree_error *error);

typedef struct sample_row {
    scree_figure figure;
    make_table *make; ///< NULL: a profile
    draw_table *draw;
    const char *title, *x_label; ///< of a profile
    const char *of_cell;         ///< NULL, or x_label of a sample that repeats itself in all directions
    const char *column[COMPONENTS], *name[COMPONENTS];
} sample_row;

static const sample_row rows[] = {
    {.figure = {"force-distribution", "distribution of contact forces at the end", SCREE_ON_REQUEST},
     .make = scree_average_forces_table,
     .draw = scree_draw_force_distribution},
    {.figure = {"friction-distribution", "distribution of mobilised friction at the end", SCREE_ON_REQUEST},
     .make = scree_average_friction_table,
     .draw = scree_draw_friction_distribution},
    {.figure = {"contact-rose", "directions of contacts and of their forces at the end", SCREE_ON_REQUEST},
     .make = scree_average_rose_table,
     .draw = scree_draw_contact_rose},
    {.figure = {"velocity-profile", "mean velocity over the height, later half of the last stage", SCREE_ON_REQUEST},
     .title = "Velocity by height",
     .x_label = "velocity (@m/s)",
     .of_cell = "velocity relative to the affine field (@m/s)",
     .column = {"velocity_x", "velocity_y", "velocity_z"},
     .name = {"x", "y", "z"}},
    {.figure = {"solid-fraction-profile", "solid fraction over the height, later half of the last stage",
                SCREE_ON_REQUEST},
     .title = "Solid fraction by height",
     .x_label = "solid fraction (1)",
     .column = {"solid_fraction"},
     .name = {"solid fraction"}},
};

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (run->snapshot_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "the run has no snapshot");
}

static scree_status read_sample(const scree_plot_run *run, int64_t index, scree_average_sample *sample,
                                scree_error *error)
{
    scree_status status = scree_sample_read(run->directory, index, sample, error);
    if (!status && (status = scree_average_sample_finish(sample, error))) scree_average_sample_destroy(sample);
    return status;
}

static scree_status draw_forces(const scree_plot_run *run, const sample_row *row, int64_t index, const char *path,
                                scree_error *error)
{
    scree_average_sample sample;
    scree_average_table table = {0};
    scree_status status = read_sample(run, index, &sample, error);
    if (status) return status;
    status = row->make(&sample, &table, error);
    if (!status) status = row->draw(path, &table, error);
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&sample);
    return status;
}

// ---- profiles ----------------------------------------------------------------------------------------------------

/// A mean over snapshots, with its interval.
typedef struct profile {
    scree_average_table mean, low, high;
    size_t snapshots;
    double from, to; ///< s, of the first and the last
    bool of_cell;    ///< the sample repeats itself in all directions
} profile;

static void profile_destroy(profile *p)
{
    scree_average_table_destroy(&p->mean);
    scree_average_table_destroy(&p->low);
    scree_average_table_destroy(&p->high);
}

/// Of the last of `count` snapshots: the first one of the later half of its stage.
static size_t later_half(const scree_snapshot_mark *mark, size_t count)
{
    size_t first = count - 1;
    while (first > 0 && strcmp(mark[first - 1].stage_name, mark[count - 1].stage_name) == 0) first--;
    first += (count - first) / 2;
    return count - first > SNAPSHOTS ? count - SNAPSHOTS : first;
}

/// The layers are those of the last snapshot, which is read first.
static scree_status find_profile(const scree_plot_run *run, const scree_snapshot_mark *mark, size_t count, profile *p,
                                 scree_error *error)
{
    const size_t first = later_half(mark, count);
    scree_average_table table[SNAPSHOTS] = {{0}};
    scree_average_layers layers = {0};
    scree_status status = SCREE_OK;
    p->snapshots = count - first, p->from = mark[first].time, p->to = mark[count - 1].time;
    for (size_t k = count; k-- > first && !status;) {
        scree_average_sample sample;
        status = read_sample(run, mark[k].index, &sample, error);
        if (status) break;
        if (k == count - 1) layers = scree_average_layers_of(&sample);
        p->of_cell = sample.directions == (1u << sample.dimension) - 1;
        status = scree_average_layers_table(&sample, &layers, &table[k - first], error);
        scree_average_sample_destroy(&sample);
    }
    if (!status) status = scree_average_table_mean(table, p->snapshots, &p->mean, &p->low, &p->high, error);
    for (size_t k = 0; k < SNAPSHOTS; k++) scree_average_table_destroy(&table[k]);
    return status;
}

/// Values of a column times a factor; the height in mm.
static void take(const scree_average_table *table, size_t column, double factor, double *value)
{
    for (size_t k = 0; k < table->rows; k++) value[k] = factor * scree_average_table_get(table, k, column);
}

static double largest_of(const sample_row *row, const scree_average_table *table)
{
    double largest = 0;
    for (int i = 0; i < COMPONENTS && row->column[i]; i++) {
        const size_t column = scree_average_table_find(table, row->column[i]);
        for (size_t k = 0; k < table->rows && column != SIZE_MAX; k++) {
            const double value = fabs(scree_average_table_get(table, k, column));
            if (value > largest) largest = value;
        }
    }
    return largest;
}

static void write_title(const sample_row *row, const profile *p, char *title, size_t size)
{
    if (p->snapshots > 1)
        (void)snprintf(title, size, "%s, mean of %zu snapshots, %.4g to %.4g s", row->title, p->snapshots, p->from,
                       p->to);
    else
        (void)snprintf(title, size, "%s at %.4g s", row->title, p->to);
}

static scree_status draw_profile(const sample_row *row, const profile *p, const char *path, scree_error *error)
{
    const scree_average_table *table[3] = {&p->mean, &p->low, &p->high};
    const bool bands = p->snapshots > 1;
    const size_t n = p->mean.rows;
    char label[96], title[160];
    scree_chart_line line[3 * COMPONENTS];
    size_t lines = 0;
    double *value;
    scree_status status = scree_allocate(&value, (3 * COMPONENTS + 1) * n, sizeof *value, error);
    if (status) return status;
    const double factor = scree_plot_label(
        label, sizeof label, p->of_cell && row->of_cell ? row->of_cell : row->x_label, largest_of(row, &p->mean));
    take(&p->mean, 0, 1e3, value);
    for (int i = 0; i < COMPONENTS && row->column[i]; i++) {
        const size_t column = scree_average_table_find(&p->mean, row->column[i]);
        for (int k = 0; k < (bands ? 3 : 1) && column != SIZE_MAX; k++) {
            double *x = value + (lines + 1) * n;
            take(table[k], column, factor, x);
            line[lines++] = (scree_chart_line){.x = x,
                                               .y = value,
                                               .count = n,
                                               .label = k == 0   ? row->name[i]
                                                        : k == 1 ? "95 % of the mean"
                                                                 : NULL,
                                               .dashed = k > 0,
                                               .colour = i + 1};
        }
    }
    write_title(row, p, title, sizeof title);
    const scree_chart chart = {
        .title = title, .x_label = label, .y_label = "height (mm)", .line = line, .line_count = lines};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&value);
    return status;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const sample_row *row = (const sample_row *)job->figure;
    scree_snapshot_mark *mark;
    profile p = {0};
    size_t count;
    scree_status status = scree_snapshot_marks(run->directory, &mark, &count, error);
    if (status) return status;
    if (row->make) {
        status = draw_forces(run, row, mark[count - 1].index, job->path, error);
    } else {
        status = find_profile(run, mark, count, &p, error);
        if (!status) status = draw_profile(row, &p, job->path, error);
        profile_destroy(&p);
    }
    scree_release(&mark);
    return status;
}

const scree_figure_family scree_figures_samples = {
    SCREE_FIGURE_ROWS(rows),
    .meant = scree_plot_has_snapshot,
    .applies = applies,
    .draw = draw,
};
