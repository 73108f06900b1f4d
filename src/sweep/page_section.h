/// Sections of the reproduction page: one a case of a source.
#ifndef SCREE_SWEEP_PAGE_SECTION_H
#define SCREE_SWEEP_PAGE_SECTION_H

#include "sweep/page_row.h"
#include "sweep/verdict.h"

typedef size_t scree_page_counts[SCREE_CLASSES][SCREE_VERDICTS];

/// A part of a page; it points into the text.
typedef struct scree_page_section {
    const char *text;
    size_t length; ///< 0: it is not there
} scree_page_section;

/// The section of a case below the heading of its source. `page`: NULL for none.
scree_page_section scree_page_section_find(const char *page, const char *source, const char *name);

/// Whether all statements of the case, and no others, stand there word for word, with what the table says about them,
/// and rest on more than in `other`: verdicts with an
/// interval come first, then realisations of the full form, then the others, then those without a value. What rests on
/// nothing at all outweighs nothing.
bool scree_page_section_outweighs(const scree_page_section *section, const scree_page_section *other,
                                  const scree_statement_group *group);

/// The same of one statement, where something was asked for at least: *rows are those that stand there.
bool scree_page_section_outweighs_in(const scree_page_section *section, const scree_page_section *other,
                                     const scree_statement *s, scree_page_rows *rows);

/// Adds the verdicts that count.
void scree_page_section_count(const scree_page_section *section, const scree_statement_group *group,
                              scree_page_counts *counts);

#endif
