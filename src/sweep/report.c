/// The reproduction page. Each statement is evaluated realisation by realisation (the same seed is the same sample
/// under all labels, so ratios are paired), then averaged with a confidence interval. Nothing on the page depends on
/// the day or the machine but the results themselves.
#include "sweep/expression.h"
#include "sweep/findings.h"
#include "sweep/statements.h"
#include "sweep/statistics.h"
#include "sweep/templates.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum verdict { AGREES, DIFFERS, NOT_MEASURED, NOT_RUN, VERDICTS } verdict;
static const char *const verdict_names[] = {"agrees", "**differs**", "not measured", "not run"};
static const char *const form_names[] = {"full", "quick", "run"};

/// What the lookup of names needs, and what it found out.
typedef struct question {
    const scree_findings *findings;
    scree_finding_form form;
    size_t realisation;
    bool missing_run, missing_result;
    double confidence;
} question;

typedef struct answer {
    verdict verdict;
    scree_estimate estimate;
} answer;

static double look_up(void *user, const char *name)
{
    question *q = user;
    const char *result;
    char text[64], *end;
    const scree_finding *f = scree_findings_get(q->findings, name, q->form, q->realisation, &result);
    if (!f) {
        q->missing_run = true;
        return NAN;
    }
    q->confidence = f->confidence;
    if (scree_result_get(f->directory, result, text, sizeof text, NULL)) {
        q->missing_result = true;
        return NAN;
    }
    double value = strtod(text, &end);
    return end != text && !*end ? value : NAN;
}

static scree_status evaluate(const scree_findings *findings, const scree_statement *statement, scree_finding_form form,
                             answer *a, scree_error *error)
{
    double *value;
    size_t count = findings->realisations, ran = 0;
    double confidence = 0.95;
    *a = (answer){NOT_RUN, {0}};
    scree_status status = scree_allocate(&value, count, sizeof *value, error);
    for (size_t r = 0; r < count && !status; r++) {
        question q = {.findings = findings, .form = form, .realisation = r, .confidence = confidence};
        status = scree_expression_evaluate(statement->value, look_up, &q, &value[r], error);
        ran += !q.missing_run;
        confidence = q.confidence;
    }
    if (!status) {
        a->estimate = scree_estimate_mean(value, count, confidence);
        if (a->estimate.count > 0)
            a->verdict = scree_statement_agrees(statement, a->estimate.mean) ? AGREES : DIFFERS;
        else if (ran > 0)
            a->verdict = NOT_MEASURED;
    }
    scree_release(&value);
    return status;
}

/// A cell of a table: what would end it is escaped.
static void put_cell(FILE *file, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '|') (void)fputc('\\', file);
        (void)fputc(*c, file);
    }
}

static void put_value(FILE *file, const scree_statement *s, const answer *a)
{
    const scree_estimate *e = &a->estimate;
    const char *space = s->unit[0] ? " " : "";
    if (a->verdict == NOT_RUN || a->verdict == NOT_MEASURED)
        (void)fputs("-", file);
    else if (s->kind == SCREE_CRITERION_HOLDS)
        (void)fprintf(file, "in %.0f of %zu", e->mean * (double)e->count, e->count);
    else if (e->count > 1)
        (void)fprintf(file, "%.4g ± %.2g%s%s (n = %zu)", e->mean, e->half, space, s->unit, e->count);
    else
        (void)fprintf(file, "%.4g%s%s", e->mean, space, s->unit);
}

static void put_row(FILE *file, const scree_statement *s, const answer *a, const char *form)
{
    (void)fprintf(file, "| %s | ", s->id);
    put_cell(file, s->text);
    (void)fputs(" | ", file);
    put_cell(file, s->source);
    (void)fputs(" | ", file);
    put_cell(file, s->given);
    (void)fputs(" | ", file);
    put_value(file, s, a);
    (void)fprintf(file, " | %s | ", s->criterion);
    (void)fprintf(file, "%s | %s |\n", verdict_names[a->verdict], form);
}

/// Whether a statement is about a form; a run by itself is taken for what it is.
static bool concerns(const scree_statement *s, scree_finding_form form)
{
    if (form == SCREE_FINDING_RUN || s->form == SCREE_FORM_ANY) return true;
    return (s->form == SCREE_FORM_QUICK) == (form == SCREE_FINDING_QUICK);
}

static void put_command(FILE *file, const scree_findings *findings, const char *name)
{
    bool quick = scree_findings_have(findings, name, SCREE_FINDING_QUICK);
    bool full = scree_findings_have(findings, name, SCREE_FINDING_FULL);
    if (scree_findings_have(findings, name, SCREE_FINDING_RUN)) (void)fprintf(file, "\n`scree run %s`\n", name);
    if (full) (void)fprintf(file, "\nFull form: `scree reproduce --full --only %s`\n", name);
    if (quick) (void)fprintf(file, "\nQuick form: `scree reproduce --only %s`\n", name);
    if (!quick && !full && !scree_findings_have(findings, name, SCREE_FINDING_RUN))
        (void)fprintf(file, "\nTo be run by `scree reproduce --only %s`%s.\n", name,
                      scree_sweep_template(name) ? "" : " (not available: there is no such sweep)");
}

