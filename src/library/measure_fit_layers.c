/// Theories of layers fitted to the mean response of an ensemble of layers to a load on one grain, or to that of one.
///
/// What is fitted are means over elements (measure_response.c), in units of the thickness and the load: vertical and
/// horizontal pressures at depths from the base upwards, an element apart, that lie more than NEAR elements below the
/// load, and at places up to FAR from it, two sides apart, so that hats do not overlap. The theories are means over the
/// same elements (scree_layer_mean). The load is free, so that its ratio to the true one is a check, and so is
/// Poisson's ratio where the base is bonded; where the best one lies outside of 0 to 0.5 it is held at the better end.
///
/// Errors of an ensemble of three or more are standard errors of the mean over the runs, as the root of the mean square
/// along a depth; intervals are those of the jackknife over whole runs (measure_fit_numbers.c). One layer or two have
/// one error of all values, that which the best of the theories leaves (its chi^2 is then what is expected, and says
/// nothing, but the differences of chi^2 and AIC do); intervals follow from it, with Student's t.
#include "library/measure.h"

#include "io/run_directory.h"
#include "view/chart.h"

#include <gsl/gsl_cdf.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define NEAR 1.5 /* elements */
#define FAR  1.  /* thicknesses */

/// The shear stress is not measured.
enum { XX, YY, COMPONENTS, CHART_LINES = 7 };

typedef struct layers {
    const scree_average_table **each; ///< responses
    size_t count, without;
    size_t x, depth, element, column[COMPONENTS];
} layers;

// ---- points ------------------------------------------------------------------------------------------------------

/// Mean of a value over the layers, and its standard error.
static double mean_of(const layers *l, size_t row, size_t column, double *error)
{
    measure_fit_mean mean = {0};
    for (size_t i = 0; i < l->count; i++)
        if (i != l->without) measure_fit_add(&mean, scree_average_table_get(l->each[i], row, column));
    return measure_fit_mean_of(&mean, error);
}

/// The places of a depth that have values.
static size_t lay_out_depth(const layers *l, size_t first, size_t points, size_t level, bool taken,
                            measure_fit_row *row)
{
    double last = -INFINITY, unused;
    size_t count = 0;
    for (size_t k = first; k < first + points; k++) {
        measure_fit_row *r = &row[count];
        const double side = mean_of(l, k, l->element, &unused);
        *r = (measure_fit_row){.cut = level,
                               .point = {.x = mean_of(l, k, l->x, &unused), .y = mean_of(l, k, l->depth, &unused)}};
        for (int c = 0; c < COMPONENTS; c++)
            *measure_fit_component(&r->point.stress, c) =
                mean_of(l, k, l->column[c], measure_fit_component(&r->point.error, c));
        if (!isfinite(r->point.stress.xx) || !isfinite(r->point.stress.yy)) continue;
        r->fitted = taken && r->point.x <= FAR * (1 + 1e-9) && r->point.x - last >= 1.999 * side;
        if (r->fitted) last = r->point.x;
        count++;
    }
    return count;
}

/// Depths from the base upwards.
static size_t lay_out(const layers *l, measure_fit_row *row)
{
    const scree_average_table *table = l->each[0];
    size_t count = 0, points = 1;
    double last = INFINITY, unused;
    while (points < table->rows &&
           scree_average_table_get(table, points, l->depth) == scree_average_table_get(table, 0, l->depth))
        points++;
    for (size_t level = table->rows / points; level-- > 0;) {
        const size_t first = level * points;
        const double depth = mean_of(l, first, l->depth, &unused), side = mean_of(l, first, l->element, &unused);
        const bool taken = last - depth >= 0.999 * side && depth >= NEAR * side;
        const size_t added = lay_out_depth(l, first, points, level, taken, row + count);
        measure_fit_pool(row + count, added);
        for (size_t k = count; k < count + added && l->count < MEASURE_FIT_RUNS; k++)
            row[k].point.error = (scree_stress_2d){1, 1, 0}; // until take_error
        if (taken) last = depth;
        count += added;
    }
    return count;
}

// ---- fits --------------------------------------------------------------------------------------------------------

