/// What contacts with ghosts of a periodic cell give to the bodies, and the virial.
#ifndef SCREE_CONTACT_GHOST_FORCES_H
#define SCREE_CONTACT_GHOST_FORCES_H

#include "base/reduction.h"
#include "state/periodic.h"
#include "state/work.h"

/// What the virial of a whole cell is made of.
typedef struct scree_virial {
    bool whole;            ///< there is one
    int64_t faces[9];      ///< over the ghosts, of force (x) lattice vectors to the body [quanta]
    scree_wide_sum bodies; ///< of force (x) place [quanta times `bound`]
    double bound, largest; ///< m: that the sum was made with; of the coordinates
} scree_virial;

/// Adds the sums of all ghosts to those of their bodies; in a whole cell, finds what the virial is made of here, and
/// lists it among what has to be joined. Sums of all rows (scree_row_count) are complete. Nothing without ghosts.
void scree_ghosts_add_back(scree_state *state, scree_work *work, scree_virial *virial, scree_reduction *together);

/// What was listed has been joined: in a whole cell, sets scree_cell(state)->virial. All processes call it.
void scree_ghosts_settle_virial(const scree_state *state, scree_work *work, scree_virial *virial);

#endif
