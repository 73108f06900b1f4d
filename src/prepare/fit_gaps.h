/// Positions and radii that close the gaps of a packing: minimises the squared departures of all gaps between
/// neighbours from their mean, those to the walls, and the departures of the radii from the sizes asked for.
#ifndef SCREE_PREPARE_FIT_GAPS_H
#define SCREE_PREPARE_FIT_GAPS_H

#include "prepare/gap_report.h"

/// Sizes asked for: bodies of one class may exchange radii. All lengths in mean radii.
typedef struct scree_gap_sizes {
    const uint8_t *class_of; ///< of each body
    const double *radius;    ///< those of class 0 in ascending order, then those of class 1, ...
    const double *least;     ///< of each class: limits of the radii
    const double *most;
} scree_gap_sizes;

typedef struct scree_gap_task {
    scree_gap_sizes sizes;
    double solid;     ///< area (volume) of the bodies together at the end
    double tolerance; ///< rms of the gaps of the bonds about their mean; of a single one FARTHEST times as much
    double penalty;   ///< weight of the squared departures of radii against those of gaps
    int64_t rounds;   ///< most rounds
} scree_gap_task;

/// Moves bodies and changes radii until the scatter is within the tolerance and no more gaps close, or for
/// task->rounds; then those at walls touch them exactly, and the bodies fill what they shall. Errors: memory; Qhull.
scree_status scree_gaps_fit(const scree_gap_task *task, scree_gap_bodies *bodies, scree_gap_report *report,
                            scree_error *error) SCREE_MUST_USE;

#endif
