/// The outer surface from the points near the outside alone: the counterpart of outer_loop.c in three dimensions.
///
/// The peeling looks at tetrahedra that have or had an outer face, and at which points and edges are on the surface,
/// nothing else. A tetrahedron of the band belongs to the Delaunay triangulation of ALL points when no left-out point
/// lies in its circumsphere (Delaunay 1934); that is checked for every one that the peeling looked at. Where one
/// fails, the band is extended there and triangulated again; after a few rounds all points are. Where points are
/// cospherical the tetrahedra, which are not unique, may differ from those of the whole. Cost: O(n) for the band, O(b
/// log b) for the b bodies in it, O(cells in its box) for each sphere along the surface.
#include "base/vectors.h"
#include "search/band.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#include <math.h>

/// Centre and radius of the sphere through the corners; an infinite radius when they are flat to round-off.
static double circumsphere(const double *const corner[4], double centre[3])
{
    double edge[3][3], square[3], longest = 0;
    const double *o = corner[0];
    for (int i = 0; i < 3; i++) {
        scree_subtract(corner[i + 1], o, edge[i]);
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
static bool is_certain(scree_band *b, const scree_tetrahedra *tetrahedra, const uint8_t *marks)
{
    bool certain = true;
    for (size_t t = 0; t < tetrahedra->count; t++) {
        if (marks[t] == SCREE_TRIANGLE_INSIDE) continue;
        const double *corner[4];
        for (int k = 0; k < 4; k++) corner[k] = b->points + 3 * (size_t)tetrahedra->vertex[t][k];
        double centre[3], radius = circumsphere(corner, centre);
        if (!isinf(radius) && scree_band_wants(b, corner, centre, radius)) certain = false;
    }
    return certain;
}

/// The surface of the whole from the band, in indices of the whole; *certain false (and no surface) when it may be
/// another one.
static scree_status surface_of_band(scree_band *b, const scree_peel_rule *rule, scree_triangle_surface *surface,
                                    bool *certain, scree_error *error)
{
    scree_peel_rule of_band = *rule;
    of_band.index = b->index;
    scree_tetrahedra tetrahedra;
    uint8_t *marks = NULL;
    scree_status status = scree_tetrahedra_build(b->points, b->count, &tetrahedra, error);
    if (!status) status = scree_allocate(&marks, tetrahedra.count, sizeof *marks, error);
    if (!status)
        status = scree_boundary_surface(&tetrahedra, b->points, b->radius, b->count, &of_band, surface, marks, error);
    *certain = !status && is_certain(b, &tetrahedra, marks);
    for (size_t t = 0; t < surface->count; t++)
        for (int k = 0; k < 3; k++) surface->triangle[t][k] = b->index[surface->triangle[t][k]];
    if (!*certain) scree_triangle_surface_destroy(surface);
    scree_release(&marks);
    scree_tetrahedra_destroy(&tetrahedra);
    return status;
}

static scree_status surface_of_all(const double *points, const double *radius, size_t count,
                                   const scree_peel_rule *rule, scree_triangle_surface *surface, scree_error *error)
{
    scree_tetrahedra tetrahedra;
    scree_status status = scree_tetrahedra_build(points, count, &tetrahedra, error);
    if (!status) status = scree_boundary_surface(&tetrahedra, points, radius, count, rule, surface, NULL, error);
    scree_tetrahedra_destroy(&tetrahedra);
    return status;
}

scree_status scree_outer_surface(const double *points, const double *radius, size_t count, double spacing,
                                 const scree_peel_rule *rule, scree_triangle_surface *surface, scree_error *error)
{
    *surface = (scree_triangle_surface){0};
    scree_band b;
    bool certain = false;
    scree_status status = scree_band_build(points, radius, count, 3, spacing, &b, error);
    while (!status && !certain && b.count > 0) {
        status = surface_of_band(&b, rule, surface, &certain, error);
        if (!status && !certain) status = scree_band_extend(&b, error);
    }
    scree_band_destroy(&b);
    if (status || certain) return status;
    return surface_of_all(points, radius, count, rule, surface, error);
}
