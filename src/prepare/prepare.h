/// Initial assemblies. Each method fills positions, radii, masses and material of a created state.
#ifndef SCREE_PREPARE_PREPARE_H
#define SCREE_PREPARE_PREPARE_H

#include "state/state.h"

/// Box that a method fills: x in [0, width], y in [0, height]; `height` is set by the method to the top of the packing.
typedef struct scree_box {
    double width, height;
    unsigned periodic; ///< mask of directions in which the box repeats itself
} scree_box;

/// A packing in the making: radii, and centres in the box, in the order of placement.
typedef struct scree_packing {
    size_t count;
    double *radius, *x, *y; ///< m
    scree_box box;
} scree_packing;

typedef struct scree_preparation {
    const char *name;
    const char *meaning;
    bool periodic; ///< can fill a box that repeats itself
    /// Places the discs of `packing` (radii drawn, width of the box given or NAN for auto) and sets its height. A
    /// method may draw other radii from the same distribution. Errors: does not fit, memory.
    scree_status (*place)(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error);
    /// Velocities at the start, when the rows are filled. NULL: at rest.
    void (*set_moving)(const scree_model *model, const scree_config_stage *stage, scree_state *state);
} scree_preparation;

const scree_preparation *scree_preparation_get(scree_prepare_method method);

/// Draws `count` radii from the case's distribution (stream SCREE_RANDOM_RADIUS, counter = index).
void scree_draw_radii(const scree_model *model, double *radius, size_t count);

/// Creates the state: radii, positions, masses (density * pi R^2 * thickness), walls of the box, ids in order of
/// placement.
scree_status scree_prepare(const scree_model *model, const scree_config_stage *stage, scree_state *state,
                           scree_error *error) SCREE_MUST_USE;

#endif
