/// Area and displacement gradient of a closed polygon: see polygon.h for the formula and what is exact about it.
/// Cost: O(1) an edge.
#include "search/polygon.h"

void scree_polygon_add_edge(scree_polygon_sum *sum, const double a[2], const double ua[2], const double b[2],
                            const double ub[2])
{
    double start[2] = {a[0] + ua[0] / 2, a[1] + ua[1] / 2};
    double edge[2] = {b[0] + ub[0] / 2 - start[0], b[1] + ub[1] / 2 - start[1]};
    double mean[2] = {(ua[0] + ub[0]) / 2, (ua[1] + ub[1]) / 2};
    sum->area += (start[0] * edge[1] - start[1] * edge[0]) / 2;
    for (int i = 0; i < 2; i++) {
        sum->gradient[2 * i] += mean[i] * edge[1];
        sum->gradient[2 * i + 1] -= mean[i] * edge[0];
    }
}

void scree_polygon_finish(const scree_polygon_sum *sum, double gradient[4])
{
    for (int i = 0; i < 4; i++) gradient[i] = sum->area > 0 || sum->area < 0 ? sum->gradient[i] / sum->area : 0;
}

void scree_loop_gradient(const double *x, const double *y, const double *ux, const double *uy, size_t count,
                         double gradient[4])
{
    scree_polygon_sum sum = {0};
    for (size_t k = 0; k < count; k++) {
        size_t next = k + 1 < count ? k + 1 : 0;
        // Relative to the first vertex, so that the area loses no digits far from the origin.
        double a[2] = {x[k] - x[0], y[k] - y[0]}, b[2] = {x[next] - x[0], y[next] - y[0]};
        scree_polygon_add_edge(&sum, a, (double[2]){ux[k], uy[k]}, b, (double[2]){ux[next], uy[next]});
    }
    scree_polygon_finish(&sum, gradient);
}
