/// summary.json: named scalars and texts of a run (jansson), replaced as a whole.
#ifndef SCREE_IO_SUMMARY_H
#define SCREE_IO_SUMMARY_H

#include "base/error.h"
#include "case/former.h"

#include <stdint.h>

typedef struct scree_summary scree_summary;

scree_status scree_summary_create(scree_summary **summary, scree_error *error) SCREE_MUST_USE;
void scree_summary_destroy(scree_summary *summary);
/// Names are kept in the order of first setting. NAN becomes null. Setting again replaces.
void scree_summary_set_number(scree_summary *summary, const char *name, double value);
void scree_summary_set_integer(scree_summary *summary, const char *name, int64_t value);
void scree_summary_set_text(scree_summary *summary, const char *name, const char *value);
/// Behind what the text holds, with "; " between.
void scree_summary_add_text(scree_summary *summary, const char *name, const char *value);
/// What was set; NAN of what was not, or is no number.
double scree_summary_number(const scree_summary *summary, const char *name);
/// A name that is not in the table of results (io/result_names.h), or NULL.
const char *scree_summary_unknown(const scree_summary *summary);
scree_status scree_summary_write(const scree_summary *summary, const char *path, scree_error *error) SCREE_MUST_USE;

/// scree_result_get with a table of former names of results.
scree_status scree_result_find(const char *directory, const char *name, const scree_former_result *former, char *value,
                               size_t size, scree_error *error) SCREE_MUST_USE;

#endif
