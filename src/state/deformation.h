/// Bodies that deform uniformly (contact/deformation.c): what the run remembers of them beside state->strain.
#ifndef SCREE_STATE_DEFORMATION_H
#define SCREE_STATE_DEFORMATION_H

#include "state/state.h"

/// How strain changes in a step; derived.
typedef struct scree_strain_change {
    double value[6]; ///< 1; 2D: xx, yy, xy; 3D: xx, yy, zz, yz, xz, xy
    double term;     ///< J, a term of a sum over the bodies
    double unused;   ///< zero
} scree_strain_change;

/// State of the module `deformation`.
typedef struct scree_deformation {
    double given;         ///< J, energy that the bodies have taken up with their strains: stored, and lost by the lag
    double largest_reach; ///< m, of all bodies: no surface has moved out by more
    double growth;        ///< m, largest way that a surface goes in the step that comes to its forces (derived)
    scree_strain_change *change; ///< one a body (derived)
} scree_deformation;

static inline scree_deformation *scree_deformation_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_deformation];
}

#endif
