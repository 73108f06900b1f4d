/// Theories of piles fitted to the mean stresses of an ensemble of plane piles, and closures.
///
/// Of each pile the mean of both sides is taken (a pile and its mirror image are one sample), in the frame of the
/// theories: x from the axis, y down from the tip of the triangle of the same area and centre of mass, compression
/// positive. Fits take elements that lie within the piles and do not overlap; their errors are standard errors of the
/// mean over the piles, as the root of the mean square along a cut, since that of one place of few piles is noise.
/// Slope and tip are held; the weight is free, so that its ratio to the measured one is a check. Intervals of the
/// parameters are those of the jackknife over whole piles (J. W. Tukey, Ann. Math. Statist. 29, 614, 1958) with
/// Student's t: each pile is left out once, with its place in slope and height. They do not rest on the independence of
/// elements, on which chi^2, its probability and AIC do.
///
/// With two slopes nothing is folded: x goes from the apex of the triangle of the same area, height of the centre of
/// mass, feet and centre of mass, whose slopes the wedges take; runs have to be built alike, to the same side.
///
/// mohr_coulomb: ((xx - yy)^2 + 4 xy^2) / ((xx + yy)^2 sin^2 slope) - 1 (R 4.2): 0 where the pile yields, below where
/// it does not. The axis is what lies within AXIS of the half width, the flank between FLANK and FLANK_END; of the
/// lowest cut of the half width of the base, of those above it, `_above`, of that which the pile has at their height.
#include "library/measure.h"

#include "io/run_directory.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define WHOLE     0.99 /* part of an element that has to lie in the piles */
#define AXIS      0.1
#define FLANK     0.5
#define FLANK_END 0.8
#define DEGREE    (M_PI / 180)

enum { COMPONENTS = MEASURE_FIT_COMPONENTS };

/// What the search of one set of piles sees.
typedef struct piles {
    const measure_tables *each;
    size_t count, without; ///< number of piles; the one that is left out, SIZE_MAX: none
    const measure_plan *plan;
    const measure_found *found;
    size_t column[COMPONENTS], x, y, inside;
} piles;

// ---- points ------------------------------------------------------------------------------------------------------

/// Mean of a value over the piles.
static double mean_value(const piles *p, const char *name)
{
    double sum = 0, number = 0;
    for (size_t i = 0; i < p->count; i++) {
        const scree_average_table *values = &p->each[i].of[MEASURE_VALUES];
        if (i == p->without) continue;
        sum += values->value[scree_average_table_find(values, name)];
        number++;
    }
    return sum / number;
}

/// Component of pile i at place j of a cut, mean of both sides unless there are two slopes, in the frame of the
/// theories.
static double folded(const piles *p, size_t i, size_t cut, long j, int component)
{
    const size_t points = p->plan->average.points, middle = cut * points + points / 2;
    const scree_average_table *cuts = &p->each[i].of[MEASURE_CUTS];
    const double right = scree_average_table_get(cuts, middle + (size_t)j, p->column[component]);
    const double left = scree_average_table_get(cuts, middle - (size_t)j, p->column[component]);
    if (p->plan->two_slopes) return component < 2 ? -right : right;
    return component < 2 ? -0.5 * (right + left) : 0.5 * (right - left);
}

/// Mean and standard error of the mean.
static double mean_folded(const piles *p, size_t cut, long j, int component, double *error)
{
    measure_fit_mean mean = {0};
    for (size_t i = 0; i < p->count; i++)
        if (i != p->without) measure_fit_add(&mean, folded(p, i, cut, j, component));
    return measure_fit_mean_of(&mean, error);
}

