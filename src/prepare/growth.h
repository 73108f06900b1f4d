/// What a case says of growth.
#ifndef SCREE_PREPARE_GROWTH_H
#define SCREE_PREPARE_GROWTH_H

#include "prepare/prepare.h"

typedef struct scree_growth_config {
    double solid_fraction; ///< 1; auto: 80 % of discs, 60 % of spheres, less what the walls take
} scree_growth_config;

/// Places the bodies of `packing`, whose box and radii [m] are given, by growth. *overlap: the largest that is left, in
/// mean radii of the model. Errors: the box is too small; memory.
scree_status scree_packing_grow(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                                double *overlap, scree_error *error) SCREE_MUST_USE;

#endif
