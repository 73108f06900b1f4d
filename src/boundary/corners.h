/// Which edges of the Delaunay boundary carry the lateral pressure.
#ifndef SCREE_BOUNDARY_CORNERS_H
#define SCREE_BOUNDARY_CORNERS_H

#include "state/state.h"

/// Fills state->loop.loaded from the present positions. The rule is in corners.c.
void scree_loop_mark_loaded(const scree_model *model, scree_state *state);

#endif
