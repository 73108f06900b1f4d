/// The outer surface from the points near the outside alone: the counterpart of outer_loop.c in three dimensions.
///
/// The peeling looks at tetrahedra that have or had an outer face, and at which points and edges are on the surface,
/// nothing else. A tetrahedron of the band belongs to the Delaunay triangulation of ALL points when no left-out point
/// lies in its circumsphere (Delaunay 1934); that is checked for every one that the peeling looked at, and if one
/// fails, all points are triangulated after all. Where points are cospherical the tetrahedra, which are not unique, may
/// differ from those of the whole. Cost: O(n) for the band, O(b log b) for the b bodies in it, O(cells in its box) for
/// each sphere along the surface.
#include "base/vectors.h"
#include "search/band.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#include <math.h>

/// Centre and radius of the sphere through the corners; an infinite radius when they are flat to round-off.
static double circumsphere(const double *points, const uint32_t vertex[4], double centre[3])
{
    double edge[3][3], square[3], longest = 0;
    const double *o = points + 3 * (size_t)vertex[0];
    for (int i = 0; i < 3; i++) {
        const double *p = points + 3 * (size_t)vertex[i + 1];
        scree_subtract(p, o, edge[i]);
        square[i] = scree_dot(edge[i], edge[i]);
        longest = fmax(longest, square[i]);
    }
    // Cramer's rule on edge . c = square / 2: c is the sum of the squares times the products of the other two edges.
    double product[3][3], offset[3] = {0};
    for (int i = 0; i < 3; i++) {
        const double *u = edge[(i + 1) % 3], *v = edge[(i + 2) % 3];
        scree_cross(u, v, product[i]);
        for (int k = 0; k < 3; k++) offset[k] += square[i] * product[i][k];
    }
    double twice = 2 * scree_dot(edge[0], product[0]), sum = 0;
    if (!(twice > 1e-9 * longest * sqrt(longest))) return INFINITY;
    for (int k = 0; k < 3; k++) {
        centre[k] = o[k] + offset[k] / twice;
        sum += offset[k] / twice * (offset[k] / twice);
    }
    return sqrt(sum);
}

/// No sphere along the surface holds a left-out point. A flat tetrahedron on the convex hull, which the band shares
/// with the whole, has the empty half-space outside as its sphere; one inside does not say what its sphere is.
static bool is_certain(const scree_band *b, const double *points, size_t count, const scree_tetrahedra *tetrahedra,
                       const uint8_t *marks)
{
    for (size_t t = 0; t < tetrahedra->count; t++) {
        if (marks[t] == SCREE_TRIANGLE_INSIDE) continue;
        double centre[3], radius = circumsphere(b->points, tetrahedra->vertex[t], centre);
        if (!isinf(radius) && scree_band_leaves_out(b, points, count, centre, radius)) return false;
    }
    return true;
}

/// The surface of the whole from the band, in indices of the whole; *certain false (and no surface) when it may be
/// another one.
static scree_status surface_of_band(const scree_band *b, const double *points, size_t count, double gap_limit,
                                    scree_triangle_surface *surface, bool *certain, scree_error *error)
{
    scree_tetrahedra tetrahedra;
    uint8_t *marks = NULL;
    scree_status status = scree_tetrahedra_build(b->points, b->count, &tetrahedra, error);
    if (!status) status = scree_allocate(&marks, tetrahedra.count, sizeof *marks, error);
    if (!status)
        status = scree_boundary_surface(&tetrahedra, b->points, b->radius, b->count, gap_limit, surface, marks, error);
    *certain = !status && is_certain(b, points, count, &tetrahedra, marks);
    for (size_t t = 0; t < surface->count; t++)
        for (int k = 0; k < 3; k++) surface->triangle[t][k] = b->index[surface->triangle[t][k]];
    if (!*certain) scree_triangle_surface_destroy(surface);
    scree_release(&marks);
    scree_tetrahedra_destroy(&tetrahedra);
    return status;
}

static scree_status surface_of_all(const double *points, const double *radius, size_t count, double gap_limit,
                                   scree_triangle_surface *surface, scree_error *error)
{
    scree_tetrahedra tetrahedra;
    scree_status status = scree_tetrahedra_build(points, count, &tetrahedra, error);
    if (!status) status = scree_boundary_surface(&tetrahedra, points, radius, count, gap_limit, surface, NULL, error);
    scree_tetrahedra_destroy(&tetrahedra);
    return status;
}

scree_status scree_outer_surface(const double *points, const double *radius, size_t count, double spacing,
                                 double gap_limit, scree_triangle_surface *surface, scree_error *error)
{
    *surface = (scree_triangle_surface){0};
    scree_band b;
    bool certain = false;
    scree_status status = scree_band_build(points, radius, count, 3, spacing, &b, error);
    // A band of nearly all bodies saves nothing.
    bool pays = b.count >= 4 && 5 * b.count < 4 * count;
    if (!status && pays) status = surface_of_band(&b, points, count, gap_limit, surface, &certain, error);
    scree_band_destroy(&b);
    if (status || certain) return status;
    return surface_of_all(points, radius, count, gap_limit, surface, error);
}
