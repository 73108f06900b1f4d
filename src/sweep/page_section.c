/// Sections of a page that was written before. Runs may be gone while the page still tells what they gave: a section
/// that rests on more of them than the folders hold stays as it is, and so do rows of single statements.
#include "sweep/page_section.h"

#include <stdio.h>
#include <string.h>

/// The part of a text from the line `heading` on, up to the next heading of the same level or above.
static scree_page_section part_of(scree_page_section whole, const char *level, const char *heading)
{
    char line[400];
    (void)snprintf(line, sizeof line, "\n%s %.300s\n", level, heading);
    const char *end = whole.text + whole.length, *begin = whole.text ? strstr(whole.text, line) : NULL;
    if (!begin || begin >= end) return (scree_page_section){NULL, 0};
    const size_t depth = strlen(level);
    for (const char *at = strstr(begin + 1, "\n#"); at && at < end; at = strstr(at + 1, "\n#")) {
        const size_t marks = strspn(at + 1, "#");
        if (marks > depth || at[1 + marks] != ' ') continue;
        end = at;
        break;
    }
    return (scree_page_section){begin, (size_t)(end - begin)};
}

scree_page_section scree_page_section_find(const char *page, const char *source, const char *name)
{
    const scree_page_section whole = {page, page ? strlen(page) : 0};
    return part_of(part_of(whole, "##", source), "###", name);
}

/// Sums of realisations. False if a statement is not there word for word.
static bool weigh(const scree_page_section *section, const scree_statement_group *group, scree_page_rows *sum)
{
    *sum = (scree_page_rows){.verdict = SCREE_NOT_RUN};
    for (int64_t k = 0; k < group->statement_count; k++) {
        scree_page_rows rows;
        if (!scree_page_row_read(section->text, section->length, &group->statements[k], &rows)) return false;
        sum->intervals += rows.intervals;
        sum->full += rows.full;
        sum->others += rows.others;
        sum->planned += rows.planned;
    }
    return true;
}

static const char *found_in(const scree_page_section *section, const char *text)
{
    const char *at = strstr(section->text, text);
    return at && at < section->text + section->length ? at : NULL;
}

static bool has_statement(const scree_statement_group *group, const char *id, size_t length)
{
    for (int64_t k = 0; k < group->statement_count; k++)
        if (strlen(group->statements[k].id) == length && memcmp(group->statements[k].id, id, length) == 0) return true;
    return false;
}

/// No row of a statement that the table has no more.
static bool has_its_own_rows(const scree_page_section *section, const scree_statement_group *group)
{
    const char *head = found_in(section, SCREE_PAGE_ROW_HEAD);
    const char *line = head ? head + strlen(SCREE_PAGE_ROW_HEAD) - 1 : NULL;
    for (; line && strncmp(line, "\n| ", 3) == 0; line = strchr(line + 1, '\n'))
        if (!has_statement(group, line + 3, strcspn(line + 3, " \n"))) return false;
    return true;
}

/// What is said of the case, and of rows without agreement, is what the table says.
static bool has_its_own_words(const scree_page_section *section, const scree_statement_group *group)
{
    bool same = found_in(section, group->meaning);
    for (int64_t k = 0; k < group->statement_count && same; k++) {
        const scree_statement *s = &group->statements[k];
        scree_page_rows rows;
        const bool told = s->explanation[0] && scree_page_row_read(section->text, section->length, s, &rows) &&
                          scree_verdict_is_open(rows.verdict);
        same = !told || found_in(section, s->explanation);
    }
    return same;
}

/// One run of the full form says less than several of another, which give an interval.
static bool weigh_more(const scree_page_rows *mine, const scree_page_rows *theirs)
{
    if (mine->intervals != theirs->intervals) return mine->intervals > theirs->intervals;
    if (mine->full != theirs->full) return mine->full > theirs->full;
    if (mine->others != theirs->others) return mine->others > theirs->others;
    return mine->planned > theirs->planned;
}

bool scree_page_section_outweighs(const scree_page_section *section, const scree_page_section *other,
                                  const scree_statement_group *group)
{
    scree_page_rows mine, theirs;
    if (section->length == 0 || !weigh(section, group, &mine) || !weigh(other, group, &theirs)) return false;
    if (!has_its_own_rows(section, group) || !has_its_own_words(section, group)) return false;
    return weigh_more(&mine, &theirs) || theirs.planned == 0;
}

bool scree_page_section_outweighs_in(const scree_page_section *section, const scree_page_section *other,
                                     const scree_statement *s, scree_page_rows *rows)
{
    scree_page_rows theirs;
    return section->length > 0 && scree_page_row_read(section->text, section->length, s, rows) &&
           scree_page_row_read(other->text, other->length, s, &theirs) && weigh_more(rows, &theirs);
}

void scree_page_section_count(const scree_page_section *section, const scree_statement_group *group,
                              scree_page_counts *counts)
{
    for (int64_t k = 0; k < group->statement_count; k++) {
        scree_page_rows rows;
        (void)scree_page_row_read(section->text, section->length, &group->statements[k], &rows);
        (*counts)[group->statements[k].class][rows.verdict]++;
    }
}
