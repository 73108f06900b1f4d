/// Elements of growing size.
#include "average/sizes.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define HEIGHT  0.33 /* of the place over the height of the sample */
#define MOST    0.66 /* largest side over it, and over the widths */
#define SETTLED 0.1  /* change of what has settled */

const char *const scree_average_sized_names[SCREE_AVERAGE_SIZED] = {"stress", "strain", "fabric"};

/// Columns of the tables that belong to them.
static const char *const column_names[SCREE_AVERAGE_SIZED] = {"stress", "cundall", "fabric"};

enum { FIRST = 5, STEPS = 18, ENOUGH = 200 }; ///< the series begins with 5 grains; exponents are up to 200

// ---- one sample --------------------------------------------------------------------------------------------------

static double side_of(const scree_average_view *view, double grains)
{
    const double room = view->surface.volume / (double)view->sample->counted;
    return pow(grains * room, 1.0 / view->sample->dimension);
}

static bool fits(const scree_average_view *view, double side)
{
    const scree_average_frame *f = &view->frame;
    const double depth = view->sample->dimension == 3 ? f->high[1] - f->low[1] : INFINITY;
    return side <= MOST * fmin(f->height, fmin(2 * f->half, depth));
}

static void centre_of(const scree_average_view *view, scree_vector centre)
{
    const int up = view->sample->dimension - 1;
    centre[0] = view->frame.axis;
    centre[1] = view->frame.middle;
    centre[2] = 0;
    centre[up] = view->frame.base + HEIGHT * view->frame.height;
}

typedef struct sizing {
    const scree_average_view *view;
    const scree_average_plan *plan;
} sizing;

static void place(void *user, size_t k, scree_vector centre, double *side, scree_average_table *table)
{
    const sizing *s = user;
    *side = side_of(s->view, s->plan->size[k]);
    centre_of(s->view, centre);
    if (!table) return;
    scree_average_table_take(table, "size", "1", s->plan->size[k]);
    scree_average_table_take(table, "side", "m", *side);
}

scree_status scree_average_sizes_table(const scree_average_view *view, const scree_average_plan *plan,
                                       scree_average_table *table, scree_error *error)
{
    sizing s = {view, plan};
    scree_status status = scree_average_elements_table(view, plan, plan->sizes, place, &s, table, error);
    for (size_t row = 0; row < table->rows && !status; row++)
        for (size_t k = 2; k < table->columns && !fits(view, scree_average_table_get(table, row, 1)); k++)
            table->value[row * table->columns + k] = NAN;
    return status;
}

/// A tensor over an element of so many grains; false: it does not fit.
static bool find_tensor(const scree_average_view *view, double grains, scree_average_sized which, double tensor[9])
{
    const int d = view->sample->dimension;
    const double side = side_of(view, grains);
    scree_vector centre, displacement;
    scree_average_value value;
    double gradient[SCREE_AVERAGE_STRAINS][9];
    if (!fits(view, side) || (which == SCREE_AVERAGE_SIZED_STRAIN && !view->moved)) return false;
    centre_of(view, centre);
    const scree_average_element element =
        scree_average_element_at(centre, (scree_vector){side, side, d == 3 ? side : 0});
    if (which == SCREE_AVERAGE_SIZED_STRAIN) {
        scree_average_strain_find(&view->strain, &element, displacement, gradient);
        memcpy(tensor, gradient[SCREE_AVERAGE_CUNDALL], 9 * sizeof *tensor);
        return true;
    }
    scree_average_measure(view->sample, &view->bins, &view->surface, &element, &value);
    const double *sum = which == SCREE_AVERAGE_SIZED_STRESS ? value.centres.moment : value.centres.branches;
    for (int k = 0; k < 9; k++) tensor[k] = sum[k] / value.volume;
    return true;
}

/// |a - b| / |b|
static double change(const double a[9], const double b[9])
{
    double apart = 0, whole = 0;
    for (int k = 0; k < 9; k++) {
        apart += (a[k] - b[k]) * (a[k] - b[k]);
        whole += b[k] * b[k];
    }
    return sqrt(apart / whole);
}

/// Between two sizes; NAN where one does not fit.
static double change_between(const scree_average_view *view, scree_average_sized which, double from, double to)
{
    double a[9], b[9];
    return find_tensor(view, from, which, a) && find_tensor(view, to, which, b) ? change(a, b) : NAN;
}

static double find_settled(const scree_average_view *view, scree_average_sized which)
{
    double last[9], tensor[9];
    int steps = 0;
    while (steps < STEPS && find_tensor(view, FIRST * pow(2, 0.5 * steps), which, last)) steps++;
    if (steps < 3) return NAN;
    int k = steps - 1;
    while (k > 0 && find_tensor(view, FIRST * pow(2, 0.5 * (k - 1)), which, tensor) && change(tensor, last) <= SETTLED)
        k--;
    return FIRST * pow(2, 0.5 * k);
}

