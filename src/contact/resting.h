/// What bodies that sleep, and walls of the case that stand, exert on them and on each other: it does not change
/// (state/sleep.h).
#ifndef SCREE_CONTACT_RESTING_H
#define SCREE_CONTACT_RESTING_H

#include "contact/job.h"
#include "contact/surfaces.h"

/// Brings it up to date for those that are marked to fall asleep or to wake, and for the walls beside them.
void contact_move_resting(const scree_model *model, scree_state *state, scree_work *work);

/// Adds what all that sleep exert on walls to the totals of a step.
void contact_resting_loads(const scree_state *state, const contact_scale *scale, contact_totals *totals);

#endif
