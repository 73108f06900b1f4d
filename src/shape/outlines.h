/// Outlines of the grains of a sample as they lie: between them are the gaps that decide where the outer boundary of
/// the sample runs (search/peel_rule.h).
#ifndef SCREE_SHAPE_OUTLINES_H
#define SCREE_SHAPE_OUTLINES_H

#include "shape/core_pair.h"
#include "state/state.h"

typedef struct scree_outlines {
    scree_core *core;    ///< one a grain, in the order of their ids; NULL: all are round, and their radii say it all
    double (*corner)[2]; ///< m, of all, turned
} scree_outlines;

/// Those of all processes where the state is a part: 40 bytes a grain of the whole sample in each; all of them call it.
/// Angles are those of the bodies now, whatever of a step has been done; the bits are those of the corners that
/// contacts see. Errors: memory. Cost: O(corners); nothing where all bodies are round.
scree_status scree_outlines_find(const scree_state *state, scree_outlines *outlines, scree_error *error) SCREE_MUST_USE;

/// The same as the bodies lay at the start of the stage, for their places then (state->reference).
scree_status scree_outlines_find_reference(const scree_state *state, scree_outlines *outlines,
                                           scree_error *error) SCREE_MUST_USE;
void scree_outlines_destroy(scree_outlines *outlines);

#endif
