/// Area and displacement gradient of a closed polygon: see polygon.h for the formula and what is exact about it.
/// Cost: O(1) an edge.
#include "measure/polygon.h"

void scree_polygon_add_edge(scree_polygon_sum *sum, const double a[2], const double ua[2], const double b[2],
                            const double ub[2])
{
    double start[2] = {a[0] + ua[0] / 2, a[1] + ua[1] / 2};
    double edge[2] = {b[0] + ub[0] / 2 - start[0], b[1] + ub[1] / 2 - start[1]};
    double mean[2] = {(ua[0] + ub[0]) / 2, (ua[1] + ub[1]) / 2};
    scree_integer_sum_add(&sum->area, (start[0] * edge[1] - start[1] * edge[0]) / 2);
    for (int i = 0; i < 2; i++) {
        scree_integer_sum_add(&sum->gradient[2 * i], mean[i] * edge[1]);
        scree_integer_sum_add(&sum->gradient[2 * i + 1], -mean[i] * edge[0]);
    }
}

void scree_polygon_finish(const scree_polygon_sum *sum, double gradient[4])
{
    double area = scree_integer_sum_total(&sum->area);
    for (int i = 0; i < 4; i++)
        gradient[i] = area > 0 || area < 0 ? scree_integer_sum_total(&sum->gradient[i]) / area : 0;
}
