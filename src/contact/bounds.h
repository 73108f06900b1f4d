/// Strict bounds of what one contact can contribute in the next evaluation: they set the quanta of the integer sums.
#ifndef SCREE_CONTACT_BOUNDS_H
#define SCREE_CONTACT_BOUNDS_H

#include "state/state.h"

/// Number of bits that one contribution to the ledger may fill, so that the sum over all contacts fits in 63. A plane
/// assembly of `count` bodies has fewer than 3 contacts a body and at most 4 with walls. In space the mean coordination
/// of spheres is below 8 + 4 sqrt(3) = 14.93 (Kuperberg and Schramm 1994), that is 7.5 contacts a body; 16 leave room
/// for overlaps and walls.
/// Held: pairs of the persistent list, which come to these.
int contact_energy_bits(int dimension, size_t count, size_t held);

/// Bounds for the evaluation at the present positions, from the largest overlap of the last evaluation and the largest
/// speed of the drift since then.
scree_law_bounds contact_bounds_get(const scree_model *model, const scree_state *state);

/// Largest overlap over the smaller radius that the case allows; 1 without a config.
static inline double contact_overlap_limit(const scree_model *model)
{
    return model->overlap_limit;
}

#endif
