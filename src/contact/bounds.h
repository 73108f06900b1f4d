/// Strict bounds of what one contact can contribute in the next evaluation: they set the quanta of the integer sums.
#ifndef SCREE_CONTACT_BOUNDS_H
#define SCREE_CONTACT_BOUNDS_H

#include "state/state.h"

/// Number of bits that one contribution to the ledger may fill, so that the sum over all contacts fits in 63: a plane
/// assembly of N bodies has fewer than 3 N contacts and at most 4 N with walls; `count` = N.
int contact_energy_bits(size_t count);

typedef struct contact_bounds {
    double force;    ///< N
    double damping;  ///< J, dissipated by damping in one contact and step
    double friction; ///< J, the same for friction and for the stiffness channel
} contact_bounds;

/// Bounds for the evaluation at the present positions, from the largest overlap of the last evaluation and the largest
/// speed of the drift since then.
contact_bounds contact_bounds_get(const scree_model *model, const scree_state *state);

/// Largest indentation over the smaller radius that the case allows; 1 without a config.
static inline double contact_overlap_limit(const scree_model *model)
{
    return model->config ? model->config->guard.overlap : 1.0;
}

#endif
