/// What a binary impact gave.
#ifndef SCREE_RUN_STAGE_COLLIDE_H
#define SCREE_RUN_STAGE_COLLIDE_H

#include "io/summary.h"
#include "run/simulation.h"

/// Names in summary.json, when the last stage is `collide` and the bodies have parted: `restitution`,
/// `relaxation_time`, and both as the closed form of the law has them (`..._theory`). Errors: those of
/// theory/restitution.h.
scree_status scree_collide_results(const scree_simulation *s, scree_summary *summary,
                                   scree_error *error) SCREE_MUST_USE;

/// Time [s] from the begin of the stage until the bodies of `s`, which is in it, are expected to part.
double scree_collide_expected(const scree_simulation *s);

#endif
