/// Polygons with rounded corners: the Minkowski sum of a convex polygon, the core, and a disc of radius r. Its outline
/// lies r outside of the core; it is the core, a strip of width r on every edge, and a sector of radius r at every
/// corner, of the angle a by which the outline turns there; the sectors together are a disc.
///     area          A + P r + pi r^2,  A area of the core, P its circumference                       (Steiner)
///     strip         of length L along t, middle m of its edge, outward normal n:
///                   area L r, centroid c = m + n r / 2, integral of x x' = L r (c c' + L^2 / 12 t t' + r^2 / 12 n n')
///     sector        at the corner v, b halving its angle:  area a r^2 / 2, integral of y = 2/3 r^3 sin(a / 2) b,
///                   of y y' = r^4 / 8 ((a + sin a) b b' + (a - sin a) (1 - b b')),  y = x - v
/// Cost: an arc tangent and a root a corner.
#ifndef SCREE_SHAPE_ROUNDING_H
#define SCREE_SHAPE_ROUNDING_H

#include "shape/polygon.h"

/// Of the rounded body; the core in any frame, counter-clockwise; `bound` is the farthest place of the outline from the
/// centroid of the body.
scree_polygon_measures scree_rounding_measure(int count, const double (*corner)[2], double rounding);

/// By which an outline with the area of a disc of radius 1 is scaled so that it has that area with a rounding: the
/// positive root of A s^2 + P r s + pi r^2 = pi. rounding: below 1.
double scree_rounding_scale(int count, const double (*corner)[2], double rounding);

/// The outline of a rounded body about the frame of its core, with `arc` points on each corner, of which the first and
/// the last end the edges: arc x count points, counter-clockwise. For figures and files.
void scree_rounding_trace(int count, const double (*corner)[2], double rounding, int arc, double (*outline)[2]);

#endif
