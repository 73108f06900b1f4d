/// The reproduction page. A statement has a row for each form that was run; the first one that has a result with an
/// interval, the full form before the quick one, is counted; where none has, the first one with a result. Nothing on
/// the page depends on the day or the machine but the results themselves.
#include "sweep/ensemble_figures.h"
#include "sweep/origin.h"
#include "sweep/page_row.h"
#include "sweep/page_section.h"
#include "sweep/runs_table.h"
#include "sweep/templates.h"

#include "base/memory.h"
#include "case/case.h"
#include "case/problems.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// A page in the making.
typedef struct page {
    FILE *file;
    const scree_findings *findings;
    const char *source;
    scree_page_counts *counts; ///< of the source
    FILE *explained;           ///< notes below the table of a case
    scree_page_section former; ///< of a case whose rows may stay: those that rest on more than the folders hold
    const scree_report_options *options;
    scree_error *error;
} page;

/// Whether a statement is about a form; a run by itself is taken for what it is.
static bool concerns(const scree_statement *s, int form)
{
    if (form == SCREE_FINDING_RUN || s->form == SCREE_FORM_ANY) return true;
    return (s->form == SCREE_FORM_QUICK) == (form == SCREE_FINDING_QUICK);
}

/// `open`: the verdict is no agreement.
static void put_notes(const page *p, const scree_statement *s, bool open)
{
    if (open && s->explanation[0]) (void)fprintf(p->explained, "- %s: %s\n", s->id, s->explanation);
    if (s->form != SCREE_FORM_ANY)
        (void)fprintf(p->explained, "- %s, %s form only: %s\n", s->id, s->form == SCREE_FORM_FULL ? "full" : "quick",
                      s->reason);
}

/// One run, or an average over few.
static bool has_no_interval(const scree_answer *a)
{
    return a->verdict == SCREE_UNDECIDED && (a->few || a->interval.count < 2 || !isfinite(a->interval.low));
}

/// Whether the answer of a later form counts in place of the one before: that has no result, or none with an interval.
static bool says_more(const scree_answer *later, const scree_answer *before)
{
    if (before->verdict > SCREE_UNDECIDED) return later->verdict < before->verdict;
    return has_no_interval(before) && later->verdict <= SCREE_UNDECIDED && !has_no_interval(later);
}

/// Rows of a statement by the runs in the folders, one a form. open: out, one of them is no agreement.
static scree_status put_answers(const page *p, const scree_statement_group *group, const scree_statement *s, FILE *file,
                                bool *open)
{
    scree_answer answer[SCREE_FINDING_FORMS];
    bool shown[SCREE_FINDING_FORMS] = {false};
    int counted = -1, first = -1;
    for (int form = 0; form < SCREE_FINDING_FORMS; form++) {
        shown[form] = concerns(s, form) && scree_findings_have(p->findings, group->name, (scree_finding_form)form);
        if (!shown[form]) continue;
        scree_status status = scree_answer_find(p->findings, s, (scree_finding_form)form, &answer[form], p->error);
        if (status) return status;
        if (counted < 0 || says_more(&answer[form], &answer[counted])) counted = form;
        if (first < 0) first = form;
    }
    for (int form = 0; form < SCREE_FINDING_FORMS; form++)
        if (shown[form])
            scree_page_row_write(file, s, &answer[form], scree_finding_form_names[form], form == first,
                                 form == counted);
    static const char *const wanted[] = {"", "quick", "full"};
    scree_answer none = {.verdict = SCREE_NOT_RUN, .interval = {NAN, NAN, NAN, 0}};
    if (counted < 0) scree_page_row_write(file, s, &none, wanted[s->form], true, true);
    *open = false;
    for (int form = 0; form < SCREE_FINDING_FORMS; form++)
        *open |= shown[form] && scree_verdict_is_open(answer[form].verdict);
    return SCREE_OK;
}

/// Rows of a statement, with its notes. *kept: whether they are those of the page that stood here.
static scree_status put_statement(const page *p, const scree_statement_group *group, const scree_statement *s,
                                  FILE *file, bool *kept)
{
    scree_page_section rows = {0};
    scree_page_rows former;
    char *text = NULL;
    bool open = false;
    FILE *own = open_memstream(&text, &rows.length);
    if (!own) return scree_error_set_memory(p->error, 4096);
    scree_status status = put_answers(p, group, s, own, &open);
    if (fclose(own) != 0 && !status) status = scree_error_set_memory(p->error, 4096);
    rows.text = text;
    *kept = !status && scree_page_section_outweighs_in(&p->former, &rows, s, &former);
    if (!status && !*kept) (void)fwrite(rows.text, 1, rows.length, file);
    if (*kept && !scree_page_row_copy(p->former.text, p->former.length, s, file))
        status = scree_error_set_memory(p->error, 4096);
    if (!status) put_notes(p, s, *kept ? scree_verdict_is_open(former.verdict) : open);
    free(text);
    return status;
}

