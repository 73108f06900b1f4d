/// Sizes of the particles: the share of their area or volume that is finer, as asked for and as drawn.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "case/case.h"

#include "io/file_names.h"
#include "io/run_directory.h"
#include "model/model.h"
#include "shape/rounding.h"
#include "view/chart.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// Quantiles of each species, from which the curve that was asked for is drawn.
enum { QUANTILES = 4000 };

typedef struct sizes_row {
    scree_figure figure;
} sizes_row;

static const sizes_row rows[] = {
    {{"sizes", "share of the particles, by volume, that is finer: asked for and drawn", SCREE_ON_REQUEST}}};

/// Diameters, mm, with what lies in each; then the share that is finer than each, %.
typedef struct curve {
    double (*grain)[2];
    double *x, *y;
    size_t count;
} curve;

static int by_size(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

static scree_status curve_begin(curve *c, size_t most, scree_error *error)
{
    scree_status status = scree_allocate(&c->grain, most, sizeof *c->grain, error);
    if (!status) status = scree_allocate(&c->x, most, sizeof *c->x, error);
    if (!status) status = scree_allocate(&c->y, most, sizeof *c->y, error);
    return status;
}

static void curve_add(curve *c, int dimension, double radius, double weight)
{
    c->grain[c->count][0] = 2e3 * radius;
    c->grain[c->count++][1] = weight * pow(radius, dimension);
}

static void curve_finish(curve *c)
{
    double whole = 0, finer = 0;
    if (c->count > 0) qsort(c->grain, c->count, sizeof *c->grain, by_size);
    for (size_t i = 0; i < c->count; i++) whole += c->grain[i][1];
    for (size_t i = 0; i < c->count; i++) {
        finer += c->grain[i][1];
        c->x[i] = c->grain[i][0];
        c->y[i] = 100 * finer / whole;
    }
}

static void curve_release(curve *c)
{
    scree_release(&c->grain);
    scree_release(&c->x);
    scree_release(&c->y);
}

// ---- what was asked for, and what is there -----------------------------------------------------------------------

static scree_status read_case(const scree_plot_run *run, scree_case **c, scree_error *error)
{
    char path[PATH_MAX];
    scree_problems *problems = NULL;
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_CASE, error);
    if (!status && (status = scree_case_reread(path, scree_former_keys, c, &problems)))
        status = scree_error_set(error, status, "the case of the run cannot be read: %s",
                                 problems ? scree_problems_get(problems, 0)->message : "");
    scree_problems_free(problems);
    return status;
}

static scree_status ask(const scree_model *model, curve *c, scree_error *error)
{
    scree_status status = curve_begin(c, (size_t)model->species_count * QUANTILES, error);
    for (int s = 0; s < model->species_count && !status; s++) {
        const scree_species *species = &model->species[s];
        for (int k = 0; k < QUANTILES; k++)
            curve_add(c, model->dimension,
                      species->distribution->radius(species->sizes, model->dimension, (k + 0.5) / QUANTILES),
                      species->fraction);
    }
    if (!status) curve_finish(c);
    return status;
}

/// Of a polygon that of the disc of equal area.
static double radius_of(const scree_snapshot *now, size_t i)
{
    if (!now->corner_count || now->corner_count[i] == 0) return now->radius[i];
    const double(*corner)[2] = (const double(*)[2])(now->corner + now->first_corner[i]);
    const double rounding = now->rounding ? now->rounding[i] : 0;
    if (rounding > 0) return scree_rounding_measure((int)now->corner_count[i], corner, rounding).radius;
    double twice = 0;
    for (uint32_t k = 0; k < now->corner_count[i]; k++) {
        const double *a = corner[k], *b = corner[(k + 1) % now->corner_count[i]];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return sqrt(0.5 * twice / M_PI);
}

static scree_status look(const scree_plot_run *run, curve *c, scree_error *error)
{
    scree_snapshot now;
    scree_status status = scree_snapshot_read(run->directory, run->snapshot_count - 1, &now, error);
    if (status) return status;
    status = curve_begin(c, now.count, error);
    for (size_t i = 0; i < now.count && !status; i++)
        if (scree_snapshot_is_grain(&now, i)) curve_add(c, now.dimension, radius_of(&now, i), 1);
    if (!status) curve_finish(c);
    scree_snapshot_destroy(&now);
    return status;
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    return run->sizes_vary && scree_plot_has_snapshot(run, figure);
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (run->snapshot_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "the run has no snapshot");
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_case *c = NULL;
    scree_model model;
    curve asked = {0}, drawn = {0};
    char title[120], label[64];
    scree_status status = read_case(run, &c, error);
    if (!status) status = scree_model_build(&c->config, &model, error);
    if (!status) status = ask(&model, &asked, error);
    if (!status) status = look(run, &drawn, error);
    (void)snprintf(title, sizeof title, "Sizes of %zu particles", drawn.count);
    (void)snprintf(label, sizeof label, "share of the %s that is finer (%%)", run->dimension == 3 ? "volume" : "area");
    const scree_chart_line line[] = {
        {.x = asked.x, .y = asked.y, .count = asked.count, .label = "asked for", .dashed = true, .colour = 2},
        {.x = drawn.x, .y = drawn.y, .count = drawn.count, .label = "drawn", .colour = 1}};
    const scree_chart chart = {.title = title,
                               .x_label = "diameter (mm)",
                               .y_label = label,
                               .line = line,
                               .line_count = 2,
                               .highest_y = 100,
                               .log_x = asked.count > 0 && asked.x[asked.count - 1] > 20 * asked.x[0]};
    if (!status) status = scree_chart_draw(job->path, &chart, error);
    curve_release(&asked);
    curve_release(&drawn);
    scree_case_free(c);
    return status;
}

const scree_figure_family scree_figures_sizes = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = applies,
    .draw = draw,
};
