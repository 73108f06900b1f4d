/// Overlap of a polygon or a disc with a half-plane, in the terms of shape/overlap.h; the body is the first, the
/// half-plane the second.
///
/// The half-plane holds the points behind a straight wall, whose unit normal points to the side of the bodies; the
/// centre of the body lies `height` above it (negative: behind). The wall has no centre: arm[1] is the point from the
/// foot of the body's centre on the wall; l is the first arm alone (r of a wall is infinite; R has walls of particles,
/// whose l depends on the size of the plate). The chord is exactly along the normal, so nothing is gained by sliding
/// along the wall. Wholly behind the wall counts as inside.
///
/// Cost: linear in the corners; a disc: one atan2 and one square root.
#ifndef SCREE_SHAPE_HALF_PLANE_OVERLAP_H
#define SCREE_SHAPE_HALF_PLANE_OVERLAP_H

#include "shape/overlap.h"
#include "shape/polygon.h"

bool scree_polygon_half_plane_overlap(const scree_polygon *polygon, const double normal[2], double height,
                                      scree_overlap *overlap);

bool scree_disc_half_plane_overlap(double radius, const double normal[2], double height, scree_overlap *overlap);

#endif
