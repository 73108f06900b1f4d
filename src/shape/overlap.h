/// What two bodies that overlap in the plane share: the area A and its gradient, for every pair of shapes in the same
/// terms (docs/theory/polygons.md).
///
/// The part of the outline of the first body that lies inside the second is some pieces, from s_k to e_k in the sense
/// of the outline (counter-clockwise), D_k = e_k - s_k. Only their ends count, whatever lies between:
///     chord     c = sum (D_y, -D_x)          gradient of A as the first moves, towards the second [m]
///     torque    M = - sum D . (s + e)/2      gradient of A as the first turns about the origin [m2]
/// The gradient acts along the line x * c = M, (x * c = x_x c_y - x_y c_x). With one piece (two crossings) that line
/// goes through the middle of the chord, which is the point of contact of R, 2.4.1. With more pieces the point lies on
/// the line, at the height along c of the mean of the crossings, each weighted by the squared lengths of the piece of
/// the first outline and that of the second that meet in it: a pair of crossings that is born in one point has no
/// weight, so the point is continuous, and with one piece it is the middle again.
///     dA/dt = c . (v_1 + w_1 x a_1 - v_2 - w_2 x a_2), a: arms from the centres to the point
/// exactly, since the gradient of A with respect to the second body is the opposite one, along the same line.
///
/// Cost: a few operations a crossing.
#ifndef SCREE_SHAPE_OVERLAP_H
#define SCREE_SHAPE_OVERLAP_H

#include "base/inline.h"

#include <math.h>
#include <stdbool.h>

/// A point of contact nearer to a centre than this share of the radius of the disc of equal area is flagged: the half
/// thickness of an ellipse is 1/20 of it at axes of 400 : 1, so such a point means deep overlap and no thin grain.
#define SCREE_OVERLAP_NEAR 0.05

/// A chord shorter than this share of its pieces, which cancel, has no direction: crossed bars, which nothing pushes
/// apart.
#define SCREE_OVERLAP_CANCELLED 1e-12

/// What a law cannot use. A guard has to stop the run.
typedef enum scree_overlap_flag {
    SCREE_OVERLAP_INSIDE = 1,      ///< one body lies wholly inside the other: no chord; or a coordinate is not a number
    SCREE_OVERLAP_NEAR_CENTRE = 2, ///< the point lies within SCREE_OVERLAP_NEAR radii of a centre: R's l goes to zero
    SCREE_OVERLAP_NO_POINT = 4,    ///< crossed bodies: c vanishes, or the line of the gradient passes a body by
} scree_overlap_flag;

typedef struct scree_overlap {
    double area;          ///< m2
    double chord[2];      ///< m, c: gradient of the area as the first body moves
    double arm[2][2];     ///< m, the point from the centre of the first body, and from that of the second
    double edge[2][2][2]; ///< with two crossings: where the first outline goes in and where it comes out, the direction
                          ///< of the first outline and that of the second
    int crossings;        ///< of the two outlines
    int flags;            ///< of scree_overlap_flag
} scree_overlap;

