/// Delaunay simplices of points in two or three dimensions through Qhull; private to the triangulations.
#ifndef SCREE_SEARCH_SIMPLICES_H
#define SCREE_SEARCH_SIMPLICES_H

#include "base/memory.h"

/// points: count x dimension [m]. vertex: simplex_count x (dimension + 1) indices, oriented positively, in ascending
/// order of simplices; within one the indices ascend, but for the last two where the orientation wants it. The caller
/// frees it. Errors: memory; SCREE_ERROR_GUARD for fewer than dimension + 1 points, not a number, all on a line (in a
/// plane).
scree_status scree_simplices_build(const double *points, size_t count, int dimension, uint32_t **vertex,
                                   size_t *simplex_count, scree_error *error) SCREE_MUST_USE;

#endif
