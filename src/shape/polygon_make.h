/// Polygons that are drawn at random or regular: pure functions of seed and id, so that a grain looks the same wherever
/// and whenever it is made.
///
/// On an ellipse (x, y) = (sqrt(q) cos t, sin t / sqrt(q)), q >= 1 the ratio of its axes, the long one along x. R 3.1
/// ("RAND1") places corners randomly on an ellipse and does not say how t is drawn. Here: one corner in each of n equal
/// sectors of t, uniform in it; or all n at random. The second gives slivers and polygons that do not hold the centre
/// of their ellipse; lists that scree_polygon_check refuses are drawn anew. Every polygon is scaled to the area of a
/// disc of the wanted radius and moved so that its centroid is the origin.
#ifndef SCREE_SHAPE_POLYGON_MAKE_H
#define SCREE_SHAPE_POLYGON_MAKE_H

#include "shape/polygon.h"

/// No polygon on an ellipse has a bounding radius above this many times the square root of the ratio of axes, over the
/// radius of the disc of equal area: thinner ones are drawn anew. So lists and forces have bounds before anything is
/// drawn.
#define SCREE_POLYGON_REACH 3.0

typedef enum scree_polygon_scatter {
    SCREE_POLYGON_SECTORS, ///< one corner in each equal sector of the eccentric angle
    SCREE_POLYGON_FREE,    ///< all corners at random
} scree_polygon_scatter;

/// Scales to the area of a disc of `radius` [m] and moves the centroid to the origin.
void scree_polygon_fit(int count, double radius, double (*corner)[2]);

/// A regular polygon; its first corner lies on the x axis.
void scree_polygon_make_regular(int count, double radius, double (*corner)[2]);

/// Corners at random on an ellipse with the ratio `axes` of its axes. Error: SCREE_ERROR_INPUT if none of 64 draws
/// passes scree_polygon_check: an ellipse too long for so many corners.
scree_status scree_polygon_make_on_ellipse(uint64_t seed, uint64_t id, int count, double axes,
                                           scree_polygon_scatter scatter, double radius, double (*corner)[2],
                                           scree_error *error) SCREE_MUST_USE;

/// Number of corners of body `id`: low to high, each equally probable.
int scree_polygon_draw_count(uint64_t seed, uint64_t id, int low, int high);

#endif
