/// Smooth fields of a run.
#include "library/measure.h"

#include "average/elastic.h"
#include "average/kernel_strain.h"

#include <math.h>
#include <stdio.h>

enum { GRID_X = 100, GRID_Y = 50 }; ///< points unless there is a grid

static scree_average_points points_of(const scree_average_view *view, const scree_average_plan *plan)
{
    const scree_average_sample *sample = view->sample;
    const double *low = view->frame.low, *high = view->frame.high;
    scree_average_points points = {.number = {GRID_X, GRID_Y, 1}};
    if (sample->dimension == 3) points.number[0] = points.number[1] = points.number[2] = GRID_Y;
    if (plan->grid[0] > 0) scree_average_grid(plan, sample->dimension, points.number);
    for (int k = 0; k < 3; k++) {
        points.gap[k] = (high[k] - low[k]) / (double)points.number[k];
        points.first[k] = low[k] + 0.5 * points.gap[k];
        if (k < sample->dimension) continue;
        points.first[k] = 0;
        points.gap[k] = 1;
        points.number[k] = 1;
    }
    return points;
}

/// What has changed since the earlier state.
typedef struct changes {
    double *earlier, *displacement; ///< Pa, stress then; m
    double (*gradient)[9];
} changes;

static scree_status find_changes(const scree_average_sample *before, const scree_average_sample *sample, double width,
                                 const scree_average_points *points, int threads, changes *c, scree_error *error)
{
    const size_t count = points->number[0] * points->number[1] * points->number[2];
    scree_average_kernel kernel;
    *c = (changes){0};
    if (!sample->earlier) return SCREE_OK;
    scree_status status = scree_allocate(&c->displacement, count, (size_t)sample->dimension * sizeof(double), error);
    if (!status) status = scree_allocate(&c->gradient, count, sizeof *c->gradient, error);
    if (!status) status = scree_average_kernel_strain_find(sample, width, points, c->displacement, c->gradient, error);
    if (!status) status = scree_average_kernel_find(before, width, points, false, threads, &kernel, error);
    if (status) return status;
    c->earlier = kernel.stress;
    kernel.stress = NULL;
    scree_average_kernel_destroy(&kernel);
    return SCREE_OK;
}

static void tell_changes(const scree_average_kernel *kernel, const changes *c, size_t p, scree_average_table *table)
{
    const size_t d = (size_t)kernel->dimension;
    double stress[9] = {0};
    char name[32];
    for (size_t a = 0; a < d * d; a++) {
        const size_t at = d * d * p + a;
        (void)snprintf(name, sizeof name, "stress_change_%c%c", "xyz"[a / d], "xyz"[a % d]);
        stress[3 * (a / d) + a % d] = kernel->stress[at] - c->earlier[at];
        scree_average_table_take(table, name, "Pa", kernel->stress[at] - c->earlier[at]);
    }
    for (size_t a = 0; a < d; a++) {
        (void)snprintf(name, sizeof name, "displacement_%c", "xyz"[a]);
        scree_average_table_take(table, name, "m", c->displacement[d * p + a]);
    }
    for (size_t a = 0; a < d * d; a++) {
        (void)snprintf(name, sizeof name, "gradient_%c%c", "xyz"[a / d], "xyz"[a % d]);
        scree_average_table_take(table, name, "1", c->gradient[p][3 * (a / d) + a % d]);
    }
    const scree_average_elastic found = scree_average_elastic_find(kernel->dimension, stress, c->gradient[p]);
    scree_average_table_take(table, "bulk_modulus", "Pa", found.bulk);
    scree_average_table_take(table, "shear_modulus", "Pa", found.shear);
    scree_average_table_take(table, "young_modulus", "Pa", found.young);
    scree_average_table_take(table, "poisson_ratio", "1", found.poisson);
    scree_average_table_take(table, "elastic_misfit", "1", found.misfit);
}

static void tell_kinetic(const scree_average_kernel *kernel, size_t point, scree_average_table *table)
{
    const size_t d = (size_t)kernel->dimension;
    double stress[9];
    char name[32];
    scree_average_kernel_kinetic(kernel, point, stress);
    for (size_t a = 0; a < d * d; a++) {
        (void)snprintf(name, sizeof name, "kinetic_%c%c", "xyz"[a / d], "xyz"[a % d]);
        scree_average_table_take(table, name, "Pa", stress[a]);
    }
}

