/// What stands on what: whether a piston from above would meet a grain first.
#ifndef SCREE_SELECTION_TOP_H
#define SCREE_SELECTION_TOP_H

#include "state/state.h"

/// The row of a grain that stands over the one in `row`: its centre is higher, and its circle reaches over the middle
/// half of the other's; SCREE_NO_ROW: there is none, and a piston half as wide as the grain can press on it. Radii are
/// those of the discs (spheres) of equal area (volume). Cost: linear in the bodies.
uint32_t scree_row_above(const scree_state *state, size_t row);

/// Ends of the sample along an axis [m]: of its grains.
void scree_grains_ends(const scree_state *state, int axis, double end[2]);

#endif
