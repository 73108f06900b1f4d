/// Delaunay triangulation of points in space (through Qhull), and which of its tetrahedra lie outside the assembly.
#ifndef SCREE_SEARCH_TETRAHEDRA_H
#define SCREE_SEARCH_TETRAHEDRA_H

#include "base/memory.h"

/// Tetrahedra of point indices with positive volume (x_1 - x_0) . (x_2 - x_0) x (x_3 - x_0), and neighbours across the
/// face opposite to each vertex (-1: outside).
typedef struct scree_tetrahedra {
    size_t count;
    uint32_t (*vertex)[4];
    int32_t (*neighbour)[4];
} scree_tetrahedra;

/// points: count x 3 [m]. Tetrahedra come in ascending order, lowest index first. Flat ones (all points of a lattice
/// cell on one sphere) are left out. Errors: memory; SCREE_ERROR_GUARD for fewer than four points, not a number, all in
/// a plane.
scree_status scree_tetrahedra_build(const double *points, size_t count, scree_tetrahedra *tetrahedra,
                                    scree_error *error) SCREE_MUST_USE;
void scree_tetrahedra_destroy(scree_tetrahedra *tetrahedra);

/// Peels the convex hull: outside[t] = 1 for each tetrahedron that is cut because one of its outer faces is open (an
/// edge of it leaves a free gap |x_a - x_b| - R_a - R_b above gap_limit [m]) or because it is a sliver (all but flat,
/// with an outer face). One that is the last of any of its points stays. From outside inwards in the order of
/// the tetrahedra. Errors: memory. Cost: O(n).
scree_status scree_tetrahedra_peel(const scree_tetrahedra *tetrahedra, const double *points, const double *radius,
                                   size_t count, double gap_limit, uint8_t *outside, scree_error *error) SCREE_MUST_USE;

#endif
