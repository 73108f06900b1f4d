/// Static solutions of a specimen: motions, contact forces and particle strains under forces on bodies and relative
/// displacements that contacts are given.
#ifndef SCREE_SPECIMEN_STATIC_H
#define SCREE_SPECIMEN_STATIC_H

#include "specimen/specimen.h"

/// What acts. Either may be NULL.
typedef struct scree_static_load {
    const double *force;  ///< N, N m on the bodies, as a motion; of held components it does not count
    const double *offset; ///< m, added to the relative displacements q of the contacts
} scree_static_load;

/// motion: scree_specimen_motions numbers; force: contact forces [N]. Both come out. Errors: SCREE_ERROR_INPUT when the
/// forces can move the specimen as a whole, which way is said; SCREE_ERROR_GUARD without convergence; memory.
/// *iterations may be NULL.
scree_status scree_static_solve(const scree_specimen *specimen, const scree_static_load *load, double *motion,
                                double *force, size_t *iterations, scree_error *error)
    __attribute__((warn_unused_result));

#endif
