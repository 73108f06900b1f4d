/// What the methods share.
#ifndef SCREE_PREPARE_METHODS_H
#define SCREE_PREPARE_METHODS_H

#include "model/model.h"

/// Of the key `solid_fraction`, which several methods share.
#define SCREE_SOLID_FRACTION_MEANING                                                                                   \
    "Area (volume) of the particles over that of the box; auto: 30 % of discs and 15 % of spheres in a gas; with "     \
    "growth 80 % and 60 %, less what the walls take; of a dense packing 90 % and 64 %."

/// Input error at a key of `stage`, with its place in the list of stages when it is one of the model's.
scree_status scree_prepare_error(scree_error *error, const scree_model *model, const scree_config_stage *stage,
                                 const char *key, const char *format, ...) SCREE_PRINTF(5, 6);

/// The error that a box (width, depth, height [m]; no depth in 2D) is too small for the largest body, of this radius or
/// bounding radius [m]; names the side that the case gives, else the solid fraction.
scree_status scree_prepare_refuse_box(const scree_model *model, const scree_config_stage *stage, double largest,
                                      const double box[3], scree_error *error);

/// The error that a sample that repeats itself is, or will be, too narrow along an axis: `side` where more than
/// `needed` [m] is wanted. Names the side that the case gives, else the aspect ratio.
scree_status scree_prepare_refuse_side(const scree_model *model, const scree_config_stage *stage, int axis,
                                       bool will_be, double side, double needed, scree_error *error);

/// Index of the cell of size `cell` that holds a coordinate, kept within [0, count).
static inline size_t scree_cell_within(double coordinate, double cell, size_t count)
{
    if (!(coordinate > 0)) return 0;
    double index = coordinate / cell;
    return index < (double)count ? (size_t)index : count - 1;
}

#endif
