/// Horizontal layers of a sample: solid fraction and mean velocity by height, without an element to choose.
///
///     solid_fraction   exact parts of the grains in the layer over its volume
///     velocity         sum m v / sum m, by the same parts
///
/// The volume of a layer is its thickness times its plan. Along a direction that repeats itself the plan is as wide as
/// the cell; else it ends where the grains of the layer end: in 2D between the outermost ones, in 3D at the convex
/// outline of their sections (circumscribed by 72 lines, 0.06 % too large for a
/// circle). Of polygons the disc of equal area ends the plan. So a heap has the solid fraction of its inside, and a box
/// the one between its walls. Layers about as thick as a grain show how grains are ordered at a wall. Cost: linear.
#ifndef SCREE_AVERAGE_LAYERS_H
#define SCREE_AVERAGE_LAYERS_H

#include "average/sample.h"
#include "average/table.h"

enum { SCREE_AVERAGE_LAYER_LINES = 72 };

typedef struct scree_average_layers {
    double low, thickness; ///< m
    size_t count;
} scree_average_layers;

/// Layers of a finished sample from its lowest to its highest point, one mean diameter thick; 5 at least, 200 at most.
/// Where it repeats itself in height, they fill the cell.
scree_average_layers scree_average_layers_of(const scree_average_sample *sample);

/// Rows of layers, the lowest first: height [m] of the middle, solid_fraction, velocity_x, velocity_y, in 3D velocity_z
/// [m/s]; NAN where no grain is. Errors: memory.
scree_status scree_average_layers_table(const scree_average_sample *sample, const scree_average_layers *layers,
                                        scree_average_table *table, scree_error *error) SCREE_MUST_USE;

#endif
