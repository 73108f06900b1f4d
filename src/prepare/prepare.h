/// Initial assemblies. Each method fills positions, radii, masses and material of a created state.
#ifndef SCREE_PREPARE_PREPARE_H
#define SCREE_PREPARE_PREPARE_H

#include "state/state.h"

/// Box that a method fills: x in [0, width], y in [0, height]; `height` is set by the method to the top of the packing.
typedef struct scree_box {
    double width, height;
} scree_box;

typedef struct scree_preparation {
    const char *name;
    const char *meaning;
    /// radius: count radii already drawn; x, y: count centres to fill; box in/out, width NAN for auto. Errors: does
    /// not fit, memory.
    scree_status (*place)(const scree_model *model, const scree_config_stage *stage, const double *radius, size_t count,
                          double *x, double *y, scree_box *box, scree_error *error);
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
