/// Delaunay triangulation (through Qhull) and its outer boundary as ONE closed loop.
#ifndef SCREE_SEARCH_DELAUNAY_H
#define SCREE_SEARCH_DELAUNAY_H

#include "base/memory.h"
#include "search/peel_rule.h"

/// Triangles of point indices, counter-clockwise, with neighbours across the edge opposite to each vertex (-1:
/// outside).
typedef struct scree_triangulation {
    size_t count;
    uint32_t (*vertex)[3];
    int32_t (*neighbour)[3];
} scree_triangulation;

/// points: count x 2 [m]. Errors: memory; SCREE_ERROR_GUARD for fewer than three points, not a number, all on a line,
/// two in one place. Every point is a corner of some triangle. Triangles come in ascending order, lowest index first;
/// where points are cocircular the diagonals depend on their order, so give bodies in the order of their ids.
scree_status scree_triangulation_build(const double *points, size_t count, scree_triangulation *triangulation,
                                       scree_error *error) SCREE_MUST_USE;
void scree_triangulation_destroy(scree_triangulation *triangulation);

/// What scree_boundary_loop did with a triangle.
typedef enum scree_triangle_mark {
    SCREE_TRIANGLE_INSIDE, ///< never had an edge on the loop
    SCREE_TRIANGLE_OUTER,  ///< kept, with an edge on the loop
    SCREE_TRIANGLE_CUT,    ///< outside the loop
} scree_triangle_mark;

/// Outer boundary of the triangulation after cleaning: boundary triangles whose outer edge leaves a free gap between
/// the outlines of its bodies (peel_rule.h) above the rule's limit, or which are slivers (an angle above 150 degrees
/// opposite to the outer edge), are cut, slivers first, then the widest gap first, unless their third point is on the
/// loop already: so the loop stays ONE simple closed polygon with all points inside or on it. marks[t]:
/// scree_triangle_mark of triangle t, may be NULL. loop: point indices counter-clockwise from the lowest, caller frees
/// with scree_release. Cost: O(n + h log h).
scree_status scree_boundary_loop(const scree_triangulation *triangulation, const double *points, const double *radius,
                                 size_t count, const scree_peel_rule *rule, uint32_t **loop, size_t *loop_count,
                                 uint8_t *marks, scree_error *error) SCREE_MUST_USE;

/// The loop of scree_boundary_loop on the Delaunay triangulation of all points, found from those near the outside alone
/// where that provably gives the same (outer_loop.c). spacing: m, mean distance of neighbours; it steers the cost, not
/// the result. Errors: as scree_triangulation_build. Cost: O(n) plus a triangulation of the band.
scree_status scree_outer_loop(const double *points, const double *radius, size_t count, double spacing,
                              const scree_peel_rule *rule, uint32_t **loop, size_t *loop_count,
                              scree_error *error) SCREE_MUST_USE;

#endif
