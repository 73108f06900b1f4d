/// Delaunay tetrahedra (through Qhull) and the outer surface of an assembly of spheres as ONE closed surface: the
/// counterpart of delaunay.h in three dimensions.
#ifndef SCREE_SEARCH_TETRAHEDRA_H
#define SCREE_SEARCH_TETRAHEDRA_H

#include "base/memory.h"
#include "search/peel_rule.h"

#include <stdbool.h>

/// Tetrahedra of point indices with positive volume (x1 - x0) . (x2 - x0) x (x3 - x0), but for flat ones, whose sign is
/// round-off; neighbours across the face opposite to each vertex (-1: outside).
typedef struct scree_tetrahedra {
    size_t count;
    uint32_t (*vertex)[4];
    int32_t (*neighbour)[4];
} scree_tetrahedra;

/// Vertices of the face opposite to vertex k, counter-clockwise seen from outside the tetrahedron.
extern const uint8_t scree_tetrahedron_face[4][3];

/// points: count x 3 [m]. Errors: memory; SCREE_ERROR_GUARD for fewer than four points, not a number, all in a plane,
/// two in one place. Every point is a corner of some tetrahedron. Tetrahedra come in ascending order; where points are
/// cospherical they depend on the order of the points, so give bodies in the order of their ids.
scree_status scree_tetrahedra_build(const double *points, size_t count, scree_tetrahedra *tetrahedra,
                                    scree_error *error) SCREE_MUST_USE;
void scree_tetrahedra_destroy(scree_tetrahedra *tetrahedra);

/// A closed surface of triangles of point indices, counter-clockwise seen from outside, each from its lowest index, in
/// ascending order.
typedef struct scree_triangle_surface {
    size_t count;
    uint32_t (*triangle)[3];
} scree_triangle_surface;

void scree_triangle_surface_destroy(scree_triangle_surface *surface);

/// Outer surface of the tetrahedra after cleaning: tetrahedra on the boundary whose outer face has a free gap above
/// the rule's limit, or which are slivers, are cut as long as the surface stays ONE closed surface without handles,
/// every edge of which belongs to two triangles, and no point falls out of it (boundary_surface.c). marks[t]:
/// scree_triangle_mark (delaunay.h) of tetrahedron t, may be NULL. Cost: O(n + h log h).
scree_status scree_boundary_surface(const scree_tetrahedra *tetrahedra, const double *points, const double *radius,
                                    size_t count, const scree_peel_rule *rule, scree_triangle_surface *surface,
                                    uint8_t *marks, scree_error *error) SCREE_MUST_USE;

/// The surface of scree_boundary_surface on the Delaunay tetrahedra of all points, found from those near the outside
/// alone where that provably gives the same (outer_surface.c). spacing: m, mean distance of neighbours; it steers the
/// cost, not the result. Errors: as scree_tetrahedra_build. Cost: O(n) plus the tetrahedra of the band.
scree_status scree_outer_surface(const double *points, const double *radius, size_t count, double spacing,
                                 const scree_peel_rule *rule, scree_triangle_surface *surface,
                                 scree_error *error) SCREE_MUST_USE;

#endif
