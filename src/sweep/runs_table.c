/// One row a point of the grid and form: seeds that are done, builds, friction of the confinement, solid fraction and
/// coordination at the begin of loading.
#include "sweep/runs_table.h"

#include <math.h>
#include <string.h>

/// Whether two runs belong to one row.
static bool same_row(const scree_finding *a, const scree_finding *b)
{
    return a->form == b->form && strcmp(a->name, b->name) == 0 && strcmp(a->label, b->label) == 0;
}

/// Least and largest of a number that runs have, as one where they are equal.
static void put_range(FILE *file, double low, double high)
{
    if (isnan(low))
        (void)fputs("- | ", file);
    else if (low == high)
        (void)fprintf(file, "%.4g | ", low);
    else
        (void)fprintf(file, "%.4g - %.4g | ", low, high);
}

static void put_builds(FILE *file, const scree_findings *findings, const scree_finding *row)
{
    const scree_finding *end = findings->item + findings->count;
    bool any = false;
    for (const scree_finding *f = row; f < end; f++) {
        if (!same_row(f, row) || f->state != SCREE_FINDING_DONE || !f->build[0]) continue;
        bool known = false;
        for (const scree_finding *g = row; g < f && !known; g++)
            known = same_row(g, row) && g->state == SCREE_FINDING_DONE && strcmp(g->build, f->build) == 0;
        if (!known) (void)fprintf(file, "%s%s", any ? ", " : "", f->build);
        any |= !known;
    }
    (void)fputs(any ? " | " : "- | ", file);
}

/// The cells that say which runs a row is of.
static void begin_row(char *text, size_t size, const scree_finding *f)
{
    (void)snprintf(text, size, "| %s%s%s | %s | ", f->name, f->label[0] ? "/" : "", f->label,
                   scree_finding_form_names[f->form]);
}

static void put_row(FILE *file, const scree_findings *findings, const scree_finding *row)
{
    char begin[400];
    double friction[2] = {NAN, NAN}, solid[2] = {NAN, NAN}, contacts[2] = {NAN, NAN};
    size_t state[3] = {0};
    begin_row(begin, sizeof begin, row);
    (void)fputs(begin, file);
    const char *separator = "";
    for (const scree_finding *f = row; f < findings->item + findings->count; f++) {
        if (!same_row(f, row)) continue;
        state[f->state]++;
        if (f->state != SCREE_FINDING_DONE) continue;
        (void)fprintf(file, "%s%lld", separator, f->seed);
        separator = ", ";
        const double value[3] = {f->friction, f->solid_fraction, f->coordination};
        double *range[3] = {friction, solid, contacts};
        for (int k = 0; k < 3; k++) {
            range[k][0] = fmin(range[k][0], value[k]);
            range[k][1] = fmax(range[k][1], value[k]);
        }
    }
    (void)fprintf(file, "%s | %zu, %zu | ", separator[0] ? "" : "-", state[SCREE_FINDING_FAILED],
                  state[SCREE_FINDING_MISSING]);
    put_builds(file, findings, row);
    put_range(file, friction[0], friction[1]);
    put_range(file, solid[0], solid[1]);
    put_range(file, contacts[0], contacts[1]);
    (void)fputs("\n", file);
}

static void put_head(FILE *file, bool *any)
{
    if (!*any)
        (void)fputs("\n| runs | form | seeds | failed, missing | build | friction of the confinement | solid "
                    "fraction at the begin of loading | coordination there |\n|---|---|---|---|---|---|---|---|\n",
                    file);
    *any = true;
}

/// Whether `line` is the row of runs of this name; then the length of its cells with point and form.
static size_t row_of_runs(const char *line, const char *name)
{
    const size_t length = strlen(name);
    if (strncmp(line, "| ", 2) != 0 || strncmp(line + 2, name, length) != 0 || !strchr("/ ", line[2 + length]))
        return 0;
    const char *form = strstr(line + 2, " | "), *end = form ? strstr(form + 3, " | ") : NULL;
    return end ? (size_t)(end - line) + 3 : 0;
}

/// Seeds in the cell behind these: "1, 2, 3", or "-".
static size_t seeds_of_line(const char *cell)
{
    size_t count = *cell != '-';
    for (; *cell != '|' && *cell != '\n' && *cell; cell++) count += *cell == ',';
    return count;
}

/// Whether a row whose first `length` characters say which runs it is of has more seeds than these have done, or has
/// runs of which nothing is known here: rows that stay rest on them.
static bool tells_more(const scree_findings *findings, const char *line, size_t length)
{
    char text[400];
    size_t done = 0;
    bool known = false;
    for (size_t i = 0; i < findings->count; i++) {
        begin_row(text, sizeof text, &findings->item[i]);
        if (strlen(text) != length || strncmp(text, line, length) != 0) continue;
        known = true;
        done += findings->item[i].state == SCREE_FINDING_DONE;
    }
    return !known || seeds_of_line(line + length) > done;
}

void scree_runs_table_write(const scree_findings *findings, const char *name, const scree_page_section *former,
                            FILE *file)
{
    bool any = false;
    for (size_t i = 0; i < findings->count; i++) {
        const scree_finding *f = &findings->item[i], *first = findings->item;
        if (strcmp(f->name, name) != 0) continue;
        while (!same_row(first, f)) first++;
        if (first != f) continue;
        put_head(file, &any);
        put_row(file, findings, f);
    }
    for (const char *line = former ? former->text : NULL; line && line < former->text + former->length;) {
        const char *end = strncmp(line, "| id |", 6) == 0 ? NULL : strchr(line, '\n'); // statements come behind
        const size_t length = end ? row_of_runs(line, name) : 0;
        if (length > 0 && tells_more(findings, line, length)) {
            put_head(file, &any);
            (void)fprintf(file, "%.*s\n", (int)(end - line), line);
        }
        line = end ? end + 1 : NULL;
    }
}
