/// Spheres on paper: a view from outside, and a cut. Both make a plane snapshot that a scene can draw.
#ifndef SCREE_VIEW_PROJECTION_H
#define SCREE_VIEW_PROJECTION_H

#include "io/snapshot.h"

/// Edges of a periodic cell on paper.
typedef struct scree_periodic_edges {
    double end[12][2][2]; ///< m
    size_t count;         ///< 0: no cell
} scree_periodic_edges;

/// The edges of the cell of a plane snapshot.
scree_periodic_edges scree_periodic_edges_of(const scree_snapshot *snapshot);

/// Orthographic view from the front right, from above. Page axes: x to the right, y upwards.
typedef struct scree_projection {
    scree_snapshot plane;  ///< centres and contact points on the page; velocities are left out
    double *depth;         ///< per body, m towards the viewer
    double plate[2][4][2]; ///< m on the page: corners of the bottom and the top plate
    bool has_plate[2];
    scree_periodic_edges periodic;
} scree_projection;

/// Errors: memory.
scree_status scree_projection_create(const scree_snapshot *solid, scree_projection *projection,
                                     scree_error *error) SCREE_MUST_USE;
void scree_projection_destroy(scree_projection *projection);

/// y [m] of the cut.
double scree_section_place(const scree_snapshot *solid);

/// The cut through the mean centre of the bodies, y = const: discs of the radius that the cut has; x to the right, z
/// upwards. Bodies that it misses have radius 0, so fields keep their order. No contacts. Errors: memory.
scree_status scree_section_create(const scree_snapshot *solid, scree_snapshot *plane,
                                  scree_error *error) SCREE_MUST_USE;

#endif
