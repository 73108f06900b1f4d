/// The boundary loop from the points near the outside alone.
///
/// Only the band of points near the outside (band.h) is triangulated. The loop needs nothing else, and that is checked,
/// not assumed: the peeling looks at the triangles along the loop only, and a triangle of the band belongs to the
/// Delaunay triangulation of ALL points when no left-out point lies in its circumcircle (Delaunay 1934). Where
/// one does, the band is extended there and triangulated again; after a few rounds all points are. Where points are
/// cocircular the diagonals, which are not unique, may differ from those of the whole. Cost: O(n) for the band, O(b log
/// b) for the b bodies in it, O(cells in its box) for a circle along the loop.
#include "search/band.h"
#include "search/delaunay.h"

#include <math.h>

/// Centre and radius of the circle through three points; an infinite radius for a triangle that is flat to round-off.
static double circumcircle(const double *a, const double *b, const double *c, double centre[2])
{
    double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
    double uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1], twice = 2 * (u[0] * v[1] - u[1] * v[0]);
    if (!(twice > 1e-9 * (uu + vv))) return INFINITY;
    double x = (v[1] * uu - u[1] * vv) / twice, y = (u[0] * vv - v[0] * uu) / twice;
    centre[0] = a[0] + x;
    centre[1] = a[1] + y;
    return sqrt(x * x + y * y);
}

/// No circle of a triangle along the loop holds a left-out point. Flat triangles occur only on the hull, which the band
/// shares with the whole: their circle is the empty half-plane outside.
static bool is_certain(scree_band *b, const scree_triangulation *triangulation, const uint8_t *marks)
{
    bool certain = true;
    for (size_t t = 0; t < triangulation->count; t++) {
        if (marks[t] == SCREE_TRIANGLE_INSIDE) continue;
        const double *corner[3];
        for (int k = 0; k < 3; k++) corner[k] = b->points + 2 * (size_t)triangulation->vertex[t][k];
        double centre[2], radius = circumcircle(corner[0], corner[1], corner[2], centre);
        if (!isinf(radius) && scree_band_wants(b, corner, centre, radius)) certain = false;
    }
    return certain;
}

/// The loop of the whole from the band, in indices of the whole; *certain false (and no loop) when it may be another
/// one.
static scree_status loop_of_band(scree_band *b, const scree_peel_rule *rule, uint32_t **loop, size_t *loop_count,
                                 bool *certain, scree_error *error)
{
    scree_peel_rule of_band = *rule;
    of_band.index = b->index;
    scree_triangulation triangulation;
    uint8_t *marks = NULL;
    scree_status status = scree_triangulation_build(b->points, b->count, &triangulation, error);
    if (!status) status = scree_allocate(&marks, triangulation.count, sizeof *marks, error);
    if (!status)
        status = scree_boundary_loop(&triangulation, b->points, b->radius, b->count, &of_band, loop, loop_count, marks,
                                     error);
    *certain = !status && is_certain(b, &triangulation, marks);
    for (size_t k = 0; k < *loop_count; k++) (*loop)[k] = b->index[(*loop)[k]];
    if (!*certain) {
        scree_release(loop);
        *loop_count = 0;
    }
    scree_release(&marks);
    scree_triangulation_destroy(&triangulation);
    return status;
}

static scree_status loop_of_all(const double *points, const double *radius, size_t count, const scree_peel_rule *rule,
                                uint32_t **loop, size_t *loop_count, scree_error *error)
{
    scree_triangulation triangulation;
    scree_status status = scree_triangulation_build(points, count, &triangulation, error);
    if (!status)
        status = scree_boundary_loop(&triangulation, points, radius, count, rule, loop, loop_count, NULL, error);
    scree_triangulation_destroy(&triangulation);
    return status;
}

scree_status scree_outer_loop(const double *points, const double *radius, size_t count, double spacing,
                              const scree_peel_rule *rule, uint32_t **loop, size_t *loop_count, scree_error *error)
{
    *loop = NULL;
    *loop_count = 0;
    scree_band b;
    bool certain = false;
    scree_status status = scree_band_build(points, radius, count, 2, spacing, &b, error);
    while (!status && !certain && b.count > 0) {
        status = loop_of_band(&b, rule, loop, loop_count, &certain, error);
        if (!status && !certain) status = scree_band_extend(&b, error);
    }
    scree_band_destroy(&b);
    if (status || certain) return status;
    return loop_of_all(points, radius, count, rule, loop, loop_count, error);
}
