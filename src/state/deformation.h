/// Bodies that deform uniformly (contact/deformation.c): what the run remembers of them beside state->strain.
#ifndef SCREE_STATE_DEFORMATION_H
#define SCREE_STATE_DEFORMATION_H

#include "state/state.h"

/// State of the module `deformation`.
typedef struct scree_deformation {
    double given;         ///< J, energy that the bodies have taken up with their strains: stored, and lost by the lag
    double largest_reach; ///< m, of all bodies: no surface has moved out by more
    double growth;        ///< m, largest way that a surface goes in the step that comes to its forces (derived)
    double *term;         ///< J, one a body, for sums over them (derived)
} scree_deformation;

static inline scree_deformation *scree_deformation_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_deformation];
}

#endif
