/// Names in a table of statements: of sweeps and cases, of points of a grid, of results. What exists is what is built
/// in and what was found; a result is known where a run of that name has it, or its sweep averages it.
#include "sweep/ensemble.h"
#include "sweep/expression.h"
#include "sweep/findings.h"
#include "sweep/statements.h"
#include "sweep/sweep.h"
#include "sweep/templates.h"

#include <string.h>

enum { MOST_NAMES = 1000 };

/// Names that something may have.
typedef struct names {
    const char *item[MOST_NAMES];
    size_t count;
} names;

/// What the check of one expression shares.
typedef struct checking {
    scree_reader *reader;
    const scree_findings *findings;
    const scree_statement *statement;
    const scree_template *read; ///< the built-in sweep that was asked for last
    scree_sweep *sweep;         ///< that sweep; NULL: none, or one that cannot be read
} checking;

static bool names_have(const names *n, const char *name)
{
    for (size_t k = 0; k < n->count; k++)
        if (strcmp(n->item[k], name) == 0) return true;
    return false;
}

static void names_add(names *n, const char *name)
{
    if (n->count < MOST_NAMES && !names_have(n, name)) n->item[n->count++] = name;
}

/// All sweeps and cases.
static void list_cases(const scree_findings *findings, names *n)
{
    for (size_t k = 0; k < scree_sweep_templates_count; k++) names_add(n, scree_sweep_templates[k].name);
    for (size_t k = 0; k < scree_templates_count; k++) names_add(n, scree_templates[k].name);
    for (size_t k = 0; k < findings->count; k++) names_add(n, findings->item[k].name);
}

/// The nearest of `known` is suggested, or else all, as many as there is room for.
static void refuse(const checking *c, scree_place place, const char *value, const char *what, const names *known)
{
    char list[200] = "";
    size_t used = 0;
    const char *nearest = scree_nearest(value, known->item, known->count);
    for (size_t k = 0; k < known->count && used + strlen(known->item[k]) + 6 < sizeof list; k++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k > 0 ? ", " : "", known->item[k]);
    scree_problem_add(c->reader, place, c->statement ? c->statement->id : "case", value, nearest ? nearest : list,
                      "there is no %s '%s'%s%s%s", what, scree_show(value).text, nearest ? "; did you mean '" : "",
                      nearest ? nearest : "", nearest ? "'?" : "");
}

static void check_case(const checking *c, scree_place place, const char *name)
{
    names known = {.count = 0};
    list_cases(c->findings, &known);
    if (!names_have(&known, name)) refuse(c, place, name, "sweep or case", &known);
}

/// Results of a run, as a list in the arena.
typedef struct collecting {
    scree_arena *arena;
    names *known;
} collecting;

static void collect_result(void *user, const char *name, const char *value)
{
    collecting *all = user;
    (void)value;
    const char *copy = scree_arena_copy(all->arena, name, strlen(name));
    if (copy) names_add(all->known, copy);
}

/// Points of the grid that `r` is about, as far as they are known, and a finished run of its own (NULL: none).
static const scree_finding *list_points(const checking *c, const scree_reference *r, const scree_sweep *sweep,
                                        names *points)
{
    const scree_finding *run = NULL;
    for (size_t k = 0; sweep && k < sweep->point_count; k++) names_add(points, sweep->point[k]);
    for (size_t k = 0; k < c->findings->count; k++) {
        const scree_finding *f = &c->findings->item[k];
        if (strcmp(f->name, r->name) != 0) continue;
        names_add(points, !r->labelled && f->form == SCREE_FINDING_RUN ? "" : f->label);
        if (scree_finding_is(f, r, f->form) && f->state == SCREE_FINDING_DONE) run = f;
    }
    return run;
}

/// Results of an ensemble have the prefix in expressions.
static void collect_ensemble(void *user, const char *name, const char *value)
{
    char whole[200];
    (void)snprintf(whole, sizeof whole, SCREE_ENSEMBLE_PREFIX "%s", name);
    collect_result(user, whole, value);
}

static void check_result(const checking *c, const scree_reference *r, const scree_sweep *sweep,
                         const scree_finding *run)
{
    names known = {.count = 0};
    collecting all = {c->reader->arena, &known};
    if (!run || scree_result_visit(run->directory, collect_result, &all, NULL)) return;
    // Before the members are averaged nobody knows what comes of it.
    if (scree_reference_is_ensemble(r) && scree_ensemble_runs(run->ensemble) == 0) return;
    scree_ensemble_visit(run->ensemble, collect_ensemble, &all);
    for (size_t k = 0; sweep && k < sweep->measure_count; k++) names_add(&known, sweep->measure[k]);
    if (!names_have(&known, r->result)) refuse(c, c->statement->value_place, r->result, "result", &known);
}

/// The built-in sweep of this name; NULL: none. The names of a table are mostly of one sweep after the other, and
/// reading one, with all cases of its members, takes as long as a thousand names.
static const scree_sweep *sweep_of(checking *c, const char *name)
{
    const scree_template *wanted = scree_sweep_template(name);
    if (wanted == c->read) return c->sweep;
    scree_sweep_free(c->sweep);
    c->sweep = NULL;
    c->read = wanted;
    if (wanted && scree_sweep_read(name, NULL, &c->sweep, NULL)) c->sweep = NULL;
    return c->sweep;
}

/// One name of an expression; points and results are judged only where something is known about them.
static double check_reference(void *user, const char *text)
{
    checking *c = user;
    scree_reference r;
    names known = {.count = 0}, points = {.count = 0};
    if (!scree_reference_read(text, &r)) return 1.5; // noted
    list_cases(c->findings, &known);
    if (!names_have(&known, r.name)) {
        refuse(c, c->statement->value_place, r.name, "sweep or case", &known);
        return 1.5;
    }
    const scree_sweep *sweep = sweep_of(c, r.name);
    const scree_finding *run = list_points(c, &r, sweep, &points);
    if (points.count > 0 && !names_have(&points, r.label))
        refuse(c, c->statement->value_place, r.label, "point", &points);
    else
        check_result(c, &r, sweep, run);
    return 1.5;
}

static void check_statement(checking *c, const scree_statement *statement)
{
    double value;
    scree_error error;
    c->statement = statement;
    // What cannot be read has been noted.
    if (statement->value && scree_expression_evaluate(statement->value, check_reference, c, &value, &error)) return;
}

void scree_statements_check_names(scree_reader *reader, const scree_statement_table *table,
                                  const scree_findings *findings)
{
    checking c = {.reader = reader, .findings = findings};
    for (int64_t i = 0; i < table->case_count; i++) {
        c.statement = NULL;
        if (table->cases[i].name) check_case(&c, table->cases[i].place, table->cases[i].name);
        for (int64_t k = 0; k < table->cases[i].statement_count; k++)
            check_statement(&c, &table->cases[i].statements[k]);
    }
    scree_sweep_free(c.sweep);
}