static scree_status begin_fit(const char *theory, double element, double poisson, bool free, scree_fit *fit,
                              scree_error *error)
{
    scree_status status = scree_fit_begin(theory, fit, error);
    if (!status) status = scree_fit_set(fit, "force", 1, true, error);
    if (!status) status = scree_fit_set(fit, "element", element, false, error);
    if (!status && scree_fit_find(fit, "thickness")) status = scree_fit_set(fit, "thickness", 1, false, error);
    if (!status && scree_fit_find(fit, "poisson_ratio"))
        status = scree_fit_set(fit, "poisson_ratio", poisson, free, error);
    return status;
}

/// The first of two beginnings that ends with a Poisson's ratio that means something, else the better end of its range.
/// False: there is none.
static bool solve(const char *theory, double element, size_t count, const scree_fit_point *points, scree_fit *best)
{
    static const double begins[] = {0.3, 0.1}, ends[] = {0, 0.5};
    bool found = false;
    for (int held = 0; held < 2 && !found; held++)
        for (int k = 0; k < 2; k++) {
            scree_fit fit;
            scree_error ignored = {0};
            if (begin_fit(theory, element, held ? ends[k] : begins[k], !held, &fit, &ignored)) continue;
            if (scree_fit_solve(&fit, count, points, &ignored)) continue;
            const scree_fit_parameter *poisson = scree_fit_find(&fit, "poisson_ratio");
            if (poisson && !(poisson->value >= 0 && poisson->value <= 0.5)) continue;
            if (!found || fit.chi_square < best->chi_square) *best = fit;
            found = true;
            if (!held) return true;
        }
    return found;
}

/// Points of a set of layers, and what the theories are there.
typedef struct fitting {
    scree_fit_point *fitted, *all;
    scree_stress_2d *stress;
    scree_fit fit[MEASURE_FITS];
    size_t count;
    double element;
} fitting;

static void gather(const measure_fits *fits, fitting *f)
{
    f->count = 0;
    for (size_t k = 0; k < fits->rows; k++) {
        f->all[k] = fits->row[k].point;
        if (fits->row[k].fitted) f->fitted[f->count++] = f->all[k];
    }
}

/// Theory k at the places that are fitted, or at all.
static bool look_up(measure_fits *fits, const fitting *f, size_t k, bool fitted)
{
    scree_error ignored = {0};
    size_t next = 0;
    if (scree_fit_stress(&f->fit[k], fitted ? f->count : fits->rows, fitted ? f->fitted : f->all, f->stress, &ignored))
        return false;
    for (size_t i = 0; i < fits->rows; i++) {
        if (fitted && !fits->row[i].fitted) continue;
        fits->row[i].theory[k] = (scree_stress_2d){f->stress[next].xx, f->stress[next].yy, 0};
        next++;
    }
    return true;
}

static void solve_all(measure_fits *fits, fitting *f)
{
    for (size_t k = 0; k < fits->count; k++)
        fits->solved[k] =
            solve(fits->theory[k], f->element, f->count, f->fitted, &f->fit[k]) && look_up(fits, f, k, true);
}

/// Of one layer: the error of all values, which the best theory leaves.
static void take_error(measure_fits *fits, const fitting *f)
{
    double least = INFINITY;
    for (size_t k = 0; k < fits->count; k++)
        if (fits->solved[k]) least = fmin(least, f->fit[k].reduced);
    for (size_t i = 0; i < fits->rows && least > 0 && isfinite(least); i++)
        fits->row[i].point.error = (scree_stress_2d){sqrt(least), sqrt(least), 0};
}

/// Intervals of the parameters of one layer.
static void take_intervals(measure_fits *fits, const fitting *f)
{
    for (size_t k = 0; k < fits->count; k++) {
        const scree_fit *fit = &f->fit[k];
        for (size_t i = 0; i < fit->parameters && fits->solved[k]; i++) {
            const scree_fit_parameter *p = &fit->parameter[i];
            const double half = gsl_cdf_tdist_Pinv(0.975, (double)(fit->values - fit->free)) * p->error;
            char name[64];
            (void)snprintf(name, sizeof name, "fit_%s_%s%s", fits->theory[k], p->name,
                           strcmp(p->name, "force") == 0 ? "_ratio" : "");
            for (size_t n = 0; n < fits->numbers && p->free; n++) {
                measure_fit_number *number = &fits->number[n];
                if (strcmp(number->name, name) != 0) continue;
                number->low = number->value - half;
                number->high = number->value + half;
            }
        }
    }
}

