/// What is known of two convex polygons that move: where their outlines cross, or that they lie apart, with the room in
/// which that stays so.
///
/// All that is decided of two polygons is on which side of an edge corners lie (shape/polygon_pair.h), and a side
/// cannot change before the corner has reached the line of the edge. So of a pair that has been looked at, edges that
/// cross twice do so, and bodies that lie apart do so, in each pose that differs by less than the least distance of the
/// corners and lines that the decision rests on. The difference of two poses, in corners against edges, is at most
///     D = |dx| + |dy| + L (|da_1| + |da_2|),   L = b_1 + b_2 + max(b_1, b_2)
/// (x, y: from centre to centre; a: angles; b: bounding radii): a corner of the second in the frame of the first moves
/// by |d(x, y)| + |da_1| (b_1 + 2 b_2) + |da_2| b_2 at most while the circles meet, and in turn.
///
/// The pose is kept in single precision; the room is counted from what is kept. A hint never changes a number: the
/// overlap is worked out from the corners as they lie, by the edges that a look would find.
///
/// Cost: of a look some 0.3 us; of asking a hint a few operations, in lanes (contact/outlines_lanes.h).
#ifndef SCREE_SHAPE_POLYGON_HINT_H
#define SCREE_SHAPE_POLYGON_HINT_H

#include "shape/polygon.h"
#include "state/pair_hint.h"

/// Two outlines in a pose.
typedef struct scree_polygon_pose {
    const scree_polygon *polygon[2]; ///< of a disc without corners
    double apart[2];                 ///< m, the second centre from the first
    double angle[2];                 ///< rad
    bool fixed;                      ///< angles are not known: what is found is of this pose alone
} scree_polygon_pose;

/// L
static inline double scree_polygon_lever(double first_bound, double second_bound)
{
    return first_bound + second_bound + (first_bound > second_bound ? first_bound : second_bound);
}

/// Looks at two outlines, with the hint of before, and renews it. False: they lie apart. True, and the room is 0: they
/// may overlap, in a way that the hint does not tell.
bool scree_pair_hint_renew(const scree_polygon_pose *pose, scree_pair_hint *hint);

#endif
