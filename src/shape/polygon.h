/// Convex polygons by their corners, counter-clockwise, in the frame of the body: its origin is the centroid once the
/// polygon has been brought there (shape/polygon_make.h).
///
/// Measures are sums over the edges (Stokes), with corners relative to the first one, so that a polygon far from the
/// origin loses no digits:
///     area A = 1/2 sum z,  z = x_k y_l - x_l y_k, l = k + 1                                            m2
///     centroid = sum (x_k + x_l) z / (6 A)                                                             m
///     integral of y^2 = 1/12 sum z (y_k^2 + y_k y_l + y_l^2)                    R 2.82                 m4
///     integral of x^2 = 1/12 sum z (x_k^2 + x_k x_l + x_l^2)                    R 2.87
///     integral of x y = 1/24 sum z ((x_k y_k + x_l y_l) + (x_k + x_l)(y_k + y_l))
/// R 2.91 (which is minus the last one) prints (x_k y_l + x_l y_k) in the first bracket: wrong by as much as the
/// integral itself (docs/theory/polygons.md).
///
/// Source: R = P. Roul, PhD thesis, Magdeburg 2009, 2.6.3.1. Cost: linear in the corners; the check quadratic.
#ifndef SCREE_SHAPE_POLYGON_H
#define SCREE_SHAPE_POLYGON_H

#include "base/error.h"
#include "base/inline.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    /// Sets of corners are bits of one 32-bit word; a regular polygon of so many corners is within 0.5 % a disc.
    SCREE_POLYGON_CORNERS = 32
};

/// How far a corner has to stand out from the line through its neighbours, and from every other corner, over the
/// extent of the polygon. Turning and shifting rounds corners by some 1e-16 of it: convex it stays.
#define SCREE_POLYGON_FLAT 1e-6

/// A polygon as it lies: its corners are relative to the centre of its body.
typedef struct scree_polygon {
    const double (*corner)[2]; ///< m, counter-clockwise, convex (scree_polygon_check)
    int count;                 ///< 3 to SCREE_POLYGON_CORNERS
    double radius;             ///< m, of the disc of equal area
    double bound;              ///< m, no corner is farther from the centre
} scree_polygon;

typedef struct scree_polygon_measures {
    double area;        ///< m2
    double centroid[2]; ///< m
    double
        moment[3]; ///< m4, about the centroid: integrals of y^2, x^2, x y. The polar moment is the sum of the first two
    double radius; ///< m, of the disc of equal area
    double bound;  ///< m, distance of the farthest corner from the centroid
} scree_polygon_measures;

/// Whether `corner` is a polygon: 3 to SCREE_POLYGON_CORNERS corners, finite, none repeated, no edges that cross,
/// convex, counter-clockwise, no corner on the line through its neighbours. Error: SCREE_ERROR_INPUT, naming the corner
/// (from 0).
scree_status scree_polygon_check(int count, const double (*corner)[2], scree_error *error) SCREE_MUST_USE;

/// Area [m2], signed: negative if clockwise.
double scree_polygon_area(int count, const double (*corner)[2]);

/// Width [m] where it is narrowest: the least distance of two parallel lines with the polygon between them, one of
/// which goes along an edge.
double scree_polygon_width(int count, const double (*corner)[2]);

scree_polygon_measures scree_polygon_measure(int count, const double (*corner)[2]);

/// Corners as they lie, relative to the centre of the body: turned by the angle whose cosine and sine are given.
SCREE_INLINE void scree_polygon_turn(int count, const double (*corner)[2], double cosine, double sine,
                                     double (*posed)[2])
{
    for (int k = 0; k < count; k++) {
        double x = corner[k][0], y = corner[k][1];
        posed[k][0] = cosine * x - sine * y;
        posed[k][1] = sine * x + cosine * y;
    }
}

/// The same in space, of a body at `position` [m] turned by `angle`: for figures and files. Contacts take corners
/// relative to the centre, which keep their digits far from the origin.
void scree_polygon_place(int count, const double (*corner)[2], const double position[2], double angle,
                         double (*placed)[2]);

#endif
