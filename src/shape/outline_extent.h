/// How far the outline of a grain in the plane reaches, exactly: a convex polygon, one with rounded corners
/// (shape/rounding.h), a disc. The surface of a sample is made of these.
///
/// Chord: the part of a vertical line at x within the outline, of the edges that x lies in, moved outwards by the
/// rounding r along their normals, and of the discs about the corners, y_k +- sqrt(r^2 - (x - x_k)^2). Highest point
/// above an interval: a convex outline falls from its top to both sides, so it lies where the interval is nearest to
/// the top.
///
/// Places are relative to the centre of the body. Limits: at the very ends of a rounded outline round-off may miss it.
/// Cost: linear in the corners, with a root and a distance a corner where it is rounded.
#ifndef SCREE_SHAPE_OUTLINE_EXTENT_H
#define SCREE_SHAPE_OUTLINE_EXTENT_H

#include "shape/core_pair.h"

/// The box about an outline [m].
typedef struct scree_outline_extent {
    double low[2], high[2];
    double top; ///< x of its highest point, of several the left one
} scree_outline_extent;

scree_outline_extent scree_outline_extent_of(const scree_core *outline);

/// The lower and upper end [m] of the chord at x; false: the outline does not reach there.
bool scree_outline_chord(const scree_core *outline, double x, double chord[2]);

/// The highest point [m] of the outline within `half` of x; false: it does not reach there. Of a disc, which is told of
/// where it ends only, the height of its centre.
bool scree_outline_highest(const scree_core *outline, double x, double half, double *height);

#endif
