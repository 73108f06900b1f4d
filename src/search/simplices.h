/// Delaunay simplices of points in two or three dimensions through Qhull; private to the triangulations.
#ifndef SCREE_SEARCH_SIMPLICES_H
#define SCREE_SEARCH_SIMPLICES_H

#include "base/memory.h"

typedef struct scree_simplices {
    size_t count;
    uint32_t *vertex;   ///< count x (dimension + 1) points
    int32_t *neighbour; ///< count x (dimension + 1): the simplex opposite to each vertex, -1: outside
} scree_simplices;

/// points: count x dimension [m]. Simplices are oriented positively and come in ascending order; within one the indices
/// ascend, but for the last two where the orientation wants it. The caller frees both arrays. Errors: memory;
/// SCREE_ERROR_GUARD for fewer than dimension + 1 points, not a number, all on a line (in a plane), two in one place.
scree_status scree_simplices_build(const double *points, size_t count, int dimension, scree_simplices *simplices,
                                   scree_error *error) SCREE_MUST_USE;

/// The regular (weighted Delaunay) simplices of discs and spheres of these radii [m]: those of the power distances
/// |x - point|^2 - radius^2, in which neighbours of any sizes that touch share an edge. A body within others may be in
/// no simplex.
scree_status scree_simplices_build_weighted(const double *points, const double *radius, size_t count, int dimension,
                                            scree_simplices *simplices, scree_error *error) SCREE_MUST_USE;

#endif
