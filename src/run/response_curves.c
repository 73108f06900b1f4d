/// Response along cuts. See response_curves.h.
#include "run/response_curves.h"

#include "average/strain.h"

#include <math.h>

enum { FINER = 8 }; ///< points in the side of an element

/// Where a strain is looked up; none where there are too few grains for cells.
typedef struct strains {
    scree_average_bins bins;
    scree_average_strain strain;
} strains;

static scree_status open_strains(const scree_response *r, strains *s, scree_error *error)
{
    *s = (strains){0};
    scree_status status =
        scree_average_bins_make(r->after, fmax(2 * r->after->mean_radius, r->side / 4), &s->bins, error);
    if (!status) status = scree_average_strain_open(r->after, &s->bins, &s->strain, error);
    if (status) scree_average_bins_destroy(&s->bins);
    return status;
}

static double vertical_strain(const strains *s, const scree_average_element *element)
{
    scree_vector displacement;
    double gradient[SCREE_AVERAGE_STRAINS][9];
    scree_average_strain_find(&s->strain, element, displacement, gradient);
    return -gradient[SCREE_AVERAGE_BAGI][4];
}

/// Means over the same elements.
static scree_status add_theories(const scree_response *r, double poisson, double thickness, double x, size_t point,
                                 scree_response_level *level, scree_error *error)
{
    static const scree_layer_base base[3] = {SCREE_LAYER_NONE, SCREE_LAYER_SMOOTH, SCREE_LAYER_BONDED};
    scree_layer layer = {.force = r->force / r->after->thickness, .thickness = thickness, .poisson = poisson};
    scree_status status = SCREE_OK;
    for (int k = 0; k < 3 && !status; k++) {
        scree_stress_2d mean;
        layer.base = base[k];
        status = scree_layer_mean(&layer, x, level->depth, r->side, &mean, error);
        level->value[SCREE_RESPONSE_HALF_SPACE + k][point] = mean.yy;
        level->value[SCREE_RESPONSE_HALF_SPACE_HORIZONTAL + k][point] = mean.xx;
    }
    return status;
}

static scree_status fill_point(const scree_response *r, const strains *s, double depth, double x, size_t point,
                               scree_response_level *level)
{
    double both[2][3], strain = 0;
    for (int side = 0; side < 2; side++) {
        const double at = side ? x : -x;
        const scree_average_element element = scree_response_element(r, depth, at);
        scree_response_at(r, depth, at, both[side]);
        strain += 0.5 * vertical_strain(s, &element);
    }
    level->left[point] = both[0][1];
    level->right[point] = both[1][1];
    level->value[SCREE_RESPONSE_VERTICAL][point] = 0.5 * (both[0][1] + both[1][1]);
    level->value[SCREE_RESPONSE_HORIZONTAL][point] = 0.5 * (both[0][0] + both[1][0]);
    level->value[SCREE_RESPONSE_STRAIN][point] = strain;
    return SCREE_OK;
}

/// Mean over places from `low` to `high` [m]; NAN without one.
static double mean_between(const double *value, const scree_response_curves *curves, double low, double high)
{
    double sum = 0, count = 0;
    for (size_t k = 0; k < curves->count; k++) {
        const double x = curves->gap * (double)k, weight = k == 0 ? 0.5 : 1;
        if (x < low * (1 - 1e-12) || x > high * (1 + 1e-12)) continue;
        sum += weight * value[k];
        count += weight;
    }
    return sum / count;
}

/// Distance within which half of the integral lies, by trapezoids.
static double half_of(const double *value, const scree_response_curves *curves)
{
    double whole = 0, part = 0;
    for (size_t k = 1; k < curves->count; k++) whole += 0.5 * (value[k - 1] + value[k]);
    for (size_t k = 1; k < curves->count; k++) {
        const double piece = 0.5 * (value[k - 1] + value[k]);
        if (part + piece >= 0.5 * whole) return curves->gap * ((double)k - 1 + (0.5 * whole - part) / piece);
        part += piece;
    }
    return NAN;
}

static scree_status fill_level(const scree_response *r, const strains *s, double poisson, double depth,
                               scree_response_curves *curves, scree_response_level *level, scree_error *error)
{
    const scree_average_element middle = scree_response_element(r, depth, 0);
    scree_status status = SCREE_OK;
    level->depth = r->top - 0.5 * (middle.low[1] + middle.high[1]);
    level->missing = scree_response_missing(r, depth);
    for (size_t k = 0; k < curves->count && !status; k++) {
        const double x = curves->gap * (double)k;
        status = fill_point(r, s, depth, x, k, level);
        if (!status) status = add_theories(r, poisson, curves->thickness, x, k, level, error);
    }
    for (int c = 0; c < SCREE_RESPONSE_CURVES; c++) {
        level->peak[c] = scree_response_find_peak(level->value[c], curves->count, curves->gap);
        level->centre[c] = mean_between(level->value[c], curves, 0, 0.2 * level->depth);
    }
    const double *vertical = level->value[SCREE_RESPONSE_VERTICAL];
    level->beside = mean_between(vertical, curves, 0.4 * level->depth, 0.8 * level->depth);
    level->reach = half_of(vertical, curves);
    return status;
}

scree_status scree_response_curves_find(const scree_response *r, double poisson, scree_response_curves *curves,
                                        scree_error *error)
{
    const double reach = fmin(r->x - r->left, r->right - r->x);
    strains s;
    curves->thickness = r->top - r->base;
    curves->gap = fmax(r->side / FINER, reach / (SCREE_RESPONSE_POINTS - 1));
    curves->count = 1 + (size_t)(reach / curves->gap * (1 + 1e-12));
    scree_status status = open_strains(r, &s, error);
    if (status) return status;
    for (int k = 0; k < SCREE_RESPONSE_LEVELS && !status; k++)
        status = fill_level(r, &s, poisson, curves->thickness * (k + 1) / SCREE_RESPONSE_LEVELS, curves,
                            &curves->level[k], error);
    scree_average_strain_close(&s.strain);
    scree_average_bins_destroy(&s.bins);
    return status;
}

double scree_response_widening(const scree_response_curves *curves)
{
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int k = 1; k < SCREE_RESPONSE_LEVELS; k++) {
        const scree_response_level *level = &curves->level[k];
        if (!(level->reach > 0)) continue;
        const double along = log(level->depth), up = log(level->reach);
        count++, x += along, y += up, xx += along * along, xy += along * up;
    }
    return count < 3 ? (double)NAN : (count * xy - x * y) / (count * xx - x * x);
}

double scree_response_misfit(const scree_response_curves *curves, scree_response_curve theory)
{
    const scree_response_level *level = &curves->level[SCREE_RESPONSE_LEVELS - 1];
    const double *measured = level->value[theory < SCREE_RESPONSE_HALF_SPACE_HORIZONTAL ? SCREE_RESPONSE_VERTICAL
                                                                                        : SCREE_RESPONSE_HORIZONTAL];
    double sum = 0, count = 0;
    for (size_t k = 0; k < curves->count && curves->gap * (double)k <= curves->thickness; k++) {
        const double difference = measured[k] - level->value[theory][k];
        sum += (k == 0 ? 1 : 2) * difference * difference;
        count += k == 0 ? 1 : 2;
    }
    return sqrt(sum / count) / level->peak[theory].most;
}