void scree_average_sizes_tell(const scree_average_view *view, scree_average_sink *sink, void *user)
{
    char name[48];
    for (scree_average_sized k = 0; k < SCREE_AVERAGE_SIZED; k++) {
        (void)snprintf(name, sizeof name, "rve_%s_small", scree_average_sized_names[k]);
        sink(user, name, "1", change_between(view, k, 10, 20));
        (void)snprintf(name, sizeof name, "rve_%s_large", scree_average_sized_names[k]);
        sink(user, name, "1", change_between(view, k, 100, 200));
        (void)snprintf(name, sizeof name, "rve_%s_grains", scree_average_sized_names[k]);
        sink(user, name, "1", find_settled(view, k));
    }
}

// ---- several samples ---------------------------------------------------------------------------------------------

/// Variance over the samples but one (SIZE_MAX: all) of the components of a tensor in a row, over the square of its
/// mean; NAN where there are fewer than two.
static double relative_variance(const scree_average_table *sizes, size_t count, size_t without, size_t row, int which)
{
    double variance = 0, square = 0;
    for (int component = 0; component < 9; component++) {
        char name[48];
        (void)snprintf(name, sizeof name, "%s_%c%c", column_names[which], "xyz"[component / 3], "xyz"[component % 3]);
        const size_t column = scree_average_table_find(sizes, name);
        double sum = 0, squares = 0, n = 0;
        for (size_t i = 0; i < count && column != SIZE_MAX; i++) {
            const double value = scree_average_table_get(&sizes[i], row, column);
            if (i == without || !isfinite(value)) continue;
            // About the first sample: means are far larger than what they scatter by.
            const double apart = value - scree_average_table_get(&sizes[0], row, column);
            sum += apart;
            squares += apart * apart;
            n++;
        }
        if (column == SIZE_MAX) continue;
        if (n < 2) return NAN;
        const double mean = sum / n + scree_average_table_get(&sizes[0], row, column);
        variance += fmax(0, squares - sum * sum / n) / (n - 1);
        square += mean * mean;
    }
    return square > 0 ? variance / square : NAN;
}

scree_status scree_average_sizes_scatter(const scree_average_table *sizes, size_t count, scree_average_table *scatter,
                                         scree_error *error)
{
    const double n = (double)count;
    scree_status status = SCREE_OK;
    for (size_t row = 0; row < sizes->rows && !status; row++) {
        status = scree_average_table_begin_row(scatter, error);
        if (status) break;
        scree_average_table_take(scatter, "size", "1", scree_average_table_get(sizes, row, 0));
        for (int k = 0; k < SCREE_AVERAGE_SIZED; k++) {
            const double value = count < 3 ? NAN : sqrt(relative_variance(sizes, count, SIZE_MAX, row, k));
            char name[48];
            (void)snprintf(name, sizeof name, "%s_scatter", scree_average_sized_names[k]);
            scree_average_table_take(scatter, name, "1", value);
            (void)snprintf(name, sizeof name, "%s_scatter_low", scree_average_sized_names[k]);
            scree_average_table_take(scatter, name, "1",
                                     count < 3 ? NAN : value * sqrt((n - 1) / gsl_cdf_chisq_Pinv(0.975, n - 1)));
            (void)snprintf(name, sizeof name, "%s_scatter_high", scree_average_sized_names[k]);
            scree_average_table_take(scatter, name, "1",
                                     count < 3 ? NAN : value * sqrt((n - 1) / gsl_cdf_chisq_Pinv(0.025, n - 1)));
        }
        status = scree_average_table_end_row(scatter, error);
    }
    return status;
}

/// Minus the slope of the logarithm of the variance over that of the size; NAN: fewer than three sizes.
static double slope(const scree_average_table *sizes, size_t count, size_t without, int which)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t row = 0; row < sizes->rows; row++) {
        const double size = scree_average_table_get(sizes, row, 0);
        const double a = log(size), b = log(relative_variance(sizes, count, without, row, which));
        if (size > ENOUGH || !isfinite(b)) continue;
        n++;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return n < 3 ? NAN : -(xy - x * y / n) / (xx - x * x / n);
}

void scree_average_sizes_exponent(const scree_average_table *sizes, size_t count, scree_average_sized tensor,
                                  double *exponent, double *low, double *high)
{
    const double n = (double)count;
    double sum = 0, squares = 0;
    *exponent = *low = *high = NAN;
    if (count < 3) return;
    *exponent = slope(sizes, count, SIZE_MAX, (int)tensor);
    for (size_t i = 0; i < count; i++) {
        const double without = slope(sizes, count, i, (int)tensor) - *exponent;
        sum += without;
        squares += without * without;
    }
    const double error = sqrt((n - 1) / n * fmax(0, squares - sum * sum / n));
    *low = *exponent - gsl_cdf_tdist_Pinv(0.975, n - 1) * error;
    *high = *exponent + gsl_cdf_tdist_Pinv(0.975, n - 1) * error;
}
