/// Figures of the tables of force statistics (average/force_statistics.h), of a run or of an ensemble. Private to
/// src/view/ and the library. path without extension. Errors: SCREE_ERROR_INPUT: nothing to draw; disk, memory.
#ifndef SCREE_VIEW_FORCE_FIGURES_H
#define SCREE_VIEW_FORCE_FIGURES_H

#include "average/table.h"

/// P(n) of the bins of equal width, over a logarithmic axis.
scree_status scree_draw_force_distribution(const char *path, const scree_average_table *table,
                                           scree_error *error) SCREE_MUST_USE;
scree_status scree_draw_friction_distribution(const char *path, const scree_average_table *table,
                                              scree_error *error) SCREE_MUST_USE;
/// Directions of contacts with the mean force by direction; in 3D over the elevation, each value on both sides.
scree_status scree_draw_contact_rose(const char *path, const scree_average_table *table,
                                     scree_error *error) SCREE_MUST_USE;

#endif
