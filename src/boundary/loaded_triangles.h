/// Which triangles of the hull carry the lateral pressure (3D).
#ifndef SCREE_BOUNDARY_LOADED_TRIANGLES_H
#define SCREE_BOUNDARY_LOADED_TRIANGLES_H

#include "measure/delaunay_boundary.h"
#include "state/state.h"

/// Fills hull->loaded of a hull of the bodies of `state` from their present positions; `hull` need not be the one of
/// the state. The rule is in loaded_triangles.c. Errors: memory.
scree_status scree_hull_mark_loaded(const scree_model *model, const scree_state *state, scree_hull *hull,
                                    scree_error *error) SCREE_MUST_USE;

#endif
