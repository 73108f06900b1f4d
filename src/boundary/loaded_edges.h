/// Which edges of the Delaunay boundary carry the lateral pressure.
#ifndef SCREE_BOUNDARY_LOADED_EDGES_H
#define SCREE_BOUNDARY_LOADED_EDGES_H

#include "measure/delaunay_boundary.h"
#include "state/state.h"

/// Fills scree_loop_of(state)->loaded from the present positions. The rule is in loaded_edges.c.
void scree_loop_mark_loaded(const scree_model *model, scree_state *state);

#endif
