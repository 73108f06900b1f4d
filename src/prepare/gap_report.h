/// What the gaps of a packing are like.
#ifndef SCREE_PREPARE_GAP_REPORT_H
#define SCREE_PREPARE_GAP_REPORT_H

#include "prepare/gap_net.h"

#include <stdbool.h>

/// A gap may depart from the mean by this many tolerances and still be that of a bond.
#define SCREE_GAP_FARTHEST 5

/// Lengths in those of the bodies. Bonds are the edges whose gaps are not wider than their own mean and
/// SCREE_GAP_FARTHEST tolerances.
typedef struct scree_gap_report {
    size_t edges; ///< of the triangulation
    size_t bonds;
    size_t touches;   ///< bodies at a wall, as near as a bond
    double overlap;   ///< mean of the bonds; negative: a gap
    double scatter;   ///< rms about it
    double deepest;   ///< largest overlap of two bodies beyond the mean
    double widest;    ///< largest gap of a bond beyond the mean
    double fabric[9]; ///< mean of n n over the bonds
} scree_gap_report;

/// start: the mean overlap as it is guessed.
void scree_gap_report_of_net(const scree_gap_bodies *bodies, const scree_gap_net *net, double start, double tolerance,
                             scree_gap_report *report);

/// Scatter and largest departures are within the tolerance and SCREE_GAP_FARTHEST times as much.
bool scree_gap_report_meets(const scree_gap_report *report, double tolerance);

#endif
