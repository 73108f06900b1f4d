/// What the methods share.
#ifndef SCREE_PREPARE_METHODS_H
#define SCREE_PREPARE_METHODS_H

#include "model/model.h"

/// Input error at a key of `stage`, with its place in the list of stages when it is one of the model's.
scree_status scree_prepare_error(scree_error *error, const scree_model *model, const scree_config_stage *stage,
                                 const char *key, const char *format, ...) SCREE_PRINTF(5, 6);

/// Index of the cell of size `cell` that holds a coordinate, kept within [0, count).
static inline size_t scree_cell_within(double coordinate, double cell, size_t count)
{
    if (!(coordinate > 0)) return 0;
    double index = coordinate / cell;
    return index < (double)count ? (size_t)index : count - 1;
}

#endif
