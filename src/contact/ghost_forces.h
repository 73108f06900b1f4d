/// What contacts with ghosts of a periodic cell give to the bodies, and the virial.
#ifndef SCREE_CONTACT_GHOST_FORCES_H
#define SCREE_CONTACT_GHOST_FORCES_H

#include "state/periodic.h"
#include "state/work.h"

/// Adds the sums of all ghosts to those of their bodies and, in a whole cell, sets scree_cell(state)->virial. Sums of
/// all rows (scree_row_count) are complete. Nothing without ghosts.
void scree_ghosts_add_back(scree_state *state, scree_work *work);

#endif