/// Ends of the pieces, in the order of the first outline: s_0, e_0, s_1, e_1 ...; the coordinates are those of
/// `arm[0]`. Fills chord, crossings and arm[0]. `round`: the first body is a disc about the origin, which nothing
/// turns: M = 0.
SCREE_INLINE void scree_overlap_find_line(scree_overlap *overlap, int pieces, const double (*end)[2], bool round)
{
    double way[2] = {0, 0}, torque = 0;
    for (int k = 0; k < pieces; k++) {
        const double *s = end[2 * k], *e = end[2 * k + 1], dx = e[0] - s[0], dy = e[1] - s[1];
        way[0] += dx;
        way[1] += dy;
        torque -= (dx * (s[0] + e[0]) + dy * (s[1] + e[1])) / 2;
    }
    double *c = overlap->chord, *point = overlap->arm[0];
    c[0] = way[1];
    c[1] = -way[0];
    overlap->crossings = 2 * pieces;
    if (pieces == 1 && !round) {
        for (int i = 0; i < 2; i++) point[i] = (end[0][i] + end[1][i]) / 2;
        return;
    }
    double weights = 0, mean[2] = {0, 0}, lengths = 0, square = c[0] * c[0] + c[1] * c[1];
    for (int k = 0; k < 2 * pieces; k++) {
        const double *x = end[k], *a = end[k ^ 1],
                     *b = end[k & 1 ? (k + 1) % (2 * pieces) : (k + 2 * pieces - 1) % (2 * pieces)];
        double u[2] = {x[0] - a[0], x[1] - a[1]}, v[2] = {x[0] - b[0], x[1] - b[1]};
        double weight = (u[0] * u[0] + u[1] * u[1]) * (v[0] * v[0] + v[1] * v[1]);
        weights += weight;
        lengths += u[0] * u[0] + u[1] * u[1];
        for (int i = 0; i < 2; i++) mean[i] += weight * x[i];
    }
    for (int i = 0; i < 2; i++) point[i] = weights > 0 ? mean[i] / weights : end[0][i];
    if (!(square > SCREE_OVERLAP_CANCELLED * SCREE_OVERLAP_CANCELLED * lengths)) {
        overlap->flags |= SCREE_OVERLAP_NO_POINT;
        return;
    }
    if (round) torque = 0;
    double along = (point[0] * c[0] + point[1] * c[1]) / square, across = torque / square;
    point[0] = along * c[0] + across * c[1];
    point[1] = along * c[1] - across * c[0];
}

/// The point from the second centre, which lies `apart` from the first, and what cannot be used. Radii: of the discs of
/// equal area; bounds: no point of a body is farther from its centre.
SCREE_INLINE void scree_overlap_finish(scree_overlap *overlap, const double apart[2], const double radius[2],
                                       const double bound[2])
{
    for (int b = 0; b < 2; b++) {
        double *arm = overlap->arm[b];
        if (b == 1)
            for (int i = 0; i < 2; i++) arm[i] = overlap->arm[0][i] - apart[i];
        double square = arm[0] * arm[0] + arm[1] * arm[1];
        double near = SCREE_OVERLAP_NEAR * radius[b], far = bound[b] * (1 + 1e-9);
        if (!(square >= near * near)) overlap->flags |= SCREE_OVERLAP_NEAR_CENTRE;
        if (!(square <= far * far)) overlap->flags |= SCREE_OVERLAP_NO_POINT;
    }
}

/// The same overlap with the two bodies exchanged.
SCREE_INLINE void scree_overlap_exchange(scree_overlap *overlap)
{
    for (int i = 0; i < 2; i++) {
        const double in[2] = {overlap->edge[0][0][i], overlap->edge[0][1][i]};
        overlap->edge[0][0][i] = overlap->edge[1][1][i];
        overlap->edge[0][1][i] = overlap->edge[1][0][i];
        overlap->edge[1][0][i] = in[1];
        overlap->edge[1][1][i] = in[0];
    }
    for (int i = 0; i < 2; i++) {
        double arm = overlap->arm[0][i];
        overlap->chord[i] = -overlap->chord[i];
        overlap->arm[0][i] = overlap->arm[1][i];
        overlap->arm[1][i] = arm;
    }
}

/// dA/dt [m2/s] from velocities [m/s] and spins [rad/s] of both bodies.
SCREE_INLINE double scree_overlap_rate(const scree_overlap *overlap, const double velocity[2][2], const double spin[2])
{
    double approach[2];
    for (int i = 0; i < 2; i++) approach[i] = velocity[0][i] - velocity[1][i];
    approach[0] -= spin[0] * overlap->arm[0][1] - spin[1] * overlap->arm[1][1];
    approach[1] += spin[0] * overlap->arm[0][0] - spin[1] * overlap->arm[1][0];
    return overlap->chord[0] * approach[0] + overlap->chord[1] * approach[1];
}

#endif
