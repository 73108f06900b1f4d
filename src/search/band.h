/// The points near the outside of a cloud, in two or three dimensions: what the outer boundary of its triangulation can
/// be found from. Private to outer_loop.c and outer_surface.c.
#ifndef SCREE_SEARCH_BAND_H
#define SCREE_SEARCH_BAND_H

#include "base/memory.h"

#include <stdbool.h>

typedef struct scree_band {
    int dimension;
    const double *all_points, *all_radius; ///< the cloud, which stays the caller's
    size_t all_count;
    double origin[3], cell; ///< m, corner of the grid and edge of a cell
    size_t size[3];         ///< cells, with an empty ring around the points
    uint32_t *end;          ///< by cell: end of its points in `order`, which begin at the end of the cell before
    uint32_t *order;        ///< points by cell
    uint8_t *depth;         ///< by cell: 0 outside, 1 .. DEPTH in the band, SCREE_BAND_INSIDE, or wanted
    uint32_t *queue;        ///< cells in the order in which the flood reaches them
    size_t queued;
    int rounds;      ///< of extension
    uint32_t *index; ///< points of the band, ascending
    double *points, *radius;
    size_t count; ///< 0: no band, all points are needed
} scree_band;

#define SCREE_BAND_INSIDE UINT8_MAX

/// points: count x dimension [m], radius: count [m], both kept by reference; spacing: mean distance of neighbours [m].
/// band->count is zero when the band would leave too little out to pay, or when the grid would be too large (a body far
/// away). Errors: memory.
scree_status scree_band_build(const double *points, const double *radius, size_t count, int dimension, double spacing,
                              scree_band *band, scree_error *error) SCREE_MUST_USE;
void scree_band_destroy(scree_band *band);

/// Whether a point that was left out lies in the circle (sphere) through dimension + 1 corners, or on it to round-off.
/// If so, points in it and up to a cell beside it join the band with the next scree_band_extend.
bool scree_band_wants(scree_band *band, const double *const *corner, const double *centre, double radius);

/// Takes in the points that were wanted. After a few rounds, or when the band would leave too little out, band->count
/// is zero. Errors: memory.
scree_status scree_band_extend(scree_band *band, scree_error *error) SCREE_MUST_USE;

#endif
