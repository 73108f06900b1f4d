/// Force chains by the criterion of Peters et al.: quasi-linear sets of at least three highly stressed grains.
///
/// Of each grain the largest principal pressure (of minus its moment over its volume) and its direction. A grain is
/// highly stressed when this pressure is above the mean over all grains that touch something. Two of them that touch
/// are linked when the line through their centres makes less than ALPHA with the direction of both: forwards and
/// backwards alike. What hangs together by links, three grains or more, is a chain; it may branch.
///
/// Source: J. F. Peters, M. Muthuswamy, J. Wibowo, A. Tordesillas, Phys. Rev. E 72, 041307 (2005), with their angle of
/// 45 degrees. Theirs walks along one chain and ends it where it bends more; branches count as chains of their own
/// there.
#ifndef SCREE_AVERAGE_CHAINS_H
#define SCREE_AVERAGE_CHAINS_H

#include "average/sample.h"

typedef struct scree_average_chains {
    size_t chains, grains, longest; ///< number; grains in them; in the one with the most
    double grain_share;             ///< of the grains that touch something
    double pressure_share;          ///< of the sum of pressure times volume of all grains that the chains bear
    double length;                  ///< mean number of grains of a chain; NAN without one
} scree_average_chains;

/// linked: a contact, 1 where it is a link of a chain; may be NULL. alpha: rad. Errors: memory.
scree_status scree_average_chains_find(const scree_average_sample *sample, double alpha, uint8_t *linked,
                                       scree_average_chains *chains, scree_error *error) SCREE_MUST_USE;

#endif
