/// Least distance of two cores, corner by corner, and the shortest way out of each other, edge by edge.
#include "shape/core_gap.h"

/// Squared distance of the nearest corner of one core from the other, whose centre is `apart` from that of the first.
/// 0: a corner lies in it.
static double nearest_corner(const scree_core *one, const scree_core *other, const double apart[2])
{
    double least = INFINITY, point[2];
    int edge;
    for (int k = 0; k < (one->count > 0 ? one->count : 1); k++) {
        const double x = one->count > 0 ? one->corner[k][0] : 0, y = one->count > 0 ? one->corner[k][1] : 0;
        const double place[2] = {x - apart[0], y - apart[1]};
        least = fmin(least, scree_core_closest(other, place, INFINITY, point, &edge));
    }
    return least;
}

double scree_core_gap(const scree_core *first, const scree_core *second, const double apart[2])
{
    const double back[2] = {-apart[0], -apart[1]};
    const scree_core pair[2] = {*first, *second};
    if (first->count == 0 && second->count == 0) return hypot(apart[0], apart[1]) - first->rounding - second->rounding;
    const double square = fmin(nearest_corner(first, second, apart), nearest_corner(second, first, back));
    // Two bars may cross with all corners outside.
    const bool meet = !(square > 0) || scree_cores_cross(pair, apart);
    return (meet ? 0 : sqrt(square)) - (first->rounding + second->rounding);
}

/// Shortest way across an edge of `one` that brings `other`, whose centre is `apart` from that of `one`, out of it.
static double way_across(const scree_core *one, const scree_core *other, const double apart[2])
{
    double least = INFINITY;
    for (int k = 0, last = one->count - 1; k < one->count; last = k++) {
        const double *a = one->corner[last], *b = one->corner[k], length = hypot(b[0] - a[0], b[1] - a[1]);
        const double outward[2] = {(b[1] - a[1]) / length, (a[0] - b[0]) / length};
        const double back[2] = {-outward[0], -outward[1]};
        const double from = (a[0] - apart[0]) * outward[0] + (a[1] - apart[1]) * outward[1];
        least = fmin(least, from + scree_core_support(other, back));
    }
    return least;
}

double scree_core_depth(const scree_core *first, const scree_core *second, const double apart[2])
{
    const double back[2] = {-apart[0], -apart[1]}, gap = scree_core_gap(first, second, apart);
    const double reach = first->rounding + second->rounding;
    if (gap > -reach || (first->count == 0 && second->count == 0)) return -gap;
    return fmin(way_across(first, second, apart), way_across(second, first, back)) + reach;
}

/// Distance of a point from the outline of a core, negative inside.
static double beyond(const scree_core *core, const double p[2])
{
    double point[2], inside = -INFINITY;
    int edge;
    const double square = scree_core_closest(core, p, INFINITY, point, &edge);
    if (square > 0 || core->count == 0) return sqrt(square);
    for (int k = 0, last = core->count - 1; k < core->count; last = k++) {
        const double *a = core->corner[last], *b = core->corner[k];
        const double along[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {p[0] - a[0], p[1] - a[1]};
        inside = fmax(inside, -(along[0] * from[1] - along[1] * from[0]) / hypot(along[0], along[1]));
    }
    return inside;
}

bool scree_core_lies_within(const scree_core *first, const scree_core *second, const double apart[2])
{
    bool within = true;
    for (int k = 0; k < (first->count > 0 ? first->count : 1); k++) {
        const double x = first->count > 0 ? first->corner[k][0] : 0, y = first->count > 0 ? first->corner[k][1] : 0;
        const double place[2] = {x - apart[0], y - apart[1]};
        within = within && beyond(second, place) + first->rounding <= second->rounding;
    }
    return within;
}
