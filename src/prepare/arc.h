/// Geometry of a point that slides down, without friction and inertia, among spheres and planes that it must not enter.
///
/// Contacts. Surfaces that the point touches, with unit normals n towards the point. Its velocity is the projection of
/// gravity on the cone of velocities that enter none of them (n . v >= 0 for all): zero, or down along one or two of
/// them. The surfaces that hold it have multipliers > 0 in v = g + sum multiplier n; it rests where three of them carry
/// the whole of gravity. Where one or two carry all of it the point stands on their very top, and tips over to a side
/// where nothing that it touches is in its way. Equal spheres beside a wall come to that all the time: their centres
/// lie in one vertical plane. Of the sets that hold the point the one counts whose path enters no other touched surface
/// by its curvature either.
///
/// Paths. On one sphere a meridian, on two surfaces the circle in which they meet: both are arcs. Along an arc all
/// events are roots of a sin(phi) + b cos(phi) = c, found with square roots alone, so that a packing is the same to the
/// last bit on any machine.
#ifndef SCREE_PREPARE_ARC_H
#define SCREE_PREPARE_ARC_H

#include <stdbool.h>

enum { SCREE_ARC_MOST = 12 };

/// A point falls past a sphere that it touches this near to its equator (vertical part of the normal): it enters by
/// half the square of that. Round-off of a gap just as wide as the point needs makes roots of this order.
static const double SCREE_ARC_EQUATOR = 1e-7;

/// The point keeps outside of a sphere, or on the side of a plane that its normal points to.
typedef struct scree_arc_surface {
    bool plane;
    double centre[3]; ///< m, of the sphere; 1, unit normal of the plane
    double reach;     ///< m, radius; offset of the plane: points with normal . x = reach
} scree_arc_surface;

typedef struct scree_arc {
    double middle[3], radius; ///< m
    double along[3];          ///< 1, from the middle to the start
    double ahead[3];          ///< 1, tangent at the start
    double touch;             ///< m, surfaces as near as this to the start touch it
} scree_arc;

/// Which surfaces hold a point: 0 (it falls) to 3 (it rests, on all that it touches).
typedef struct scree_hold {
    int count;
    int by[3];      ///< indices of the surfaces
    scree_arc path; ///< of one or two
} scree_hold;

/// Unit normal of `surface` at `point`.
void scree_arc_surface_normal(const scree_arc_surface *surface, const double point[3], double normal[3]);

/// Projects gravity on the cone of the normals of `count` surfaces, at most SCREE_ARC_MOST, that `point` touches.
scree_hold scree_hold_find(const scree_arc_surface *touched, int count, const double point[3]);

/// Height at which the multiplier of `one` vanishes when the point goes down along `one` and `other` (NULL: alone); -1
/// if it does not. The normals of the two enclose an angle of cosine `cosine`.
double scree_arc_parting(const scree_arc_surface *one, const scree_arc_surface *other, double cosine);

/// How far along the arc it enters the surface: the angle in a measure that grows with it, 0 to 2 for 0 to pi, and the
/// point. False if it does not within half a turn. A surface touched at the start and entered from there gives 0, and
/// one that the arc leaves there is entered where the arc comes back to it. `released`: it is known not to hold the
/// point, so an arc tangent to it leaves it.
bool scree_arc_enters(const scree_arc *arc, const scree_arc_surface *surface, bool released, double *measure,
                      double point[3]);

#endif
