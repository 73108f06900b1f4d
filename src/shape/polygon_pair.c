/// What is rare when two polygons are compared: one inside the other, a new separating edge, two centres in one place.
#include "shape/polygon_pair.h"

#include <string.h>

int scree_polygon_compare(const scree_polygon *first, const scree_polygon *second)
{
    if (first->count != second->count) return first->count - second->count;
    for (int k = 0; k < first->count; k++)
        for (int i = 0; i < 2; i++)
            if (first->corner[k][i] != second->corner[k][i]) return first->corner[k][i] > second->corner[k][i] ? 1 : -1;
    return 0;
}

bool scree_polygon_same(const scree_polygon *polygon, scree_overlap *overlap)
{
    *overlap = (scree_overlap){.area = scree_polygon_area(polygon->count, polygon->corner),
                               .flags = SCREE_OVERLAP_INSIDE | SCREE_OVERLAP_NEAR_CENTRE};
    return true;
}

/// Whether the outline of one body, of which no edge crosses that of the other, lies inside it: one corner tells.
static bool lies_inside(const scree_polygon_pair *pair, int inner)
{
    int outer = 1 - inner;
    const double *c = pair->corner[inner][0];
    for (int k = 0; k < pair->count[outer]; k++) {
        const double *a = pair->corner[outer][k], *b = pair->corner[outer][scree_next_corner(pair->count[outer], k)];
        // What is not a number lies on no side.
        if (!isnan(scree_side(a, b, c)) && !scree_is_left(a, b, c, outer == 1)) return false;
    }
    return true;
}

double scree_polygon_gap(const scree_polygon_pair *pair, int body, int edge)
{
    const double *a = pair->corner[body][edge];
    const double *b = pair->corner[body][scree_next_corner(pair->count[body], edge)];
    double u[2] = {b[0] - a[0], b[1] - a[1]}, nearest = INFINITY;
    for (int k = 0; k < pair->count[1 - body]; k++) {
        const double *c = pair->corner[1 - body][k];
        nearest = fmin(nearest, (c[0] - a[0]) * u[1] - (c[1] - a[1]) * u[0]);
    }
    return nearest / sqrt(u[0] * u[0] + u[1] * u[1]);
}

static int find_separating_edge(const scree_polygon_pair *pair)
{
    double widest = 0;
    int found = 0;
    for (int body = 0; body < 2; body++)
        for (int k = 0; k < pair->count[body]; k++) {
            double gap = scree_polygon_gap(pair, body, k);
            if (!(gap > widest) || !scree_edge_separates(pair, body, k)) continue;
            widest = gap;
            found = body == 0 ? k + 1 : -(k + 1);
        }
    return found;
}

bool scree_polygon_uncrossed(const scree_polygon_pair *pair, const double apart[2], int *hint, scree_overlap *overlap)
{
    for (int inner = 0; inner < 2; inner++) {
        if (!lies_inside(pair, inner)) continue;
        *overlap = (scree_overlap){.area = scree_polygon_area(pair->count[inner], pair->corner[inner]),
                                   .flags = SCREE_OVERLAP_INSIDE};
        if (inner == 1) memcpy(overlap->arm[0], apart, sizeof overlap->arm[0]);
        return true;
    }
    *hint = find_separating_edge(pair);
    return false;
}
