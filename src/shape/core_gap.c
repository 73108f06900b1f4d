/// Least distance of two cores, corner by corner.
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
