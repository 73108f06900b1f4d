/// Figures of theories of piles that were fitted: stresses of the lowest cut with all of them, and where piles yield.
///
/// Theories are drawn at CURVE places from end to end of what was measured, not as chords between measured places: the
/// kink of a wedge lies where it is, to less than the width of a line.
#include "library/measure.h"

#include "io/run_directory.h"
#include "view/chart.h"

#include <limits.h>
#include <stdio.h>

enum {
    CURVE = 401, ///< a 400th of the width of a plot is a pixel or two
    BLACK = 7    ///< the last colour of charts
};

/// The lowest cut as a chart has it: all numbers in one block.
typedef struct base_chart {
    double *number, *x, *y, *low, *high; ///< mm, kPa; the measured places
    size_t places;
    double *fine, *theory; ///< mm; kPa, CURVE of each theory
    scree_chart_line line[MEASURE_FITS + 1];
    char name[MEASURE_FITS][32];
    size_t lines;
} base_chart;

static scree_status open_base(const measure_fits *fits, base_chart *base, scree_error *error)
{
    *base = (base_chart){.lines = 0};
    while (base->places < fits->rows && fits->row[base->places].cut == 0) base->places++;
    const size_t n = base->places;
    scree_status status = scree_allocate(&base->number, 4 * n + (1 + fits->count) * CURVE, sizeof *base->number, error);
    base->x = base->number;
    base->y = base->x + n;
    base->low = base->y + n;
    base->high = base->low + n;
    base->fine = base->high + n;
    base->theory = base->fine + CURVE;
    return status;
}

/// The curve of theory k, with what its search has found.
static scree_status take_theory(const measure_fits *fits, size_t k, int component, base_chart *base, scree_error *error)
{
    scree_fit_point *point = NULL;
    scree_stress_2d *stress = NULL;
    const scree_fit_point *first = &fits->row[0].point, *last = &fits->row[base->places - 1].point;
    double *value = base->theory + k * CURVE;
    char *name = base->name[base->lines];
    scree_status status = scree_allocate(&point, CURVE, sizeof *point, error);
    if (!status) status = scree_allocate(&stress, CURVE, sizeof *stress, error);
    for (size_t i = 0; i < CURVE && !status; i++) {
        const double part = (double)i / (CURVE - 1);
        point[i] = (scree_fit_point){.x = (1 - part) * first->x + part * last->x, .y = first->y};
        base->fine[i] = 1e3 * point[i].x;
    }
    if (!status) status = scree_fit_stress(&fits->fit[k], CURVE, point, stress, error);
    for (size_t i = 0; i < CURVE && !status; i++) value[i] = 1e-3 * *measure_fit_component(&stress[i], component);
    // An underscore would begin a subscript.
    (void)snprintf(name, sizeof base->name[0], "%s", fits->theory[k]);
    for (char *c = name; *c; c++) *c = *c == '_' ? ' ' : *c;
    if (!status) base->line[base->lines++] = (scree_chart_line){base->fine, value, .count = CURVE, .label = name};
    scree_release(&point);
    scree_release(&stress);
    return status;
}

/// Behind the theories, so that they are drawn upon them.
static void take_piles(const measure_fits *fits, int component, base_chart *base)
{
    for (size_t i = 0; i < base->places; i++) {
        measure_fit_row r = fits->row[i];
        const double half = *measure_fit_component(&r.point.error, component);
        base->x[i] = 1e3 * r.point.x;
        base->y[i] = 1e-3 * *measure_fit_component(&r.point.stress, component);
        base->low[i] = base->y[i] - 1e-3 * half;
        base->high[i] = base->y[i] + 1e-3 * half;
    }
    base->line[base->lines++] = (scree_chart_line){base->x,        base->y,      base->low,
                                                   base->high,     base->places, .label = "piles, standard error",
                                                   .points = true, .bare = true, .colour = BLACK};
}

