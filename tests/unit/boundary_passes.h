/// The passes of a boundary by hand.
#ifndef SCREE_TESTS_BOUNDARY_PASSES_H
#define SCREE_TESTS_BOUNDARY_PASSES_H

#include "testing.h"

#include "boundary/boundary.h"

static inline scree_status boundary_pass(const scree_boundary *boundary, scree_phase phase, const scree_model *model,
                                         scree_state *state, scree_work *work, scree_error *error)
{
    const scree_context context = {.model = model, .state = state, .work = work, .boundary = boundary};
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < boundary->pass_count && !status; k++)
        if (boundary->passes[k].phase == phase) status = boundary->passes[k].run(&context, error);
    return status;
}

/// The forces of its loads.
static inline void boundary_load(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                 scree_work *work)
{
    scree_error error;
    assert_int_equal(boundary_pass(boundary, SCREE_PHASE_LOADS, model, state, work, &error), SCREE_OK);
}

/// The second half of their work.
static inline void boundary_follow(const scree_boundary *boundary, const scree_model *model, scree_state *state)
{
    scree_error error;
    assert_int_equal(boundary_pass(boundary, SCREE_PHASE_FOLLOW, model, state, NULL, &error), SCREE_OK);
}

#endif
