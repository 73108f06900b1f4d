/// Initial assemblies. Each method fills positions, radii, masses and material of a created state.
#ifndef SCREE_PREPARE_PREPARE_H
#define SCREE_PREPARE_PREPARE_H

#include "state/state.h"

/// Box that a method fills: x in [0, width], y in [0, height] in 2D; x in [0, width], y in [0, depth], z in [0, height]
/// in 3D. `height` is set by the method to the top of the packing.
typedef struct scree_box {
    double width, depth, height;
    unsigned periodic; ///< mask of axes along which the box repeats itself: 1 x, 2 y, 4 z
} scree_box;

/// A packing in the making: species, radii, and centres in the box, in the order of placement.
typedef struct scree_packing {
    int dimension; ///< 2 or 3
    size_t count;
    double *radius; ///< m, bounding
    uint8_t *species;
    uint32_t *number; ///< as which each was drawn
    double *place[3];    ///< m, x, y, z; z is NULL in 2D
    double aspect_ratio; ///< 1, height over width where the width is auto
    scree_box box;
} scree_packing;

/// Makes room for `count` bodies. Errors: memory; nothing is kept then.
scree_status scree_packing_create(scree_packing *packing, int dimension, size_t count,
                                  scree_error *error) SCREE_MUST_USE;
void scree_packing_destroy(scree_packing *packing);

/// Draws species and radii of all bodies, each by its index.
void scree_packing_draw(const scree_model *model, scree_packing *packing);

/// Body `index` becomes what body `other` of another packing is, place excepted.
static inline void scree_packing_take(scree_packing *packing, size_t index, const scree_packing *from, size_t other)
{
    packing->radius[index] = from->radius[other];
    packing->species[index] = from->species[other];
    packing->number[index] = from->number[other];
}

/// Area (2D) or volume (3D) of the bodies.
double scree_packing_solid(const scree_packing *packing);

/// Largest radius.
double scree_packing_largest(const scree_packing *packing);

/// Width and depth of the box where they are NAN (one not below `least`), and the height that the bodies need, for
/// bodies of `solid` area or volume at this solid fraction.
void scree_packing_fit_box(scree_packing *packing, double solid, double solid_fraction, double least);

/// Makes `packing`, whose radii need not be drawn, the middle of a larger one that `method` makes: the bodies that
/// reach least far from its centre, in a box that just holds their circle or ball.
scree_status scree_packing_cut_round(const scree_model *model, const scree_config_stage *stage,
                                     const scree_preparation *method, scree_packing *packing,
                                     scree_error *error) SCREE_MUST_USE;

/// Creates the state: radii, positions, masses (density * pi R^2 * thickness, density * 4/3 pi R^3), outlines of bodies that are not round, walls of the box,
/// ids in order of placement. A round sample (stage->outline) is the middle of a larger packing; its walls bound it but
/// are not active.
scree_status scree_prepare(const scree_model *model, const scree_config_stage *stage, scree_state *state,
                           scree_error *error) SCREE_MUST_USE;

#endif