/// Whether there are runs of this form, or the rows of such that stay.
static bool has_form(const page *p, const char *name, scree_finding_form form, bool kept)
{
    static const char *const begins[] = {"\nFull form: ", "\nQuick form: ", "\n`scree run "};
    const char *at = kept ? strstr(p->former.text, begins[form]) : NULL;
    return (at && at < p->former.text + p->former.length) || scree_findings_have(p->findings, name, form);
}

static void put_command(const page *p, const char *name, bool kept)
{
    const bool quick = has_form(p, name, SCREE_FINDING_QUICK, kept), full = has_form(p, name, SCREE_FINDING_FULL, kept),
               run = has_form(p, name, SCREE_FINDING_RUN, kept), built_in = scree_sweep_template(name);
    if (run) (void)fprintf(p->file, "\n`scree run %s`\n", name);
    if (full && built_in) (void)fprintf(p->file, "\nFull form: `scree reproduce --full --only %s`\n", name);
    if (quick && built_in) (void)fprintf(p->file, "\nQuick form: `scree reproduce --only %s`\n", name);
    if (!quick && !full && !run && built_in)
        (void)fprintf(p->file, "\nTo be run by `scree reproduce --only %s`.\n", name);
}

/// Rows of all statements of a case into `rows`, notes into p->explained.
static scree_status put_statements(const page *p, const scree_statement_group *group, FILE *rows, bool *any_kept)
{
    scree_status status = SCREE_OK;
    *any_kept = false;
    for (int64_t k = 0; k < group->statement_count && !status; k++) {
        bool kept = false;
        status = put_statement(p, group, &group->statements[k], rows, &kept);
        *any_kept |= kept;
    }
    return status;
}

/// What the runs in the folders say of a case, and rows of `former` that rest on more, as the text of its section but
/// for the figures; to be freed.
static scree_status write_group(const page *p, const scree_statement_group *group, scree_page_section former,
                                scree_page_section *section, char **text)
{
    char *notes = NULL, *rows = NULL;
    size_t length;
    bool kept = false;
    page part = *p;
    part.former = former;
    part.file = open_memstream(text, &section->length);
    part.explained = open_memstream(&notes, &length);
    FILE *statements = open_memstream(&rows, &length);
    scree_status status = part.file && part.explained && statements ? SCREE_OK : scree_error_set_memory(p->error, 4096);
    if (!status) status = put_statements(&part, group, statements, &kept);
    if (part.explained && fclose(part.explained) != 0 && !status) status = scree_error_set_memory(p->error, 4096);
    if (statements && fclose(statements) != 0 && !status) status = scree_error_set_memory(p->error, 4096);
    if (!status) {
        (void)fprintf(part.file, "\n### %s\n\n%s\n", group->name, group->meaning);
        put_command(&part, group->name, kept);
        scree_runs_table_write(p->findings, group->name, kept ? &part.former : NULL, part.file);
        scree_page_row_head(part.file);
        (void)fputs(rows, part.file);
        if (notes[0]) (void)fprintf(part.file, "\nNotes:\n\n%s", notes);
    }
    free(notes);
    free(rows);
    if (part.file && fclose(part.file) != 0 && !status) status = scree_error_set_memory(p->error, 4096);
    section->text = *text;
    return status;
}

static bool outweighs_in_some(const scree_page_section *section, const scree_page_section *other,
                              const scree_statement_group *group)
{
    scree_page_rows rows;
    bool some = false;
    for (int64_t k = 0; k < group->statement_count && !some; k++)
        some = scree_page_section_outweighs_in(section, other, &group->statements[k], &rows);
    return some;
}

