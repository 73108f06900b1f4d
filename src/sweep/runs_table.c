/// One row a point of the grid and form: seeds that are done, builds, friction of the confinement, solid fraction and
/// coordination at the begin of loading, and what has to be known of these runs: those that are not quasistatic by
/// their own account, why others failed, whether the sweep is another one now. The last of these is found anew in rows
/// that stay, from their seeds; so it ends the remark.
#include "sweep/runs_table.h"
#include "sweep/origin.h"

#include <math.h>
#include <stdlib.h>
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

/// Sweeps of one name as they are now, in the forms that have been asked for.
typedef struct sweeps {
    const char *name;
    scree_sweep *form[SCREE_FINDING_FORMS];
    bool read[SCREE_FINDING_FORMS];
} sweeps;

static const scree_sweep *sweep_now(sweeps *now, scree_finding_form form)
{
    if (!now->read[form]) now->form[form] = scree_origin_sweep(now->name, form);
    now->read[form] = true;
    return now->form[form];
}

static void free_sweeps(sweeps *now)
{
    for (int form = 0; form < SCREE_FINDING_FORMS; form++) scree_sweep_free(now->form[form]);
}

static void put_seeds_now(FILE *file, const scree_sweep *sweep, const char *separator)
{
    (void)fprintf(file, "%s" SCREE_ORIGIN_SEEDS " (from %lld on)", separator, (long long)sweep->config.seed);
}

/// What the remark on the runs of a row is made of.
typedef struct remarks {
    size_t done, failed, hasty, other_seeds;
    const scree_finding *worst; ///< of the hasty ones
    const scree_finding *other; ///< one whose case is another one now
} remarks;

static remarks collect_remarks(const scree_findings *findings, const scree_finding *row)
{
    remarks r = {0};
    for (const scree_finding *f = row; f < findings->item + findings->count; f++) {
        if (!same_row(f, row)) continue;
        r.failed += f->state == SCREE_FINDING_FAILED;
        if (f->state != SCREE_FINDING_DONE) continue;
        r.done++;
        r.other_seeds += f->other_seed;
        r.hasty += f->hasty;
        if (f->hasty && (!r.worst || f->kinetic_over_elastic > r.worst->kinetic_over_elastic)) r.worst = f;
        if (f->other_case[0] && (!r.other || f->other_sample > r.other->other_sample)) r.other = f;
    }
    return r;
}

/// Why members failed, each reason with the seeds that give it.
static void put_causes(FILE *file, const scree_findings *findings, const scree_finding *row, const char **separator)
{
    const scree_finding *end = findings->item + findings->count;
    for (const scree_finding *f = row; f < end; f++) {
        if (!same_row(f, row) || f->state != SCREE_FINDING_FAILED) continue;
        (void)fprintf(file, "%sseed %lld failed: %s", *separator, f->seed,
                      f->cause[0] ? f->cause : "its log is not there");
        *separator = "; ";
    }
}

/// The cell of the remark; NULL: no memory.
static char *remark_of(const scree_findings *findings, const scree_finding *row, sweeps *now)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (!file) return NULL;
    const remarks r = collect_remarks(findings, row);
    const char *separator = "";
    if (r.hasty > 0) {
        (void)fprintf(file, "not quasistatic by their own account: %zu of %zu, %s%s", r.hasty, r.done,
                      r.hasty > 1 ? "the worst: " : "", r.worst->account);
        separator = "; ";
    }
    put_causes(file, findings, row, &separator);
    if (r.other) {
        (void)fprintf(file, "%sof another %s than the case has now (%s)", separator,
                      r.other->other_sample ? "preparation" : "setting", r.other->other_case);
        separator = "; ";
    }
    const scree_sweep *sweep = r.other_seeds > 0 ? sweep_now(now, row->form) : NULL;
    if (sweep) put_seeds_now(file, sweep, separator);
    if (fclose(file) == 0) return text;
    free(text);
    return NULL;
}

static void put_row(FILE *file, const scree_findings *findings, const scree_finding *row, sweeps *now)
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
    char *remark = remark_of(findings, row, now);
    scree_page_cell_write(file, remark ? remark : "");
    (void)fputs("\n", file);
    free(remark);
}

#define HEAD_BEGIN "| runs | form | seeds |"
enum { CELLS = 9 };
static const char head[] = HEAD_BEGIN " failed, missing | build | friction of the confinement | solid fraction at the "
                                      "begin of loading | coordination there | remark |\n"
                                      "|---|---|---|---|---|---|---|---|---|\n";

