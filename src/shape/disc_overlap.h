/// Overlap of a disc with a disc (a lens) and with a convex polygon, in the terms of shape/overlap.h.
///
/// Arcs are seen through their chords. The part of a disc of radius R beyond a chord of half length h at the signed
/// distance a from the centre is R^2 (t - sin t cos t), t = atan2(h, a); t - sin t cos t is a series where t is small,
/// so a thin lens keeps its digits.
///     lens of discs at the distance D: a_1 = (D^2 + R_1^2 - R_2^2)/(2 D),
///     h = sqrt((R_1 + R_2 - D)(R_1 + R_2 + D)(D - R_1 + R_2)(D + R_1 - R_2))/(2 D)
/// With a polygon the overlap is that of the corners inside and the points where edges meet the circle, and a cap on
/// each arc. An edge is told by whether its ends lie inside the circle; the result is consistent whatever the rounding
/// of that, since a circle has no corners to pass. Coordinates are relative to the centre of the disc. The gradient has
/// no torque about the centre of a disc, so its point lies under the centre, along the chord vector.
///
/// Limits: discs with one centre are one inside the other. Cost: two or three atan2 and square roots; linear in the
/// corners.
#ifndef SCREE_SHAPE_DISC_OVERLAP_H
#define SCREE_SHAPE_DISC_OVERLAP_H

#include "shape/overlap.h"
#include "shape/polygon.h"

/// Area of a disc beyond a chord [m2]: half length and signed distance of the chord [m], positive where the part is
/// less than half.
double scree_disc_cap(double radius, double half, double away);

/// Two discs, the second centre `apart` [m] from the first. False: none. Exchange gives the same bits with the opposite
/// sign.
bool scree_disc_overlap(const double radius[2], const double apart[2], scree_overlap *overlap);

/// A disc and a polygon, whose centre lies `apart` [m] from that of the disc. False: none. The polygon and the disc:
/// the same with scree_overlap_exchange.
bool scree_disc_overlap_polygon(double radius, const scree_polygon *polygon, const double apart[2],
                                scree_overlap *overlap);

#endif