/// The places of all cuts that lie within the piles; those that do not overlap are to be fitted.
static size_t lay_out(const piles *p, measure_fit_row *row)
{
    const scree_average_table *mean = &p->found->mean.of[MEASURE_CUTS];
    const size_t points = p->plan->average.points;
    const bool two = p->plan->two_slopes;
    const double side = mean_value(p, "element_side"), tip = mean_value(p, "triangle_height");
    const double apex = two ? mean_value(p, "triangle_apex") : 0;
    size_t count = 0;
    double last_y = -INFINITY;
    for (size_t cut = 0; cut < p->plan->average.cuts; cut++) {
        const size_t middle = cut * points + points / 2, first = count;
        const double y = scree_average_table_get(mean, middle, p->y);
        const bool apart = y - last_y >= 0.999 * side;
        double last_x = -INFINITY;
        for (long j = two ? -(long)(points / 2) : 0; j <= (long)(points / 2); j++) {
            const size_t here = middle + (size_t)j, there = two ? here : middle - (size_t)j;
            const double x =
                scree_average_table_get(mean, here, p->x) - scree_average_table_get(mean, middle, p->x) - apex;
            measure_fit_row *r = &row[count];
            if (scree_average_table_get(mean, here, p->inside) < WHOLE ||
                scree_average_table_get(mean, there, p->inside) < WHOLE)
                continue;
            *r = (measure_fit_row){.cut = cut, .point = {.x = x, .y = tip - y}};
            for (int c = 0; c < COMPONENTS; c++)
                *measure_fit_component(&r->point.stress, c) =
                    mean_folded(p, cut, j, c, measure_fit_component(&r->point.error, c));
            r->fitted = apart && x - last_x >= 0.999 * side;
            if (r->fitted) last_x = x;
            count++;
        }
        if (apart && count > first) last_y = y;
        measure_fit_pool(row + first, count - first);
    }
    return count;
}

// ---- fits --------------------------------------------------------------------------------------------------------

/// Where searches begin.
static const double eta_begins[] = {0.5, 0.7, 0.9}, core_begins[] = {0.4, 0.6, 0.8};

static scree_status begin_fit(const char *theory, const double slope[2], double weight, int attempt, scree_fit *fit,
                              scree_error *error)
{
    scree_status status = scree_fit_begin(theory, fit, error);
    if (!status) status = scree_fit_set(fit, "weight", weight, true, error);
    if (!status && scree_fit_find(fit, "slope")) status = scree_fit_set(fit, "slope", slope[0], false, error);
    if (!status && scree_fit_find(fit, "slope_left")) status = scree_fit_set(fit, "slope_left", slope[0], false, error);
    if (!status && scree_fit_find(fit, "slope_right"))
        status = scree_fit_set(fit, "slope_right", slope[1], false, error);
    if (!status && scree_fit_find(fit, "eta")) status = scree_fit_set(fit, "eta", eta_begins[attempt], true, error);
    if (!status && scree_fit_find(fit, "core")) status = scree_fit_set(fit, "core", core_begins[attempt], true, error);
    return status;
}

/// The best of several beginnings; false: it has no solution from any of them.
static bool solve(const char *theory, const double slope[2], double weight, size_t count, const scree_fit_point *points,
                  scree_fit *best)
{
    bool found = false;
    for (int attempt = 0; attempt < 3; attempt++) {
        scree_fit fit;
        scree_error ignored = {0};
        if (begin_fit(theory, slope, weight, attempt, &fit, &ignored)) continue;
        if (scree_fit_solve(&fit, count, points, &ignored)) continue;
        if (!found || fit.chi_square < best->chi_square) *best = fit;
        found = true;
        if (!scree_fit_find(&fit, "eta") && !scree_fit_find(&fit, "core")) break;
    }
    return found;
}

