/// Around the orthocentre of a regular simplex, the point y with the same power |y - x|^2 - r^2 to all its corners, no
/// body is nearer than they are (Edelsbrunner 1987): the largest power is the widest hole. From the first corner on,
/// with e the edges to the others,
///     2 e . y = |e|^2 - r^2 + r_0^2.
/// Cost: some 50 products a simplex.
#include "prepare/gap_hole.h"

#include "base/matrix.h"

#include <math.h>
#include <stdbool.h>

scree_gap_hole scree_gap_hole_find(const scree_simplices *simplices, const double *points, const double *radius,
                                   int dimension, const double side[3])
{
    const size_t d = (size_t)dimension;
    scree_gap_hole widest = {.power = -INFINITY};
    for (size_t s = 0; s < simplices->count; s++) {
        const uint32_t *vertex = simplices->vertex + s * (d + 1);
        const double *origin = points + vertex[0] * d, own = radius[vertex[0]] * radius[vertex[0]];
        double edge[9], inverse[9], right[3] = {0}, y[3], power = -own; // in the plane a third row asks for nothing
        bool within = true;
        scree_matrix_unit(edge);
        for (size_t i = 0; i < d; i++) {
            right[i] = own - radius[vertex[i + 1]] * radius[vertex[i + 1]];
            for (size_t k = 0; k < d; k++) {
                edge[3 * i + k] = points[vertex[i + 1] * d + k] - origin[k];
                right[i] += edge[3 * i + k] * edge[3 * i + k];
            }
            right[i] /= 2;
        }
        scree_matrix_invert(edge, inverse);
        scree_matrix_apply(inverse, right, y);
        for (size_t k = 0; k < d; k++) {
            power += y[k] * y[k];
            y[k] += origin[k];
            within = within && y[k] > 0 && y[k] < side[k]; // a flat simplex has no such point
        }
        if (!within || power <= widest.power) continue;
        widest.power = power;
        for (size_t k = 0; k < d; k++) widest.centre[k] = y[k];
    }
    return widest;
}
