/// Rows of the reproduction page: how they are written, and what a page that stands says in them.
#ifndef SCREE_SWEEP_PAGE_ROW_H
#define SCREE_SWEEP_PAGE_ROW_H

#include "sweep/answer.h"

#include <stdio.h>

/// A cell of a table: what would end it is escaped.
void scree_page_cell_write(FILE *file, const char *text);

/// Above the rows of a case.
#define SCREE_PAGE_ROW_HEAD                                                                                            \
    "\n| id | kind | statement | where | source | criterion | ours | realisations | verdict | form | remark |\n"       \
    "|---|---|---|---|---|---|---|---|---|---|---|\n"
void scree_page_row_head(FILE *file);

/// One row; `first` has what the statement says, `counted` the verdict in bold.
void scree_page_row_write(FILE *file, const scree_statement *s, const scree_answer *a, const char *form, bool first,
                          bool counted);

/// What the rows of a statement say.
typedef struct scree_page_rows {
    scree_verdict verdict; ///< the one that counts
    size_t intervals;      ///< 1 if it rests on an interval
    size_t full, others;   ///< realisations of the full form, and of others
    size_t planned;        ///< realisations that were asked for, with a value or not
} scree_page_rows;

/// Reads the rows of a statement in `section`, `length` characters of a page. False where they do not say the same of
/// it word for word (kind, statement, source, value, criterion), or no verdict counts. Errors: memory (false).
bool scree_page_row_read(const char *section, size_t length, const scree_statement *s, scree_page_rows *rows);

/// Writes these rows as they stand there. Errors: memory (false).
bool scree_page_row_copy(const char *section, size_t length, const scree_statement *s, FILE *file);

#endif