static scree_status put_group(page *p, const scree_statement_group *group)
{
    const scree_report_options *options = p->options;
    const scree_page_section former = scree_page_section_find(options->former, p->source, group->name);
    scree_page_section section;
    char *text = NULL;
    scree_status status = write_group(p, group, (scree_page_section){0}, &section, &text);
    const bool stays = !status && scree_page_section_outweighs(&former, &section, group) &&
                       !outweighs_in_some(&section, &former, group);
    if (stays) section = former;
    if (!status && !stays && outweighs_in_some(&former, &section, group)) {
        free(text);
        text = NULL;
        status = write_group(p, group, former, &section, &text);
    }
    if (!status) {
        if (stays)
            scree_runs_table_renew(&section, group->name, p->file);
        else
            (void)fwrite(section.text, 1, section.length, p->file);
        scree_page_section_count(&section, group, p->counts);
    }
    free(text);
    if (status) return status;
    if (stays) return options->kept ? ++*options->kept, SCREE_OK : SCREE_OK;
    return scree_ensemble_figures_write(p->findings, group->name, options->figures, options->figures_link, p->file,
                                        p->error);
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
    "*Ours* is the mean over realisations (samples of different seeds) with its confidence interval (Student): of 95 "
    "%,\n"
    "for `within` and `equivalent within` of 90 % (two one-sided tests of 5 %). A statement *agrees* when the whole "
    "interval meets its\n"
    "criterion, *differs* when no part of it does, and is *undecided* otherwise. Ratios are averaged as logarithms.\n"
    "Where a statement compares runs, it is evaluated on each sample, if they had the same ones (seed and "
    "preparation:\n"
    "the solid fraction at the begin of loading is the same to all digits, or of a pile that is changed what was\n"
    "unbalanced before); otherwise the means are compared (Welch), as the remark says. What `holds` in some\n"
    "realisations is judged by the exact binomial interval (Clopper and Pearson). One realisation gives no verdict,\n"
    "unless the statement does not depend on the sample; then the interval\n"
    "is the range of what was found. `4 of 5` realisations: one failed, was not run, or has no such value. *Not\n"
    "measured*: the runs are there and do not have the result. Results called ensemble_... are those of averages over "
    "all\n"
    "runs of a point, with bootstrap intervals of 95 %. Remarks say which runs are not quasistatic by their own "
    "account\n"
    "(`quasistatic: no` in their summary.json), why runs failed, and which were made of another preparation or of "
    "other\n"
    "seeds than the case has now. A `+` behind a build: files differed from that commit.\n"
    "\n"
    "A *finding* is the source's own, a *check* ours (an identity, a closed form, a stop rule), *beyond* what the\n"
    "source does not have. Each statement counts once: by its full form where that has a result with an interval,\n"
    "or the quick one has none, else by its quick form; the verdict that counts is in bold, others stand in\n"
    "brackets. A case that rests on more realisations on the\n"
    "page that stood here before than in the folders (theirs are gone) keeps its section, a statement its rows.\n";

/// Says which built-in table is nearest to `name`, or else which there are.
static scree_status refuse_table(const char *name, scree_problems **problems)
{
    scree_error error = {.status = SCREE_ERROR_INPUT,
                         .message = "there is no file and no built-in table of statements "
                                    "of this name"};
    const char *names[32];
    size_t count = 0;
    (void)snprintf(error.file, sizeof error.file, "%s", name);
    for (; count < scree_statement_templates_count && count < sizeof names / sizeof *names; count++)
        names[count] = scree_statement_templates[count].name;
    const char *nearest = scree_nearest(name, names, count);
    for (size_t i = 0; !nearest && i < count; i++) {
        const size_t used = strlen(error.accepted);
        (void)snprintf(error.accepted + used, sizeof error.accepted - used, "%s%s", i > 0 ? ", " : "", names[i]);
    }
    if (nearest) (void)snprintf(error.accepted, sizeof error.accepted, "%s", nearest);
    if (problems && scree_problems_create(problems) == SCREE_OK) scree_problems_replace(*problems, &error);
    return SCREE_ERROR_INPUT;
}

/// Text of a table: a file, or a built-in one.
static scree_status read_table(const page *p, const char *name, scree_arena *arena, scree_statement_table *table,
                               scree_problems **problems)
{
    for (size_t i = 0; i < scree_statement_templates_count; i++) {
        const scree_template *built_in = &scree_statement_templates[i];
        if (strcmp(built_in->name, name) == 0)
            return scree_statements_read(name, built_in->text, built_in->length, NULL, arena, table, problems);
    }
    struct stat about;
    if (stat(name, &about) != 0 && errno == ENOENT) return refuse_table(name, problems);
    char *text = NULL;
    size_t length;
    scree_status status = scree_case_text(name, &text, &length, problems);
    if (!status) status = scree_statements_read(name, text, length, p->findings, arena, table, problems);
    scree_release(&text);
    return status;
}

static void put_counts(FILE *file, scree_page_counts *all, const char *begin)
{
    const size_t *n = (*all)[SCREE_CLASS_FINDING];
    (void)fprintf(file, "%s**%zu agree, %zu differ, %zu are undecided**, %zu were not measured, %zu were not run. ",
                  begin, n[SCREE_AGREES], n[SCREE_DIFFERS], n[SCREE_UNDECIDED], n[SCREE_NOT_MEASURED],
                  n[SCREE_NOT_RUN]);
    static const char *const names[] = {"", "Own checks", "Beyond the source"};
    for (int k = SCREE_CLASS_CHECK; k < SCREE_CLASSES; k++) {
        n = (*all)[k];
        (void)fprintf(file, "%s: %zu agree, %zu differ, %zu undecided, %zu not measured, %zu not run.%s", names[k],
                      n[SCREE_AGREES], n[SCREE_DIFFERS], n[SCREE_UNDECIDED], n[SCREE_NOT_MEASURED], n[SCREE_NOT_RUN],
                      k + 1 < SCREE_CLASSES ? " " : "\n");
    }
}

/// One source: its headline, then its groups. The headline of each also goes into `head`.
static scree_status put_source(page *p, const char *name, FILE *head, scree_problems **problems)
{
    scree_arena arena = {0};
    scree_statement_table table;
    scree_page_counts mine = {{0}};
    char *text = NULL, begin[400];
    size_t length;
    page part = *p;
    part.counts = &mine;
    scree_status status = read_table(p, name, &arena, &table, problems);
    if (status && scree_problems_count(*problems) > 0) *p->error = *scree_problems_get(*problems, 0);
    if (status && scree_problems_count(*problems) == 0) scree_error_set_memory(p->error, 4096);
    part.file = status ? NULL : open_memstream(&text, &length);
    if (!status && !part.file) status = scree_error_set_memory(p->error, 4096);
    part.source = table.source;
    for (int64_t k = 0; !status && k < table.case_count; k++) status = put_group(&part, &table.cases[k]);
    if (part.file && fclose(part.file) != 0 && !status) status = scree_error_set_memory(p->error, 4096);
    if (!status) {
        (void)snprintf(begin, sizeof begin, "\n%.300s. Findings: ", table.source);
        put_counts(head, &mine, begin);
        (void)fprintf(p->file, "\n## %s\n%s", table.source, text);
    }
    free(text);
    scree_arena_release(&arena);
    return status;
}

static scree_status put_sources(page *p, const scree_report_options *options, FILE *head, scree_problems **problems)
{
    scree_status status = SCREE_OK;
    size_t count = options->statement_count > 0 ? options->statement_count : scree_statement_templates_count;
    for (size_t i = 0; i < count && !status; i++)
        status =
            put_source(p, options->statement_count > 0 ? options->statements[i] : scree_statement_templates[i].name,
                       head, problems);
    return status;
}

scree_status scree_report_write(const scree_report_options *options, FILE *file, scree_problems **problems,
                                scree_error *error)
{
    scree_findings findings = {0};
    char *head_text = NULL, *body_text = NULL;
    size_t length;
    scree_error local;
    scree_problems *own = NULL;
    if (!error) error = &local;
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < options->directory_count && !status; i++)
        status = scree_findings_add(&findings, options->directory[i], error);
    scree_origin_compare(&findings);
    FILE *head = open_memstream(&head_text, &length), *body = open_memstream(&body_text, &length);
    if (!status && (!head || !body)) status = scree_error_set_memory(error, 4096);
    page p = {.file = body, .findings = &findings, .options = options, .error = error};
    if (!status) status = put_sources(&p, options, head, &own);
    if (head && fclose(head) != 0 && !status) status = scree_error_set_memory(error, 4096);
    if (body && fclose(body) != 0 && !status) status = scree_error_set_memory(error, 4096);
    if (!status) {
        (void)fprintf(file, "%s%s%s", introduction, head_text, body_text);
        if (fflush(file) != 0 || ferror(file))
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "the report cannot be written");
    }
    free(head_text);
    free(body_text);
    scree_findings_destroy(&findings);
    if (problems)
        *problems = own;
    else
        scree_problems_free(own);
    return status;
}