static void put_head(FILE *file, bool *any)
{
    if (!*any) (void)fprintf(file, "\n%s", head);
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

/// Whether one of the seeds of a row, in the cell at `cell`, is none of the sweep; the next cell says how many runs
/// beside these there should be.
static bool has_other_seeds(const char *cell, const scree_sweep *sweep)
{
    const size_t count = seeds_of_line(cell);
    size_t failed = 0, missing = 0;
    (void)sscanf(cell, "%*[^|]| %zu, %zu", &failed, &missing);
    bool other = false;
    char *end;
    for (size_t k = 0; k < count; k++) {
        const long long seed = strtoll(cell, &end, 10);
        if (end == cell) break;
        other |= !scree_origin_has_seed(sweep, seed, count + failed + missing);
        cell = end + 1;
    }
    return other;
}

static scree_finding_form form_of_line(const char *line)
{
    const char *cell = strstr(line + 2, " | ") + 3;
    int form = 0;
    while (form < SCREE_FINDING_RUN &&
           strncmp(cell, scree_finding_form_names[form], strlen(scree_finding_form_names[form])) != 0)
        form++;
    return (scree_finding_form)form;
}

/// Behind bar number `count` of a line, which begins with the first; its end where there are fewer.
static const char *behind_bar(const char *line, const char *end, int count)
{
    for (; line < end; line++)
        if (*line == '|' && --count == 0) return line + 1;
    return end;
}

/// A row of a page that stands, with what its seeds say now. `length`: of the cells that say which runs it is of.
static void put_former_row(FILE *file, const char *line, const char *end, size_t length, sweeps *now)
{
    const char *begin = behind_bar(line, end, CELLS), *remark = begin, *stop = end;
    const scree_sweep *sweep = sweep_now(now, form_of_line(line));
    while (remark < end && *remark == ' ') remark++;
    const char *old = strstr(remark, SCREE_ORIGIN_SEEDS);
    // Behind the remark are the last bar and a space.
    while (stop > remark && (stop[-1] == ' ' || (stop[-1] == '|' && stop[-2] != '\\'))) stop--;
    if (old && old < stop) stop = old;
    while (stop > remark && (stop[-1] == ' ' || stop[-1] == ';')) stop--;
    (void)fprintf(file, "%.*s %.*s", (int)(begin - line), line, (int)(stop - remark), remark);
    if (sweep && has_other_seeds(line + length, sweep)) put_seeds_now(file, sweep, stop > remark ? "; " : "");
    (void)fputs(" | \n", file);
}

void scree_runs_table_renew(const scree_page_section *section, const char *name, FILE *file)
{
    sweeps now = {.name = name};
    const char *const stop = section->text + section->length;
    bool table = true, head_follows = false;
    for (const char *line = section->text; line < stop;) {
        const char *newline = memchr(line, '\n', (size_t)(stop - line)), *end = newline ? newline : stop;
        table &= strncmp(line, "| id |", 6) != 0;
        const size_t length = table ? row_of_runs(line, name) : 0;
        if (head_follows)
            head_follows = false; // the line below the head, which is written with it
        else if (table && (head_follows = strncmp(line, HEAD_BEGIN, strlen(HEAD_BEGIN)) == 0))
            (void)fputs(head, file);
        else if (length > 0)
            put_former_row(file, line, end, length, &now);
        else
            (void)fprintf(file, "%.*s%s", (int)(end - line), line, newline ? "\n" : "");
        line = newline ? newline + 1 : stop;
    }
    free_sweeps(&now);
}

void scree_runs_table_write(const scree_findings *findings, const char *name, const scree_page_section *former,
                            FILE *file)
{
    bool any = false;
    sweeps now = {.name = name};
    for (size_t i = 0; i < findings->count; i++) {
        const scree_finding *f = &findings->item[i], *first = findings->item;
        if (strcmp(f->name, name) != 0) continue;
        while (!same_row(first, f)) first++;
        if (first != f) continue;
        put_head(file, &any);
        put_row(file, findings, f, &now);
    }
    for (const char *line = former ? former->text : NULL; line && line < former->text + former->length;) {
        const char *end = strncmp(line, "| id |", 6) == 0 ? NULL : strchr(line, '\n'); // statements come behind
        const size_t length = end ? row_of_runs(line, name) : 0;
        if (length > 0 && tells_more(findings, line, length)) {
            put_head(file, &any);
            put_former_row(file, line, end, length, &now);
        }
        line = end ? end + 1 : NULL;
    }
    free_sweeps(&now);
}
