/// Members of a sweep that begin with one sample (`share` of a sweep file).
#ifndef SCREE_SWEEP_SHARE_H
#define SCREE_SWEEP_SHARE_H

#include "case/problems.h"
#include "sweep/sweep.h"

/// leader[member]: the first member whose case says the same up to the end of the stage `share`, which may be itself;
/// without `share` each is its own. Cost: each case is compared with those of the leaders. Errors: memory.
scree_status scree_share_find(const scree_sweep *sweep, size_t *leader, scree_error *error) SCREE_MUST_USE;

/// Notes that `share` is no stage of a case, or not before another one.
void scree_share_check(scree_reader *reader, const scree_sweep *sweep);

#endif