static const char *place_label(const measure_plan *plan)
{
    return plan->two_slopes ? "x from the apex (mm)" : "distance from the axis (mm)";
}

/// A component of the lowest cut with the theories.
static scree_status draw_component(const char *folder, const char *file, const char *label, int component,
                                   const measure_plan *plan, const measure_fits *fits, scree_error *error)
{
    char path[PATH_MAX];
    base_chart base;
    scree_status status = scree_path_join(path, sizeof path, folder, file, error);
    if (!status) status = open_base(fits, &base, error);
    if (status || base.places == 0) return status;
    for (size_t k = 0; k < fits->count && !status; k++)
        if (fits->solved[k]) status = take_theory(fits, k, component, &base, error);
    if (!status) take_piles(fits, component, &base);
    const scree_chart chart = {.title = "Lowest cut and the fitted theories",
                               .x_label = place_label(plan),
                               .y_label = label,
                               .line = base.line,
                               .line_count = base.lines};
    if (!status) status = scree_chart_draw(path, &chart, error);
    scree_release(&base.number);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

/// Where the rows of each cut that has some begin; behind the last one the number of rows. Returns how many have.
static size_t find_cuts(const measure_fits *fits, size_t begin[SCREE_AVERAGE_CUTS + 1])
{
    size_t cuts = 0;
    for (size_t i = 0; i < fits->rows; i++)
        if (i == 0 || fits->row[i - 1].cut != fits->row[i].cut) begin[cuts++] = i;
    begin[cuts] = fits->rows;
    return cuts;
}

static scree_status draw_yielding(const char *folder, const measure_plan *plan, const measure_fits *fits,
                                  scree_error *error)
{
    char path[PATH_MAX], title[120], label[MEASURE_LINES][32];
    double *number = NULL;
    size_t begin[SCREE_AVERAGE_CUTS + 1];
    const size_t cuts = find_cuts(fits, begin), lines = cuts < MEASURE_LINES ? cuts : MEASURE_LINES;
    scree_chart_line line[MEASURE_LINES] = {{0}};
    scree_status status = scree_path_join(path, sizeof path, folder, "mohr-coulomb", error);
    if (!status) status = scree_allocate(&number, 2 * fits->rows, sizeof *number, error);
    if (status) return status;
    for (size_t i = 0; i < fits->rows; i++) {
        number[i] = 1e3 * fits->row[i].point.x;
        number[fits->rows + i] = measure_fit_yielding(fits, &fits->row[i].point);
    }
    for (size_t k = 0; k < lines; k++) {
        const size_t which = measure_spread(cuts, k), i = begin[which];
        (void)snprintf(label[k], sizeof label[k], "height %.2g", plan->average.height[fits->row[i].cut]);
        line[k] = (scree_chart_line){.x = number + i,
                                     .y = number + fits->rows + i,
                                     .count = begin[which + 1] - i,
                                     .label = label[k],
                                     .points = begin[which + 1] - i < 3,
                                     .bare = begin[which + 1] - i == 1};
    }
    measure_title(title, sizeof title, "Mohr-Coulomb expression by height: 0 where the pile yields", cuts);
    const scree_chart chart = {.title = title,
                               .x_label = place_label(plan),
                               .y_label = "((xx - yy)^2 + 4 xy^2) / ((xx + yy)^2 sin^2 slope) - 1",
                               .line = line,
                               .line_count = lines};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&number);
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

scree_status measure_fit_draw(const char *folder, const measure_plan *plan, const measure_fits *fits,
                              scree_error *error)
{
    scree_status status = draw_component(folder, "fits-vertical", "vertical pressure (kPa)", 1, plan, fits, error);
    if (!status) status = draw_component(folder, "fits-horizontal", "horizontal pressure (kPa)", 0, plan, fits, error);
    if (!status) status = draw_component(folder, "fits-shear", "shear stress (kPa)", 2, plan, fits, error);
    return status ? status : draw_yielding(folder, plan, fits, error);
}
