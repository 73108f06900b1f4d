/// A binary impact: with the two having parted in the last stage of a case, the results `restitution`,
/// `relaxation_time`, and both as the closed form of the law has them (`..._theory`). Errors: those of
/// theory/restitution.h.
#ifndef SCREE_RUN_STAGE_COLLIDE_H
#define SCREE_RUN_STAGE_COLLIDE_H

#include "run/simulation.h"

/// Time [s] from the begin of the stage until the bodies of `s`, which is in it, are expected to part.
double scree_collide_expected(const scree_simulation *s);

#endif
