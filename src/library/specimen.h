/// The specimen of a simulation as an operator. Private to src/library/.
#ifndef SCREE_LIBRARY_SPECIMEN_H
#define SCREE_LIBRARY_SPECIMEN_H

#include <scree/specimen.h>

#include "specimen/specimen.h"

/// As it stands now. elasticity NULL: of the case. Errors: SCREE_ERROR_INPUT without bodies, or for an elasticity that
/// no particle has; memory.
scree_status library_specimen(scree_simulation *s, const scree_particle_elasticity *elasticity,
                              scree_specimen *specimen, scree_error *error);

#endif