static scree_status fit_all(measure_fits *fits, const piles *p, scree_error *error)
{
    const bool two = p->plan->two_slopes;
    const double weight = mean_value(p, "weight_density");
    scree_fit_point *fitted = NULL, *all = NULL;
    scree_stress_2d *stress = NULL;
    size_t count = 0;
    scree_status status = scree_allocate(&fitted, fits->rows, sizeof *fitted, error);
    if (!status) status = scree_allocate(&all, fits->rows, sizeof *all, error);
    if (!status) status = scree_allocate(&stress, fits->rows, sizeof *stress, error);
    fits->slope[0] = mean_value(p, two ? "triangle_slope_left" : "triangle_slope") * DEGREE;
    fits->slope[1] = mean_value(p, two ? "triangle_slope_right" : "triangle_slope") * DEGREE;
    for (size_t k = 0; k < fits->rows && !status; k++) {
        all[k] = fits->row[k].point;
        if (fits->row[k].fitted) fitted[count++] = all[k];
    }
    for (size_t k = 0; k < fits->count && !status; k++) {
        scree_fit fit;
        scree_error ignored = {0};
        bool solved = solve(fits->theory[k], fits->slope, weight, count, fitted, &fit);
        if (solved) solved = scree_fit_stress(&fit, fits->rows, all, stress, &ignored) == SCREE_OK;
        if (!solved) status = scree_fit_begin(fits->theory[k], &fit, error);
        for (size_t i = 0; i < fits->rows && solved; i++) fits->row[i].theory[k] = stress[i];
        fits->solved[k] = solved;
        fits->fit[k] = fit;
        if (!status) measure_fit_tell_theory(fits, k, &fit, solved, weight);
    }
    scree_release(&fitted);
    scree_release(&all);
    scree_release(&stress);
    return status;
}

// ---- closures ----------------------------------------------------------------------------------------------------

double measure_fit_yielding(const measure_fits *fits, const scree_fit_point *point)
{
    const scree_stress_2d *s = &point->stress;
    const double slope = fits->slope[point->x < 0 ? 0 : 1];
    return (pow(s->xx - s->yy, 2) + 4 * s->xy * s->xy) / pow((s->xx + s->yy) * sin(slope), 2) - 1;
}

/// Distance from the axis over the half width of the triangle at that height, of its side.
static double place_above(const measure_fits *fits, const scree_fit_point *point)
{
    return fabs(point->x) * tan(fits->slope[point->x < 0 ? 0 : 1]) / point->y;
}

/// Mean over all cuts above the lowest one between two such distances.
static void tell_yield_above(measure_fits *fits, const char *where, double from, double to)
{
    double yielding = 0, number = 0;
    for (size_t k = 0; k < fits->rows; k++) {
        const measure_fit_row *r = &fits->row[k];
        const double place = place_above(fits, &r->point);
        if (r->cut == 0 || place < from || place > to) continue;
        yielding += measure_fit_yielding(fits, &r->point);
        number++;
    }
    measure_fit_tell(fits, "mohr_coulomb", where, "1", true, number > 0 ? yielding / number : NAN);
}

