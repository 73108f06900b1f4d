/// The columns of series.csv: those of run/sample.c, then those that modules declare, by their place in the table.
#ifndef SCREE_RUN_COLUMNS_H
#define SCREE_RUN_COLUMNS_H

#include "case/config.h"
#include "io/series.h"
#include "module/module.h"

/// Those of one case.
typedef struct scree_columns {
    scree_series_column *column;
    char (*name)[SCREE_RESULT_NAME]; ///< that `column` points to
    size_t count;
    size_t times[SCREE_MODULE_COUNT]; ///< of how many things each module tells
} scree_columns;

/// Errors: SCREE_ERROR_INPUT when two columns would have one name; memory.
scree_status scree_columns_create(const scree_config *config, scree_columns *columns,
                                  scree_error *error) SCREE_MUST_USE;
void scree_columns_destroy(scree_columns *columns);

/// Whether modules have columns in this case and need the whole sample for them.
bool scree_columns_look_at_whole(const scree_config *config);

/// Number of a column; `count` when there is none of this name.
size_t scree_columns_find(const scree_columns *columns, const char *name);

/// Fills the values of those of the modules' columns that are measured in parts, or of the others; those of
/// run/sample.c are there.
scree_status scree_columns_measure(const scree_columns *columns, const scree_context *context, bool in_parts,
                                   double *value, scree_error *error) SCREE_MUST_USE;

/// Names of the modules that have columns in this case and need the whole sample for them, in `names` of `size` bytes;
/// false: there are none, all measure in parts.
bool scree_columns_want_whole(const scree_columns *columns, char *names, size_t size);

/// Whether some case has this column; if not, *nearest is the name that is nearest, or NULL.
bool scree_column_is_known(const char *name, const char **nearest);

#endif
