/// Around the orthocentre of a regular simplex, the point y with the same power |y - x|^2 - r^2 to all its corners, no
/// body is nearer than they are (Edelsbrunner 1987): the largest power is the widest hole. From the first corner on,
/// with e the edges to the others,
///     2 e . y = |e|^2 - r^2 + r_0^2,     by Cramer's rule.
/// Cost: some 50 products a simplex.
#include "prepare/gap_hole.h"

#include <math.h>
#include <stdbool.h>

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Rows of edges and their right sides; a third row in the plane that asks for nothing.
static bool solve(double edge[3][3], const double right[3], double y[3])
{
    double column[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) column[k][i] = edge[i][k];
    const double whole = determinant(column[0], column[1], column[2]);
    y[0] = determinant(right, column[1], column[2]) / whole;
    y[1] = determinant(column[0], right, column[2]) / whole;
    y[2] = determinant(column[0], column[1], right) / whole;
    return isfinite(y[0]) && isfinite(y[1]) && isfinite(y[2]);
}

scree_gap_hole scree_gap_hole_find(const scree_simplices *simplices, const double *points, const double *radius,
                                   int dimension, const double side[3])
{
    const size_t d = (size_t)dimension;
    scree_gap_hole widest = {.power = -INFINITY};
    for (size_t s = 0; s < simplices->count; s++) {
        const uint32_t *vertex = simplices->vertex + s * (d + 1);
        const double *origin = points + vertex[0] * d, own = radius[vertex[0]] * radius[vertex[0]];
        double edge[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, right[3] = {0}, y[3], power = -own;
        for (size_t i = 0; i < d; i++) {
            right[i] = own - radius[vertex[i + 1]] * radius[vertex[i + 1]];
            for (size_t k = 0; k < d; k++) {
                edge[i][k] = points[vertex[i + 1] * d + k] - origin[k];
                right[i] += edge[i][k] * edge[i][k];
            }
            right[i] /= 2;
        }
        bool within = solve(edge, right, y);
        for (size_t k = 0; k < d; k++) {
            power += y[k] * y[k];
            y[k] += origin[k];
            within = within && y[k] > 0 && y[k] < side[k];
        }
        if (!within || power <= widest.power) continue;
        widest.power = power;
        for (size_t k = 0; k < d; k++) widest.centre[k] = y[k];
    }
    return widest;
}
