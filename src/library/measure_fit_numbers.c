/// What fits of piles (measure_fit.c) and of layers (measure_fit_layers.c) have in common: means with their errors,
/// their numbers, and the intervals of these.
#include "library/measure.h"

#include "io/run_directory.h"

#include <gsl/gsl_cdf.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define DEGREE (M_PI / 180)

void measure_fit_add(measure_fit_mean *mean, double value)
{
    mean->sum += value;
    mean->squares += value * value;
    mean->number++;
}

double measure_fit_mean_of(const measure_fit_mean *m, double *error)
{
    const double mean = m->sum / m->number;
    *error = sqrt(fmax(0, m->squares / m->number - mean * mean) / (m->number - 1));
    return mean;
}

double *measure_fit_component(scree_stress_2d *stress, int component)
{
    return component == 0 ? &stress->xx : component == 1 ? &stress->yy : &stress->xy;
}

void measure_fit_pool(measure_fit_row *row, size_t count)
{
    for (int c = 0; c < MEASURE_FIT_COMPONENTS && count > 0; c++) {
        double squares = 0;
        for (size_t k = 0; k < count; k++) squares += pow(*measure_fit_component(&row[k].point.error, c), 2);
        for (size_t k = 0; k < count; k++)
            *measure_fit_component(&row[k].point.error, c) = sqrt(squares / (double)count);
    }
}

void measure_fit_tell(measure_fits *fits, const char *first, const char *second, const char *unit, bool sampled,
                      double value)
{
    measure_fit_number *n = &fits->number[fits->numbers];
    if (fits->numbers == MEASURE_FIT_NUMBERS) return;
    (void)snprintf(n->name, sizeof n->name, "%s%s%s", first, second[0] ? "_" : "", second);
    n->unit = unit;
    n->sampled = sampled;
    n->value = value;
    n->low = n->high = NAN;
    fits->numbers++;
}

/// Distance of the theory from the measured stresses over these, roots of mean squares.
static double misfit_of(const measure_fit_row *row, size_t rows, size_t theory)
{
    double distance = 0, size = 0;
    for (size_t k = 0; k < rows; k++) {
        const scree_stress_2d *a = &row[k].point.stress, *b = &row[k].theory[theory];
        if (!row[k].fitted) continue;
        distance += pow(a->xx - b->xx, 2) + pow(a->yy - b->yy, 2) + 2 * pow(a->xy - b->xy, 2);
        size += a->xx * a->xx + a->yy * a->yy + 2 * a->xy * a->xy;
    }
    return sqrt(distance / size);
}

/// A parameter that is told over its measured value; NULL: it is told itself.
static const char *ratio_of(const char *name)
{
    if (strcmp(name, "weight") == 0) return "weight_ratio";
    return strcmp(name, "force") == 0 ? "force_ratio" : NULL;
}

/// What is found, or was meant to be and lies at the end of its range.
static bool told(const scree_fit_parameter *p)
{
    return p->free || strcmp(p->name, "poisson_ratio") == 0;
}

void measure_fit_tell_theory(measure_fits *fits, size_t k, const scree_fit *fit, bool solved, double measured)
{
    char name[40];
    (void)snprintf(name, sizeof name, "fit_%s", fits->theory[k]);
    for (size_t i = 0; i < fit->parameters; i++) {
        const scree_fit_parameter *p = &fit->parameter[i];
        const bool angle = strcmp(p->unit, "rad") == 0;
        const char *ratio = ratio_of(p->name);
        if (!told(p)) continue;
        const double value = ratio ? p->value / measured : angle ? p->value / DEGREE : p->value;
        measure_fit_tell(fits, name, ratio ? ratio : p->name, angle ? "degree" : "1", true, solved ? value : NAN);
    }
    scree_fit_derived derived[SCREE_FIT_DERIVED];
    const size_t count = fit->theory->derive ? fit->theory->derive(fit->theory, fit->parameter, derived) : 0;
    for (size_t i = 0; i < count; i++) {
        const bool angle = strcmp(derived[i].unit, "rad") == 0;
        measure_fit_tell(fits, name, derived[i].name, angle ? "degree" : "1", true,
                         solved ? derived[i].value / (angle ? DEGREE : 1) : NAN);
    }
    measure_fit_tell(fits, name, "misfit", "1", true, solved ? misfit_of(fits->row, fits->rows, k) : NAN);
    measure_fit_tell(fits, name, "chi_square", "1", false, solved ? fit->chi_square : NAN);
    measure_fit_tell(fits, name, "reduced", "1", false, solved ? fit->reduced : NAN);
    measure_fit_tell(fits, name, "probability", "1", false, solved ? fit->probability : NAN);
    measure_fit_tell(fits, name, "information", "1", false, solved ? fit->information : NAN);
}

scree_status measure_fit_jackknife(measure_fits *fits, size_t count, measure_fit_find *find, void *user,
                                   scree_error *error)
{
    const double n = (double)count;
    double sum[MEASURE_FIT_NUMBERS] = {0}, squares[MEASURE_FIT_NUMBERS] = {0};
    measure_fits *without = NULL;
    scree_status status = scree_allocate(&without, 1, sizeof *without, error);
    if (!status) *without = *fits;
    if (!status) status = scree_allocate(&without->row, fits->room, sizeof *without->row, error);
    for (size_t left = 0; left < count && !status; left++) {
        status = find(without, user, left, error);
        for (size_t k = 0; k < fits->numbers && !status; k++) {
            // Sums of what differs from the whole: no digits are lost.
            const double change = without->number[k].value - fits->number[k].value;
            sum[k] += change;
            squares[k] += change * change;
        }
    }
    for (size_t k = 0; k < fits->numbers && !status; k++) {
        measure_fit_number *number = &fits->number[k];
        const double error_of = sqrt((n - 1) / n * fmax(0, squares[k] - sum[k] * sum[k] / n));
        const double half = gsl_cdf_tdist_Pinv(0.975, n - 1) * error_of;
        if (!number->sampled) continue;
        number->low = number->value - half;
        number->high = number->value + half;
    }
    if (without) scree_release(&without->row);
    scree_release(&without);
    return status;
}

scree_status measure_fit_write_numbers(const char *folder, const measure_fits *fits, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, folder, "fits.csv", error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fputs("name,unit,value,low,high\n", file);
    for (size_t k = 0; k < fits->numbers; k++) {
        const measure_fit_number *n = &fits->number[k];
        fprintf(file, "%s,%s,%.9g,%.9g,%.9g\n", n->name, n->unit, n->value, n->low, n->high);
    }
    return scree_replace_finish(path, file, true, error);
}
