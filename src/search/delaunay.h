/// Delaunay triangulation (through Qhull) and its outer boundary as ONE closed loop.
#ifndef SCREE_SEARCH_DELAUNAY_H
#define SCREE_SEARCH_DELAUNAY_H

#include "base/memory.h"

/// Triangles of point indices, counter-clockwise, with neighbours across the edge opposite to each vertex (-1:
/// outside).
typedef struct scree_triangulation {
    size_t count;
    uint32_t (*vertex)[3];
    int32_t (*neighbour)[3];
} scree_triangulation;

/// points: count x 2 [m]. Errors: fewer than three points, all on a line, memory.
scree_status scree_triangulation_build(const double *points, size_t count, scree_triangulation *triangulation,
                                       scree_error *error) SCREE_MUST_USE;
void scree_triangulation_destroy(scree_triangulation *triangulation);

/// Outer boundary of the triangulation after cleaning: boundary triangles whose outer edge leaves a free gap
/// |x_a - x_b| - R_a - R_b > gap_limit (m), or which are slivers, are cut, longest edge first, as long as the loop
/// stays ONE simple closed loop through which no point falls out. `removed[t]` (may be NULL) marks the cut triangles.
/// loop: point indices counter-clockwise, caller frees with scree_release. Cost: O(n log n).
scree_status scree_boundary_loop(const scree_triangulation *triangulation, const double *points, const double *radius,
                                 size_t count, double gap_limit, uint32_t **loop, size_t *loop_count, uint8_t *removed,
                                 scree_error *error) SCREE_MUST_USE;

#endif
