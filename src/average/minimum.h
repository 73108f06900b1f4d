/// Where the pressure under a heap is lowest and highest, from its apex: of heaps that are not symmetric, whose sides
/// cannot be folded (average/dip.h).
///
/// M(j): mean over the heaps of the pressure at place j of a cut, -1 to 1 over the half width from the axis of each; a:
/// the mean of their apexes, in the same unit; rim(j): the smaller one of the largest values of M to the left and to
/// the right of j. The minimum is the place that lies deepest below its rim,
///     place    j with the largest rim(j) - M(j), less a: below 0 to the left of the apex; NAN where no place
///              lies below its rim, as under a dome
///     depth    1 - M / rim there; 0 without a minimum. Never negative: in noise there is always some minimum, as there
///              always is a dip
///     highest  place of the largest of M, less a
///     share    of the resamples that have a minimum
/// Each with an interval of 95 % from resamples of whole heaps (bootstrap, as in average/table.h), `place` from those
/// of them that have a minimum: it is worth as much as `share` says. One heap has no interval: NAN.
///
/// Nothing is smoothed: places are those of the cut (41: a twentieth of the half width), and what is narrower than an
/// element is not seen. Source: P. Roul, PhD thesis, Magdeburg 2009, 3.11, which gives the place by eye.
#ifndef SCREE_AVERAGE_MINIMUM_H
#define SCREE_AVERAGE_MINIMUM_H

#include "base/memory.h"

/// A number with both ends of its interval.
typedef struct scree_average_between {
    double value, low, high;
} scree_average_between;

typedef struct scree_average_minimum {
    scree_average_between place, depth, highest;
    double share;
} scree_average_minimum;

/// profile: heaps x points, points odd. Numbers that are none are no pressure. apex: of each heap, from its axis over
/// its half width. Errors: memory. Cost: resamples x heaps x points.
scree_status scree_average_minimum_find(const double *profile, const double *apex, size_t heaps, size_t points,
                                        scree_average_minimum *minimum, scree_error *error) SCREE_MUST_USE;

#endif
