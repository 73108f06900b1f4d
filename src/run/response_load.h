/// The load on one grain whose response is told (`measure.response_load`).
#ifndef SCREE_RUN_RESPONSE_LOAD_H
#define SCREE_RUN_RESPONSE_LOAD_H

#include "module/module.h"

typedef struct scree_response_numbers {
    int64_t load; ///< -1: none
    double element, poisson;
} scree_response_numbers;

/// NULL: of no load a response is told.
const scree_response_numbers *scree_response_numbers_of(const scree_model *model);

/// Whether the stage that begins is the first one in which the load acts.
bool scree_response_load_begins(const scree_context *context);

/// The row of the one grain that the load presses on. Errors: SCREE_ERROR_INPUT: it presses on several.
scree_status scree_response_find_loaded(const scree_model *model, const scree_state *state, int64_t load,
                                        uint32_t *found, scree_error *error) SCREE_MUST_USE;

/// The load begins to act: it presses on one grain at the top, and elements of side `element` lie within the layer.
/// Errors: SCREE_ERROR_INPUT with its key; memory.
scree_status scree_response_check_load(const scree_context *context, scree_error *error) SCREE_MUST_USE;

/// Whether the friction of a contact is used up (to 0.1 %). friction: its coefficient; forces in N.
bool scree_response_slides(double friction, double tangential_force, double normal_force);

#endif
