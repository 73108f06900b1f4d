/// The names that summary.json can have: those of the run itself, which stand here, and those that modules declare.
/// What a run writes is checked against them, and so is what a sweep wants to average before any member runs.
#ifndef SCREE_IO_RESULT_NAMES_H
#define SCREE_IO_RESULT_NAMES_H

#include "module/module.h"

extern const scree_result scree_run_results[];
extern const size_t scree_run_results_count;

/// The name of a row, behind that of what it is about. Errors: SCREE_ERROR_INPUT when it is too long.
scree_status scree_result_call(char name[SCREE_RESULT_NAME], const char *about, const scree_result *row,
                               scree_error *error) SCREE_MUST_USE;

/// Whether `name` is more than `ending` and ends so.
bool scree_result_ends(const char *name, const char *ending);

/// The row of a result; NULL when there is none. *module (may be NULL): whose row it is; NULL: of the run itself.
const scree_result *scree_result_name_find(const char *name, const scree_module **module);

/// The name that is nearest to `name`, or NULL when none is near.
const char *scree_result_name_nearest(const char *name);

#endif
