/// Rows of the reproduction page. The writer and the reader stand together, so that a page can be read back: it may be
/// the only record of runs whose folders are gone.
#include "sweep/page_row.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const verdict_names[] = {"agrees", "differs", "undecided", "not measured", "not run"};
static const char *const class_names[] = {"finding", "check", "beyond"};

void scree_page_row_head(FILE *file)
{
    (void)fputs(SCREE_PAGE_ROW_HEAD, file);
}

void scree_page_cell_write(FILE *file, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '|') (void)fputc('\\', file);
        (void)fputc(*c, file);
    }
    (void)fputs(" | ", file);
}

/// The cells in front of our value; only the first row of a statement says what it is.
static void put_statement(FILE *file, const scree_statement *s, bool first)
{
    (void)fprintf(file, "| %s | ", s->id);
    scree_page_cell_write(file, first ? class_names[s->class] : "");
    scree_page_cell_write(file, first ? s->text : "");
    scree_page_cell_write(file, first ? s->source : "");
    scree_page_cell_write(file, first ? s->given : "");
    scree_page_cell_write(file, first ? s->criterion : "");
}

/// The value with its interval, and how many realisations it rests on.
static void put_value(FILE *file, const scree_statement *s, const scree_answer *a)
{
    const scree_interval *e = &a->interval;
    const char *space = s->unit[0] ? " " : "";
    if (e->count == 0)
        (void)fputs("-", file);
    else if (s->kind == SCREE_CRITERION_HOLDS)
        (void)fprintf(file, "in %zu", a->successes);
    else if (isfinite(e->low) && e->count > 1)
        (void)fprintf(file, "%.4g [%.4g, %.4g]%s%s", e->middle, e->low, e->high, space, s->unit);
    else if (isfinite(e->middle))
        (void)fprintf(file, "%.4g%s%s", e->middle, space, s->unit);
    else
        (void)fputs("-", file);
    (void)fprintf(file, " | %zu of %zu | ", e->count, a->planned);
}

void scree_page_row_write(FILE *file, const scree_statement *s, const scree_answer *a, const char *form, bool first,
                          bool counted)
{
    put_statement(file, s, first);
    put_value(file, s, a);
    const char *mark = counted ? "**" : "";
    (void)fprintf(file, "%s%s%s%s%s | %s | ", counted ? "" : "(", mark, verdict_names[a->verdict], mark,
                  counted ? "" : ")", form);
    scree_page_cell_write(file, a->remark);
    (void)fputs("\n", file);
}

/// How a row of the statement begins. NULL: no memory.
static char *beginning(const scree_statement *s, bool first)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (!file) return NULL;
    put_statement(file, s, first);
    if (fclose(file) == 0) return text;
    free(text);
    return NULL;
}

/// As put_value writes it. What an average over few has between brackets is none, as its remark says.
static bool has_interval(const char *cells, size_t count)
{
    const size_t length = strlen(SCREE_ANSWER_FEW), end = strcspn(cells, "\n");
    for (size_t i = 0; i + length <= end; i++)
        if (memcmp(cells + i, SCREE_ANSWER_FEW, length) == 0) return false;
    return memchr(cells, '[', strcspn(cells, "|")) || (strncmp(cells, "in ", 3) == 0 && count > 1);
}

/// Reads the cells from our value on, which end before the end of the line.
static bool read_cells(const char *cells, scree_page_rows *rows, bool *counted)
{
    size_t count, planned;
    char verdict[32], form[16];
    if (sscanf(cells, "%*[^|]| %zu of %zu | %31[^|]| %15[^ |]", &count, &planned, verdict, form) < 3) return false;
    if (sscanf(cells, "%*[^|]|%*[^|]|%*[^|]| %15[^ |]", form) < 1) form[0] = '\0';
    *(strcmp(form, "full") == 0 ? &rows->full : &rows->others) += count;
    rows->planned += planned;
    if (strncmp(verdict, "**", 2) != 0) return true;
    for (int v = 0; v < SCREE_VERDICTS; v++) {
        const size_t length = strlen(verdict_names[v]);
        if (strncmp(verdict + 2, verdict_names[v], length) != 0 || strcmp(verdict + 2 + length, "** ") != 0) continue;
        rows->verdict = (scree_verdict)v;
        rows->intervals = has_interval(cells, count);
        *counted = true;
    }
    return true;
}

/// Calls `take` with what follows the beginning of each row of the statement. False: no memory, or `take` says so.
static bool each_row(const char *section, size_t length, const scree_statement *s,
                     bool (*take)(void *context, const char *line, const char *cells), void *context)
{
    char *first = beginning(s, true), *later = beginning(s, false);
    bool found = false, good = first && later;
    for (const char *line = section; good && line < section + length; line = strchr(line, '\n') + 1) {
        const char *start = found ? later : first;
        if (!strchr(line, '\n')) break;
        if (strncmp(line, start, strlen(start)) != 0) continue;
        good = take(context, line, line + strlen(start));
        found = true;
    }
    free(first);
    free(later);
    return good;
}

typedef struct reading {
    scree_page_rows *rows;
    bool found, counted;
} reading;

static bool read_row(void *context, const char *line, const char *cells)
{
    reading *r = context;
    (void)line;
    r->found = true;
    return read_cells(cells, r->rows, &r->counted);
}

bool scree_page_row_read(const char *section, size_t length, const scree_statement *s, scree_page_rows *rows)
{
    reading r = {.rows = rows};
    *rows = (scree_page_rows){.verdict = SCREE_NOT_RUN};
    return each_row(section, length, s, read_row, &r) && r.found && r.counted;
}

static bool copy_row(void *context, const char *line, const char *cells)
{
    (void)cells;
    (void)fprintf(context, "%.*s\n", (int)(strchr(line, '\n') - line), line);
    return true;
}

bool scree_page_row_copy(const char *section, size_t length, const scree_statement *s, FILE *file)
{
    return each_row(section, length, s, copy_row, file);
}
