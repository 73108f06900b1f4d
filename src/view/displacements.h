/// Displacements of grains as arrows on the scene that they start from: NAME.svg and NAME.png. Private to src/.
#ifndef SCREE_VIEW_DISPLACEMENTS_H
#define SCREE_VIEW_DISPLACEMENTS_H

#include "average/sample.h"
#include "io/snapshot.h"

/// path without extension. from: the earlier state of a plane sample, moved: the later one, with its displacements
/// (scree_average_move). shown [m]: from x to x, NULL: all. Of grains that lie closer than two diameters, or are many,
/// some have an arrow, evenly over the sample; the legend says how many. Errors: SCREE_ERROR_INPUT: nothing has moved,
/// or spheres; disk, memory.
scree_status scree_displacements_draw(const char *path, const scree_snapshot *from, const scree_average_sample *moved,
                                      const double *shown, scree_error *error) SCREE_MUST_USE;

#endif