/// Means over the lowest cut between two distances from the axis, over the half width of the triangle.
static void tell_closure(measure_fits *fits, const char *where, double from, double to, double half)
{
    double yielding = 0, ratio = 0, number = 0;
    for (size_t k = 0; k < fits->rows; k++) {
        const measure_fit_row *r = &fits->row[k];
        const double place = fabs(r->point.x) / half;
        if (r->cut != 0 || place < from || place > to) continue;
        yielding += measure_fit_yielding(fits, &r->point);
        ratio += r->point.stress.xx / r->point.stress.yy;
        number++;
    }
    measure_fit_tell(fits, "mohr_coulomb", where, "1", true, number > 0 ? yielding / number : NAN);
    measure_fit_tell(fits, "stress_ratio", where, "1", true, number > 0 ? ratio / number : NAN);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

/// All numbers of a set of piles. fits: with names and room for rows.
static scree_status find_numbers(measure_fits *fits, void *user, size_t without, scree_error *error)
{
    piles *p = user;
    p->without = without;
    fits->numbers = 0;
    fits->rows = lay_out(p, fits->row);
    size_t fitted = 0;
    for (size_t k = 0; k < fits->rows; k++) fitted += fits->row[k].fitted;
    if (fitted < 2)
        return scree_error_refuse(
            error, "--fit", NULL,
            "the piles are too small for their elements: fewer than two lie within them side by side "
            "(--element)");
    scree_status status = fit_all(fits, p, error);
    const double half = mean_value(p, "triangle_height") * 0.5 * (1 / tan(fits->slope[0]) + 1 / tan(fits->slope[1]));
    tell_closure(fits, "axis", 0, AXIS, half);
    tell_closure(fits, "flank", FLANK, FLANK_END, half);
    tell_yield_above(fits, "axis_above", 0, AXIS);
    tell_yield_above(fits, "flank_above", FLANK, FLANK_END);
    return status;
}

scree_status measure_fit(const measure_tables *each, size_t count, const measure_plan *plan, measure_found *found,
                         scree_error *error)
{
    const scree_average_table *cuts = &each[0].of[MEASURE_CUTS], *values = &found->mean.of[MEASURE_VALUES];
    const size_t height = scree_average_table_find(values, "triangle_height");
    piles p = {.each = each, .count = count, .without = SIZE_MAX, .plan = plan, .found = found};
    static const char *const names[COMPONENTS] = {"stress_xx", "stress_yy", "stress_xy"};
    if (count < MEASURE_FIT_RUNS)
        return scree_error_refuse(
            error, "--fit", NULL,
            "theories are fitted to the mean of three piles or more, whose scatter is the error: give the "
            "folders of several piles");
    for (int c = 0; c < COMPONENTS; c++) p.column[c] = scree_average_table_find(cuts, names[c]);
    p.x = scree_average_table_find(cuts, "x");
    p.y = scree_average_table_find(cuts, "y");
    p.inside = scree_average_table_find(cuts, "inside");
    if (p.column[0] == SIZE_MAX || p.y == SIZE_MAX || p.inside == SIZE_MAX)
        return scree_error_refuse(error, "--fit", NULL,
                                  "fits need stresses along cuts (--fields stress) of a plane sample");
    if (height == SIZE_MAX || !(values->value[height] > 0))
        return scree_error_refuse(error, "--fit", NULL, "fits are of plane piles under gravity");
    for (size_t k = 0; k < plan->fits && plan->two_slopes; k++)
        if (strncmp(plan->fit[k], "wedge", 5) != 0)
            return scree_error_refuse(error, "--fit", NULL,
                                      "only the wedges have two slopes: --two-slopes with --fit wedge");
    scree_status status = scree_allocate(&found->fits, 1, sizeof *found->fits, error);
    if (status) return status;
    found->fits->count = plan->fits;
    for (size_t k = 0; k < plan->fits; k++) found->fits->theory[k] = plan->fit[k];
    found->fits->room = plan->average.cuts * plan->average.points;
    status = scree_allocate(&found->fits->row, found->fits->room, sizeof *found->fits->row, error);
    if (!status) status = find_numbers(found->fits, &p, SIZE_MAX, error);
    return status ? status : measure_fit_jackknife(found->fits, count, find_numbers, &p, error);
}

// ---- files -------------------------------------------------------------------------------------------------------

static void put_rows(FILE *file, const measure_plan *plan, const measure_fits *fits)
{
    fputs("height [1],x [m],y [m],fitted,mohr_coulomb [1],stress_xx [Pa],stress_yy [Pa],stress_xy [Pa],error_xx [Pa],"
          "error_yy [Pa],error_xy [Pa]",
          file);
    for (size_t k = 0; k < fits->count; k++)
        fprintf(file, ",%s_xx [Pa],%s_yy [Pa],%s_xy [Pa]", fits->theory[k], fits->theory[k], fits->theory[k]);
    fputc('\n', file);
    for (size_t i = 0; i < fits->rows; i++) {
        const measure_fit_row *r = &fits->row[i];
        const scree_stress_2d *s = &r->point.stress, *e = &r->point.error;
        fprintf(file, "%.9g,%.9g,%.9g,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", plan->average.height[r->cut], r->point.x,
                r->point.y, r->fitted, measure_fit_yielding(fits, &r->point), s->xx, s->yy, s->xy, e->xx, e->yy, e->xy);
        for (size_t k = 0; k < fits->count; k++) {
            const scree_stress_2d *t = &r->theory[k];
            const double none = fits->solved[k] ? 1 : NAN;
            fprintf(file, ",%.9g,%.9g,%.9g", none * t->xx, none * t->yy, none * t->xy);
        }
        fputc('\n', file);
    }
}

scree_status measure_fit_write(const char *folder, const measure_plan *plan, const measure_fits *fits,
                               scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, folder, "fit-points.csv", error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    put_rows(file, plan, fits);
    return scree_replace_finish(path, file, true, error);
}