/// The other side of the balance, and by how much of `scale` [N/m3] both differ.
static void tell_balance(const scree_average_sample *sample, const scree_average_kernel *kernel, double scale,
                         size_t point, scree_average_table *table)
{
    const size_t d = (size_t)kernel->dimension;
    char name[32];
    for (size_t a = 0; a < d; a++) {
        (void)snprintf(name, sizeof name, "resultant_%c", "xyz"[a]);
        scree_average_table_take(table, name, "N/m3", kernel->resultant[d * point + a]);
    }
    scree_average_table_take(table, "residual", "1", scree_average_kernel_residual(sample, kernel, point) / scale);
}

/// Rows of the smooth fields. scale: of their balance.
static scree_status fill_kernel_table(const scree_average_sample *sample, const scree_average_kernel *kernel,
                                      double scale, const changes *c, bool kinetic, scree_average_table *table,
                                      scree_error *error)
{
    const size_t d = (size_t)kernel->dimension, *n = kernel->points.number;
    char name[32];
    scree_status status = SCREE_OK;
    for (size_t p = 0; p < kernel->count && !status; p++) {
        const size_t number[3] = {p % n[0], p / n[0] % n[1], p / n[0] / n[1]};
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        for (size_t a = 0; a < d; a++)
            scree_average_table_take(table, (const char *[]){"x", "y", "z"}[a], "m",
                                     kernel->points.first[a] + (double)number[a] * kernel->points.gap[a]);
        scree_average_table_take(table, "density", "kg/m3", kernel->density[p]);
        scree_average_table_take(table, "volume_fraction", "1", kernel->fraction[p]);
        for (size_t a = 0; a < d * d; a++) {
            (void)snprintf(name, sizeof name, "stress_%c%c", "xyz"[a / d], "xyz"[a % d]);
            scree_average_table_take(table, name, "Pa", kernel->stress[d * d * p + a]);
        }
        for (size_t a = 0; a < d; a++) {
            (void)snprintf(name, sizeof name, "boundary_%c", "xyz"[a]);
            scree_average_table_take(table, name, "N/m3", kernel->boundary[d * p + a]);
        }
        for (size_t a = 0; a < d; a++) {
            (void)snprintf(name, sizeof name, "velocity_%c", "xyz"[a]);
            scree_average_table_take(table, name, "m/s", kernel->momentum[d * p + a] / kernel->density[p]);
        }
        tell_balance(sample, kernel, scale, p, table);
        if (kinetic) tell_kinetic(kernel, p, table);
        if (c->earlier) tell_changes(kernel, c, p, table);
        status = scree_average_table_end_row(table, error);
    }
    return status;
}

scree_status measure_kernel(const scree_average_sample *before, const scree_average_sample *sample,
                            const scree_average_view *view, const measure_plan *plan, measure_tables *tables,
                            scree_error *error)
{
    const double width = plan->kernel_width > 0 ? plan->kernel_width : 2 * plan->kernel_diameters * sample->mean_radius;
    const scree_average_points points = points_of(view, &plan->average);
    scree_average_kernel kernel;
    changes c;
    scree_status status = scree_average_kernel_find(sample, width, &points, true, plan->threads, &kernel, error);
    if (status) return status;
    const scree_average_balance balance = scree_average_kernel_balance(sample, &kernel);
    scree_average_table *values = &tables->of[MEASURE_VALUES];
    scree_average_table_take(values, "kernel_width", "m", width);
    scree_average_table_take(values, "kernel_residual", "1", balance.residual / balance.scale);
    scree_average_table_take(values, "kernel_imbalance", "1", balance.rest / balance.scale);
    status = find_changes(before, sample, width, &points, plan->threads, &c, error);
    if (!status)
        status = fill_kernel_table(sample, &kernel, balance.scale, &c, plan->average.fields & SCREE_AVERAGE_KINETIC,
                                   &tables->of[MEASURE_KERNEL], error);
    scree_average_kernel_destroy(&kernel);
    scree_release(&c.earlier);
    scree_release(&c.displacement);
    scree_release(&c.gradient);
    return status;
}
