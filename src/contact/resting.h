/// What walls of the case that stand and bodies that sleep exert on each other: it does not change (state/sleep.h).
#ifndef SCREE_CONTACT_RESTING_H
#define SCREE_CONTACT_RESTING_H

#include "contact/job.h"
#include "contact/single.h"
#include "contact/surfaces.h"
#include "state/sleep.h"

/// The contacts of one body with the elements of the walls.
typedef struct contact_wall_group {
    size_t begin, end; ///< in work->primitive_pairs
    uint32_t row;
    bodies body;
    primitive_touches touches;
} contact_wall_group;

/// The body whose pairs begin at `begin`.
contact_wall_group contact_wall_group_at(const scree_state *state, const scree_work *work, size_t begin);

/// What contact `k` of it exerts on the body, evaluated again with a step of zero; false: its wall can move.
bool contact_standing_wall(const scree_model *model, const scree_state *state, const scree_work *work,
                           const contact_wall_group *group, int k, contact_quanta *exerted);

/// Sums for the walls that stand what all that sleep exert on them; for each list of those that sleep.
void contact_sum_resting_loads(const scree_model *model, scree_state *state, const scree_work *work);

/// Adds them to the totals of a step.
void contact_resting_loads(const scree_state *state, const contact_scale *scale, contact_totals *totals);

#endif
