/// The specimen that a state stands for.
#ifndef SCREE_SPECIMEN_FROM_STATE_H
#define SCREE_SPECIMEN_FROM_STATE_H

#include "contact/contact.h"
#include "specimen/specimen.h"

/// Bodies in the order of their ids, contacts in that of the contact table; springs and dashpots are the tangents of
/// the law at the present normal force. A contact that slides counts with its spring: so limits are those of a specimen
/// that sticks. Walls and plates stand still, components that are prescribed are held. Particles are rigid. Errors:
/// memory.
scree_status scree_specimen_of_state(const scree_model *model, const scree_state *state, const scree_work *work,
                                     scree_specimen *specimen, scree_error *error) SCREE_MUST_USE;

/// All bodies get this compliance.
void scree_specimen_deform(scree_specimen *specimen, scree_compliance compliance);

#endif