/// Rows of a statement, one a form; `explained` collects those that differ and have an explanation.
static scree_status put_statement(FILE *file, const scree_findings *findings, const scree_statement_group *group,
                                  const scree_statement *s, size_t counts[VERDICTS], FILE *explained,
                                  scree_error *error)
{
    bool any = false;
    for (int form = 0; form < SCREE_FINDING_FORMS; form++) {
        answer a;
        if (!concerns(s, (scree_finding_form)form)) continue;
        if (!scree_findings_have(findings, group->name, (scree_finding_form)form)) continue;
        scree_status status = evaluate(findings, s, (scree_finding_form)form, &a, error);
        if (status) return status;
        put_row(file, s, &a, form_names[form]);
        counts[a.verdict]++;
        any = true;
        if (a.verdict == DIFFERS && s->explanation[0])
            (void)fprintf(explained, "- %s (%s): %s\n", s->id, form_names[form], s->explanation);
    }
    if (any) return SCREE_OK;
    answer none = {NOT_RUN, {0}};
    static const char *const wanted[] = {"", "quick", "full"};
    put_row(file, s, &none, wanted[s->form]);
    counts[NOT_RUN]++;
    return SCREE_OK;
}

static scree_status put_group(FILE *file, const scree_findings *findings, const scree_statement_group *group,
                              size_t counts[VERDICTS], scree_error *error)
{
    char *notes = NULL;
    size_t length;
    FILE *explained = open_memstream(&notes, &length);
    if (!explained) return scree_error_set_memory(error, 4096);
    (void)fprintf(file, "\n### %s\n\n%s\n", group->name, group->meaning);
    put_command(file, findings, group->name);
    (void)fputs("\n| id | statement | where | source | ours | criterion | verdict | form |\n"
                "|---|---|---|---|---|---|---|---|\n",
                file);
    scree_status status = SCREE_OK;
    for (int64_t k = 0; k < group->statement_count && !status; k++)
        status = put_statement(file, findings, group, &group->statements[k], counts, explained, error);
    if (fclose(explained) != 0 && !status) status = scree_error_set_memory(error, 4096);
    if (!status && notes[0]) (void)fprintf(file, "\nWhere it differs:\n\n%s", notes);
    free(notes);
    return status;
}

static const char introduction[] =
    "# Reproduction of published results\n"
    "\n"
    "<!-- Generated by `scree report`; do not edit. -->\n"
    "\n"
    "What the publications state, and what Scree finds. The statements with their criteria lie in "
    "`cases/reproduction/`,\n"
    "the runs are built-in sweeps (`scree list --sweeps`, files in `cases/sweeps/`). On any machine,\n"
    "\n"
    "    make reproduce          # quick forms: smaller samples, a larger but still small quasistatic number\n"
    "    make reproduce-full     # the sources' own numbers\n"
    "\n"
    "run them, each continuing what is missing, and write this page; `scree reproduce --only NAME` runs one. The same\n"
    "build on the same kind of processor gives the same numbers, but for wall times.\n"
    "\n"
    "*Ours* is the mean over realisations (samples of different seeds) with half its 95 % confidence interval "
    "(Student), "
    "and\n"
    "n their number. Where a statement compares runs, it is evaluated in each realisation, on the same sample, and "
    "then\n"
    "averaged; `in 2 of 3` counts the realisations in which a comparison holds. The verdict is that of the criterion "
    "on\n"
    "the mean: *agrees*, *differs*, *not run*, or *not measured* when the runs are there and do not have the result.\n";

/// Reads every built-in table of statements.
static scree_status read_table(size_t index, scree_arena *arena, scree_statement_table *table, scree_error *error)
{
    const scree_template *built_in = &scree_statement_templates[index];
    scree_problems *problems = NULL;
    scree_status status =
        scree_statements_read(built_in->name, built_in->text, built_in->length, arena, table, &problems);
    if (status && scree_problems_count(problems) > 0)
        *error = *scree_problems_get(problems, 0);
    else if (status)
        scree_error_set_memory(error, built_in->length);
    scree_problems_free(problems);
    return status;
}

/// All tables into `body`, counting verdicts.
static scree_status put_tables(FILE *body, const scree_findings *findings, size_t counts[VERDICTS], scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < scree_statement_templates_count && !status; i++) {
        scree_arena arena = {0};
        scree_statement_table table;
        status = read_table(i, &arena, &table, error);
        if (!status) (void)fprintf(body, "\n## %s\n", table.source);
        for (int64_t k = 0; !status && k < table.case_count; k++)
            status = put_group(body, findings, &table.cases[k], counts, error);
        scree_arena_release(&arena);
    }
    return status;
}

scree_status scree_report_write(const char *const *directories, size_t count, FILE *file, scree_error *error)
{
    scree_findings findings = {0};
    size_t counts[VERDICTS] = {0}, length;
    char *text = NULL;
    scree_error local;
    if (!error) error = &local;
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < count && !status; i++) status = scree_findings_add(&findings, directories[i], error);
    FILE *body = status ? NULL : open_memstream(&text, &length);
    if (!status && !body) status = scree_error_set_memory(error, 4096);
    if (!status) status = put_tables(body, &findings, counts, error);
    if (body && fclose(body) != 0 && !status) status = scree_error_set_memory(error, 4096);
    if (!status) {
        (void)fprintf(file, "%s\n**%zu agree, %zu differ, %zu were not measured, %zu were not run.**\n%s", introduction,
                      counts[AGREES], counts[DIFFERS], counts[NOT_MEASURED], counts[NOT_RUN], text);
        if (fflush(file) != 0 || ferror(file))
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "the report cannot be written");
    }
    free(text);
    scree_findings_destroy(&findings);
    return status;
}