static scree_status tell_all(measure_fits *fits, fitting *f, scree_error *error)
{
    double squares = 0;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < f->count; k++) squares += pow(f->fitted[k].error.xx, 2) + pow(f->fitted[k].error.yy, 2);
    measure_fit_tell(fits, "fit_values", "", "1", false, (double)(COMPONENTS * f->count));
    measure_fit_tell(fits, "fit_error", "", "1", false, sqrt(squares / (double)(COMPONENTS * f->count)));
    for (size_t k = 0; k < fits->count && !status; k++) {
        if (!fits->solved[k]) status = begin_fit(fits->theory[k], f->element, 0.3, true, &f->fit[k], error);
        if (!status) measure_fit_tell_theory(fits, k, &f->fit[k], fits->solved[k], 1);
    }
    return status;
}

static scree_status fit_rows(measure_fits *fits, const layers *l, fitting *f, scree_error *error)
{
    const bool alone = l->count < MEASURE_FIT_RUNS;
    double unused;
    gather(fits, f);
    if (f->count < 2)
        return scree_error_refuse(error, "--fit", NULL,
                                  "the layers are too small for their elements: fewer than two lie within a thickness "
                                  "of the load, apart from it and from each other (measure.response_element)");
    f->element = mean_of(l, 0, l->element, &unused);
    solve_all(fits, f);
    if (alone) {
        take_error(fits, f);
        gather(fits, f);
        solve_all(fits, f);
    }
    for (size_t k = 0; k < fits->count && l->without == SIZE_MAX; k++)
        fits->solved[k] = fits->solved[k] && look_up(fits, f, k, false);
    scree_status status = tell_all(fits, f, error);
    if (!status && alone) take_intervals(fits, f);
    return status;
}

static scree_status find_numbers(measure_fits *fits, void *user, size_t without, scree_error *error)
{
    layers *l = user;
    fitting *f;
    scree_status status = scree_allocate(&f, 1, sizeof *f, error);
    if (status) return status;
    l->without = without;
    fits->numbers = 0;
    fits->rows = lay_out(l, fits->row);
    status = scree_allocate(&f->fitted, fits->rows + 1, sizeof *f->fitted, error);
    if (!status) status = scree_allocate(&f->all, fits->rows + 1, sizeof *f->all, error);
    if (!status) status = scree_allocate(&f->stress, fits->rows + 1, sizeof *f->stress, error);
    if (!status) status = fit_rows(fits, l, f, error);
    scree_release(&f->fitted);
    scree_release(&f->all);
    scree_release(&f->stress);
    scree_release(&f);
    return status;
}

static scree_status fit_layers(layers *l, const measure_plan *plan, measure_found *found, scree_error *error)
{
    const scree_average_table *table = l->each[0];
    l->x = scree_average_table_find(table, "x");
    l->depth = scree_average_table_find(table, "depth");
    l->element = scree_average_table_find(table, "element");
    l->column[XX] = scree_average_table_find(table, "horizontal");
    l->column[YY] = scree_average_table_find(table, "vertical");
    scree_status status = scree_allocate(&found->fits, 1, sizeof *found->fits, error);
    if (status) return status;
    found->fits->layers = true;
    found->fits->count = plan->fits;
    for (size_t k = 0; k < plan->fits; k++) found->fits->theory[k] = plan->fit[k];
    found->fits->room = table->rows;
    status = scree_allocate(&found->fits->row, found->fits->room, sizeof *found->fits->row, error);
    if (!status) status = find_numbers(found->fits, l, SIZE_MAX, error);
    if (status || l->count < MEASURE_FIT_RUNS) return status;
    return measure_fit_jackknife(found->fits, l->count, find_numbers, l, error);
}

