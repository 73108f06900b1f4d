/// Which body to blame when an evaluation has gone wrong.
#ifndef SCREE_CONTACT_DIAGNOSTICS_H
#define SCREE_CONTACT_DIAGNOSTICS_H

#include "state/work.h"

/// Looks for rows that are not finite, overlaps above the guard's limit and forces above `force_limit` [N] (or
/// NaN), and raises SCREE_FLAG_NAN, _OVERLAP or _FORCE_RANGE, with the smallest id that shows the first of these. Cost:
/// a scalar pass over bodies and pairs; called only when something is wrong.
void contact_diagnose(const scree_model *model, const scree_state *state, scree_work *work, double force_limit);

#endif
