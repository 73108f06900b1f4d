/// The runs behind a page: which, how many, of what build and what preparation.
#ifndef SCREE_SWEEP_RUNS_TABLE_H
#define SCREE_SWEEP_RUNS_TABLE_H

#include "sweep/findings.h"
#include "sweep/page_section.h"

#include <stdio.h>

/// A table with a row for each point and form of the runs called `name`, and those rows of the section `former` (NULL:
/// of none) that tell of other points and forms, or of more seeds; nothing when there are none.
void scree_runs_table_write(const scree_findings *findings, const char *name, const scree_page_section *former,
                            FILE *file);

/// Writes a section that stays, as it is but for what the seeds of its runs say beside the sweep as it is now.
void scree_runs_table_renew(const scree_page_section *section, const char *name, FILE *file);

#endif
