/// A body of the Delaunay boundary that is taken out of the state.
#ifndef SCREE_BOUNDARY_BOUNDARY_FORGET_H
#define SCREE_BOUNDARY_BOUNDARY_FORGET_H

#include "state/state.h"

/// Closes the boundary without the body with this id, if it is of the boundary; the search that follows finds it anew.
void scree_boundary_forget(scree_state *state, uint32_t id);

#endif
