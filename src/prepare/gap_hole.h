/// The widest hole of a packing.
#ifndef SCREE_PREPARE_GAP_HOLE_H
#define SCREE_PREPARE_GAP_HOLE_H

#include "search/simplices.h"

typedef struct scree_gap_hole {
    double centre[3];
    double power; ///< squared distance from each body around it less that body's squared radius; -INFINITY: no hole
} scree_gap_hole;

/// Of the regular simplices of bodies (points: count x dimension) whose own point lies between the origin and `side`.
scree_gap_hole scree_gap_hole_find(const scree_simplices *simplices, const double *points, const double *radius,
                                   int dimension, const double side[3]);

#endif
