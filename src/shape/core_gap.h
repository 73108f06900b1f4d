/// The gap between two outlines: what is free between two bodies in the plane.
///
/// It is the least distance of any two of their points, of polygons, rounded ones and discs alike: that of their cores
/// (shape/core_pair.h) less both roundings. Two convex polygons that are apart are nearest at a corner of one of them.
/// Of two discs it is |x_a - x_b| - R_a - R_b, in this order.
#ifndef SCREE_SHAPE_CORE_GAP_H
#define SCREE_SHAPE_CORE_GAP_H

#include "shape/core_pair.h"

/// Of two bodies as they lie, the centre of the second `apart` from that of the first [m]. Exchange gives the same
/// bits. Of cores that meet the distance counts as 0: how deep they lie in each other is not told. Cost: of two
/// polygons the product of their corners, some 0.3 microseconds of 7 each.
double scree_core_gap(const scree_core *first, const scree_core *second, const double apart[2]);

/// How deep they lie in each other [m]: the shortest way that parts them, negative where they are apart. Where cores
/// meet it is that of the cores, along the outward normal of one of their edges (of two convex polygons the shortest
/// way out is across an edge of one of them, since their Minkowski difference has no others), and both roundings.
double scree_core_depth(const scree_core *first, const scree_core *second, const double apart[2]);

/// Whether no point of the first body is outside of the second, `apart` from it. Cost: the product of their corners.
bool scree_core_lies_within(const scree_core *first, const scree_core *second, const double apart[2]);

#endif
