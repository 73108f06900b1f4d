/// A single contact as a measure sees it, from rows and history: the scalar law without advancing anything.
#ifndef SCREE_CONTACT_SINGLE_H
#define SCREE_CONTACT_SINGLE_H

#include "contact/contact.h"

/// Two bodies whose rows hold v(n - 1/2); false when they do not touch. Leaves `first` and `second` of the contact
/// alone.
bool contact_of_pair(const scree_model *model, const scree_row *first, const scree_row *second,
                     const scree_history *history, scree_contact *contact);

/// A body and a wall.
bool contact_of_wall(const scree_model *model, const scree_row *body, const scree_wall *wall,
                     const scree_history *history, scree_contact *contact);

#endif
