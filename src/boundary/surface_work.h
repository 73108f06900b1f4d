/// Work of loads over what the strains of bodies do to the surfaces that they act on.
#ifndef SCREE_BOUNDARY_SURFACE_WORK_H
#define SCREE_BOUNDARY_SURFACE_WORK_H

#include "state/state.h"

/// Half of the work [J] over the last change of the strains. surface: of each row, sum of direction (x) force [N] over
/// the points where a load comes in, directions from the centre; symmetric: xx, yy, xy; xx, yy, zz, yz, xz, xy.
double scree_surface_half_work(const scree_state *state, const double (*surface)[6]);

/// Adds direction (x) force, symmetric, to such a tensor.
void scree_surface_add(int dimension, const double direction[3], const double force[3], double surface[6]);

#endif
