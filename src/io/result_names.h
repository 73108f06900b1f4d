/// The one table of results: every name that summary.json can have, with its unit and its meaning. What a run writes is
/// checked against it, and so is what a sweep wants to average before any member runs.
#ifndef SCREE_IO_RESULT_NAMES_H
#define SCREE_IO_RESULT_NAMES_H

#include "module/module.h"

/// "_work": of each wall of the case, after the wall's name. The unit is NULL of a text.
typedef scree_column scree_result_name;

extern const scree_result_name scree_result_names[];
extern const size_t scree_result_names_count;

/// The row of a result, of this table or of a module's columns; NULL when there is none. *wall (may be NULL) is the
/// length of the name of the wall, or of what else has such results, in `name`, 0 when it has none.
const scree_result_name *scree_result_name_find(const char *name, size_t *wall);

/// The name that is nearest to `name`, or NULL when none is near.
const char *scree_result_name_nearest(const char *name);

#endif