scree_status measure_fit_layers(const measure_tables *each, size_t count, const measure_plan *plan,
                                measure_found *found, scree_error *error)
{
    layers l = {.without = SIZE_MAX};
    if (found->responses == 0)
        return scree_error_refuse(
            error, "--fit", NULL,
            "theories of layers are fitted to a response, and there is none: the runs need a load "
            "on a grain at their top (measure.response_load)");
    scree_status status = scree_allocate(&l.each, count, sizeof *l.each, error);
    for (size_t i = 0; i < count && !status; i++)
        if (each[i].of[MEASURE_RESPONSE].rows > 0) l.each[l.count++] = &each[i].of[MEASURE_RESPONSE];
    if (!status) status = fit_layers(&l, plan, found, error);
    scree_release(&l.each);
    return status;
}

// ---- files and figures -------------------------------------------------------------------------------------------

static void put_rows(FILE *file, const measure_fits *fits)
{
    fputs("depth [1],x [1],fitted,vertical [1],horizontal [1],error_vertical [1],error_horizontal [1]", file);
    for (size_t k = 0; k < fits->count; k++)
        fprintf(file, ",%s_vertical [1],%s_horizontal [1]", fits->theory[k], fits->theory[k]);
    fputc('\n', file);
    for (size_t i = 0; i < fits->rows; i++) {
        const measure_fit_row *r = &fits->row[i];
        const scree_fit_point *p = &r->point;
        fprintf(file, "%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g", p->y, p->x, r->fitted, p->stress.yy, p->stress.xx,
                p->error.yy, p->error.xx);
        for (size_t k = 0; k < fits->count; k++) {
            const double none = fits->solved[k] ? 1 : NAN;
            fprintf(file, ",%.9g,%.9g", none * r->theory[k].yy, none * r->theory[k].xx);
        }
        fputc('\n', file);
    }
}

scree_status measure_fit_layers_write(const char *folder, const measure_fits *fits, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, folder, "fit-points.csv", error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    put_rows(file, fits);
    return scree_replace_finish(path, file, true, error);
}

/// A component at the base with the theories.
static scree_status draw_component(const char *folder, const char *file, const char *label, int component,
                                   const measure_fits *fits, scree_error *error)
{
    char path[PATH_MAX], name[CHART_LINES][32];
    double *number = NULL;
    size_t n = 0, lines = 1;
    while (n < fits->rows && fits->row[n].cut == fits->row[0].cut) n++;
    scree_chart_line line[CHART_LINES] = {{0}};
    scree_status status = scree_path_join(path, sizeof path, folder, file, error);
    if (!status) status = scree_allocate(&number, (4 + fits->count) * (n + 1), sizeof *number, error);
    if (status) return status;
    double *x = number, *y = x + n, *low = y + n, *high = low + n;
    for (size_t i = 0; i < n; i++) {
        measure_fit_row r = fits->row[i];
        const double half = *measure_fit_component(&r.point.error, component);
        x[i] = r.point.x;
        y[i] = *measure_fit_component(&r.point.stress, component);
        low[i] = y[i] - half;
        high[i] = y[i] + half;
    }
    line[0] = (scree_chart_line){x, y, low, high, n, .label = "grains, standard error", .points = true, .bare = true};
    for (size_t k = 0; k < fits->count && lines < CHART_LINES; k++) {
        double *theory = high + (k + 1) * n;
        if (!fits->solved[k]) continue;
        for (size_t i = 0; i < n; i++) {
            measure_fit_row r = fits->row[i];
            theory[i] = *measure_fit_component(&r.theory[k], component);
        }
        // An underscore would begin a subscript.
        (void)snprintf(name[lines], sizeof name[lines], "%s", fits->theory[k]);
        for (char *c = name[lines]; *c; c++) *c = *c == '_' ? ' ' : *c;
        line[lines] = (scree_chart_line){x, theory, .count = n, .label = name[lines]};
        lines++;
    }
    const scree_chart chart = {.title = "Response at the base and the fitted theories",
                               .x_label = "distance from the load / thickness",
                               .y_label = label,
                               .line = line,
                               .line_count = lines};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&number);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

scree_status measure_fit_layers_draw(const char *folder, const measure_fits *fits, scree_error *error)
{
    scree_status status =
        draw_component(folder, "fits-vertical", "vertical response times thickness / load", YY, fits, error);
    return status ? status
                  : draw_component(folder, "fits-horizontal", "horizontal response times thickness / load", XX, fits,
                                   error);
}
