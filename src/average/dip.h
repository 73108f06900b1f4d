/// The dip of a profile of vertical pressure under the axis of a pile, with what an ensemble says of it.
///
/// s_i(j): pressure of pile i at place j of a cut, places mirror images of each other about the axis. A pile and its
/// mirror image are ONE sample: of each pile the mean of both is taken, m_i(j) = (s_i(j) + s_i(-j)) / 2, and M is their
/// mean over the piles.
///     dip      1 - M(0) / max_j M(j)                          never negative
///     low, high  interval of 95 % of the same, from resamples of whole piles (bootstrap, as in average/table.h)
///     checked  1 - sum_i m_i(0) / sum_i m_i(j_i), j_i where the mean of the OTHER piles is largest: without the bias
///              towards a dip that looking for the largest of noisy numbers has; it may be negative; its interval is
///              that of resamples of whole piles, of which all copies of one are left out together
///     p        of no dip: share of the changes of sign of the differences m_i(j_i) - m_i(0) whose sum is at least as
///              large (R. A. Fisher's randomisation test; all of them up to 12 piles, else 20000 drawn ones): the least
///              it can be is 1 over their number. Differences are not quite independent, since each pile has a part in
///              where the others are looked at: of flat noisy profiles 3 to 9 % of ensembles of 5 to 8 piles and 5 to
///              11 % of those of 12 to 20 have p <= 0.05, the more the less places are correlated; under a dome none
/// One pile has no interval and no p: NAN. A place that some pile has no number of, on one of its sides, is left out of
/// all, since a mean over some piles is not that of the others; on the axis nothing is known then. A pile without any
/// number is none.
#ifndef SCREE_AVERAGE_DIP_H
#define SCREE_AVERAGE_DIP_H

#include "base/memory.h"

#include <stdbool.h>

typedef struct scree_average_dip {
    double dip, low, high, checked, p;
    double place;  ///< of the largest pressure, 0 to 1: distance from the axis over the half width
    double centre; ///< Pa, M(0)
    double most;   ///< Pa
    double checked_low, checked_high;
} scree_average_dip;

/// profile: piles x points, points odd; NAN: no number. Errors: memory.
scree_status scree_average_dip_find(const double *profile, size_t piles, size_t points, scree_average_dip *dip,
                                    scree_error *error) SCREE_MUST_USE;

#endif
