/// Schema and rules of the tables of statements.
#include "sweep/statements.h"

#include "base/units.h"
#include "sweep/expression.h"
#include "sweep/findings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define FROM(limit)  .least = {limit, false}
#define TO(limit)    .most = {limit, false}
#define KEY(owner, member, label, kind, ...)                                                                           \
    {                                                                                                                  \
        .name = label, .type = kind, .offset = offsetof(owner, member), __VA_ARGS__                                    \
    }
#define TEXT(owner, member, label, ...) KEY(owner, member, label, SCREE_KEY_TEXT, FROM("1"), TO("1000"), __VA_ARGS__)
#define LIST(owner, member, label, table, number, ...)                                                                 \
    KEY(owner, member, label, SCREE_KEY_LIST, FROM("1"), TO("500"), .sections = table, .section_count = 1,             \
        .count_offset = offsetof(owner, number), .element_size = sizeof *((owner *)0)->member, __VA_ARGS__)
#define TABLE(title, text, keys_)                                                                                      \
    {                                                                                                                  \
        .name = title, .meaning = text, .keys = keys_, .count = COUNT(keys_)                                           \
    }

static const scree_choice forms[] = {
    {"any", SCREE_FORM_ANY, "both forms"},
    {"quick", SCREE_FORM_QUICK, "the quick form only"},
    {"full", SCREE_FORM_FULL, "the full form only"},
    {0},
};

static const scree_choice classes[] = {
    {"finding", SCREE_CLASS_FINDING, "a finding of the source"},
    {"check", SCREE_CLASS_CHECK, "a check of our own: an identity, a stop rule, a closed form"},
    {"beyond", SCREE_CLASS_BEYOND, "beyond the source"},
    {0},
};
static const scree_choice averages[] = {
    {"auto", SCREE_AVERAGE_AUTO, "logarithms of a quotient of results, else plain"},
    {"plain", SCREE_AVERAGE_PLAIN, "mean of the values"},
    {"logarithms", SCREE_AVERAGE_LOGARITHMS, "geometric mean: the value is a ratio"},
    {0},
};

typedef scree_statement statement;
static const scree_key statement_keys[] = {
    KEY(statement, id, "id", SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Unique name."),
    TEXT(statement, text, "statement", .meaning = "What the source states."),
    TEXT(statement, source, "source", .meaning = "Where: equation, figure, table."),
    TEXT(statement, given, "given", .meaning = "The source's value."),
    TEXT(statement, value, "value", .meaning = "Expression of results, CASE/LABEL.RESULT."),
    TEXT(statement, criterion, "criterion",
         .meaning = "within 10 %, equivalent within 0.5, greater than 2, less than 3, between 2 and 4, or holds."),
    KEY(statement, class, "kind", SCREE_KEY_CHOICE, .choices = classes, .meaning = "What kind of statement it is."),
    KEY(statement, deterministic, "deterministic", SCREE_KEY_FLAG, .standard = "no",
        .meaning = "It does not depend on the sample: one realisation decides."),
    KEY(statement, average, "average", SCREE_KEY_CHOICE, .choices = averages, .standard = "auto",
        .meaning = "How realisations are averaged."),
    KEY(statement, unit, "unit", SCREE_KEY_TEXT, .standard = "", FROM("0"), TO("30"), .meaning = "Shown behind."),
    KEY(statement, form, "form", SCREE_KEY_CHOICE, .choices = forms, .standard = "any",
        .meaning = "Forms of the case that it is about."),
    KEY(statement, reason, "reason", SCREE_KEY_TEXT, .standard = "", FROM("0"), TO("2000"),
        .meaning = "Why the other form cannot decide it; required with `form`."),
    KEY(statement, explanation, "explanation", SCREE_KEY_TEXT, .standard = "", FROM("0"), TO("2000"),
        .meaning = "Why it comes out differently, shown where it does."),
};
static const scree_section statement_table[] = {TABLE("statements", "One statement.", statement_keys)};

typedef scree_statement_group group;
static const scree_key group_keys[] = {
    KEY(group, name, "case", SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name of the case."),
    TEXT(group, meaning, "meaning", .meaning = "What is computed."),
    LIST(group, statements, "statements", statement_table, statement_count, .meaning = "What must show."),
};
static const scree_section group_table[] = {TABLE("cases", "Statements about one case.", group_keys)};

typedef scree_statement_table root;
static const scree_key root_keys[] = {
    KEY(root, language, "reproduction", SCREE_KEY_INTEGER, .standard = "1", FROM("1"), TO("1"), .meaning = "Version."),
    TEXT(root, source, "source", .meaning = "The publication."),
    LIST(root, cases, "cases", group_table, case_count, .meaning = "Statements by case."),
};
static const scree_section schema = TABLE("reproduction", "Statements of a publication.", root_keys);

/// A number with a unit at the begin of `text`, up to `end`.
static bool read_bound(const char *text, const char *end, double *bound)
{
    char part[64];
    size_t length = end ? (size_t)(end - text) : strlen(text);
    if (length >= sizeof part) return false;
    memcpy(part, text, length);
    part[length] = 0;
    return scree_units_parse(part, "1", bound, NULL) == SCREE_OK;
}

/// Criteria by how they begin.
static const char *const criteria[] = {
    [SCREE_CRITERION_WITHIN] = "within",        [SCREE_CRITERION_EQUIVALENT] = "equivalent within",
    [SCREE_CRITERION_GREATER] = "greater than", [SCREE_CRITERION_LESS] = "less than",
    [SCREE_CRITERION_BETWEEN] = "between",      [SCREE_CRITERION_HOLDS] = "holds"};

/// Criterion as text to kind and bounds; false when it is not one.
static bool read_criterion(scree_statement *s)
{
    s->kind = SCREE_CRITERION_HOLDS;
    if (strcmp(s->criterion, criteria[SCREE_CRITERION_HOLDS]) == 0) return true;
    for (int kind = 0; kind < SCREE_CRITERION_HOLDS; kind++) {
        size_t length = strlen(criteria[kind]);
        if (strncmp(s->criterion, criteria[kind], length) != 0 || s->criterion[length] != ' ') continue;
        const char *rest = s->criterion + length + 1;
        s->kind = (scree_criterion)kind;
        if (s->kind != SCREE_CRITERION_BETWEEN) return read_bound(rest, NULL, &s->bound[0]);
        const char *and = strstr(rest, " and ");
        return and&&read_bound(rest, and, &s->bound[0]) && read_bound(and+5, NULL, &s->bound[1]) &&
               s->bound[0] < s->bound[1];
    }
    return false;
}

/// What is expected behind each.
static const char *const behind[] = {
    [SCREE_CRITERION_WITHIN] = "a share, as in 'within 10 %'",
    [SCREE_CRITERION_EQUIVALENT] = "one number without unit, as in 'equivalent within 0.5'",
    [SCREE_CRITERION_GREATER] = "one number without unit, as in 'greater than 2'",
    [SCREE_CRITERION_LESS] = "one number without unit, as in 'less than 3'",
    [SCREE_CRITERION_BETWEEN] = "two numbers, the lower one first, as in 'between 2 and 4'",
    [SCREE_CRITERION_HOLDS] = "nothing",
};

/// Notes what is wrong with a criterion: behind its words, or its words, with the nearest right ones.
static void refuse_criterion(scree_reader *reader, scree_place place, const scree_statement *s)
{
    static const char forms_of_all[] =
        "within 10 %, equivalent within 0.5, greater than 2, less than 3, between 2 and 4, holds";
    const char *text = s->criterion;
    for (size_t kind = 0; kind < COUNT(criteria); kind++) {
        const size_t length = strlen(criteria[kind]);
        if (strncmp(text, criteria[kind], length) != 0 || (text[length] && text[length] != ' ')) continue;
        scree_problem_add(reader, place, s->id, text, forms_of_all, "'%s' is not a criterion, expected behind '%s': %s",
                          scree_show(text).text, criteria[kind], behind[kind]);
        return;
    }
    char words[40];
    size_t length = strcspn(text, "+-.0123456789");
    const char *number = text + length;
    while (length > 0 && text[length - 1] == ' ') length--;
    (void)snprintf(words, sizeof words, "%.*s", (int)length, text);
    const char *nearest = scree_nearest(words, criteria, COUNT(criteria));
    if (nearest)
        scree_problem_add(reader, place, s->id, text, forms_of_all,
                          "there is no criterion '%s'; did you mean '%s%s%s'?", scree_show(text).text, nearest,
                          number[0] ? " " : "", number[0] ? scree_show(number).text : "");
    else
        scree_problem_add(reader, place, s->id, text, forms_of_all, "there is no criterion '%s'",
                          scree_show(text).text);
}

/// Every name of an expression has a result of a run.
static double check_name(void *user, const char *name)
{
    scree_reference reference;
    bool *good = user;
    *good &= scree_reference_read(name, &reference);
    return 1.5;
}

static void check_statement(scree_reader *reader, scree_statement *s, const scree_node *node)
{
    double value;
    bool good = true;
    scree_error error;
    if (!s->id || !s->criterion || !s->value || !s->given) return; // noted
    const scree_node *criterion = scree_node_find(node, "criterion"), *expression = scree_node_find(node, "value");
    s->place = node->place;
    s->value_place = expression->place;
    if (!read_criterion(s)) refuse_criterion(reader, criterion->place, s);
    if (scree_expression_evaluate(s->value, check_name, &good, &value, &error))
        scree_problem_add(reader, expression->place, s->id, s->value, NULL, "%s", error.message);
    else if (!good)
        scree_problem_add(reader, expression->place, s->id, s->value, "CASE/LABEL.RESULT",
                          "names are not of this form");
    const bool about_given = s->kind == SCREE_CRITERION_WITHIN || s->kind == SCREE_CRITERION_EQUIVALENT;
    if (about_given && scree_units_parse(s->given, "1", &s->bound[1], NULL))
        scree_problem_add(reader, node->place, s->id, s->given, "a number", "'%s' needs a number in 'given', not '%s'",
                          criteria[s->kind], scree_show(s->given).text);
    if (s->form != SCREE_FORM_ANY && s->reason && !s->reason[0])
        scree_problem_add(reader, node->place, s->id, NULL, "reason: why the other form cannot decide it",
                          "'form' needs a 'reason'");
}

/// The id must not have been used before statement k of case i.
static void check_id(scree_reader *reader, const scree_statement_table *table, int64_t i, int64_t k,
                     const scree_node *node)
{
    const char *id = table->cases[i].statements[k].id;
    for (int64_t a = 0; id && a <= i; a++)
        for (int64_t b = 0; b < (a < i ? table->cases[a].statement_count : k); b++) {
            const char *other = table->cases[a].statements[b].id;
            if (other && strcmp(other, id) == 0)
                scree_problem_add(reader, node->place, id, NULL, NULL, "another statement has this id too");
        }
}

typedef struct reading {
    scree_statement_table *table;
    const scree_findings *findings;
} reading;

static void check_table(scree_reader *reader, void *user)
{
    const reading *r = user;
    scree_statement_table *table = r->table;
    const scree_node *cases = scree_node_find(reader->root, "cases");
    for (int64_t i = 0; i < table->case_count; i++) {
        const scree_node *entry = scree_node_at(cases, (size_t)i), *list = scree_node_find(entry, "statements");
        const scree_node *name = scree_node_find(entry, "case");
        if (name) table->cases[i].place = name->place;
        for (int64_t k = 0; k < table->cases[i].statement_count; k++) {
            check_statement(reader, &table->cases[i].statements[k], scree_node_at(list, (size_t)k));
            check_id(reader, table, i, k, scree_node_at(list, (size_t)k));
        }
    }
    if (r->findings) scree_statements_check_names(reader, table, r->findings);
}

scree_status scree_statements_read(const char *name, const char *text, size_t length, const scree_findings *findings,
                                   scree_arena *arena, scree_statement_table *table, scree_problems **problems)
{
    reading r = {table, findings};
    scree_document document = {&schema, check_table, &r, name, text, length};
    return scree_document_read(&document, arena, table, sizeof *table, problems);
}

scree_statement_range scree_statement_accepts(const scree_statement *s)
{
    switch (s->kind) {
    case SCREE_CRITERION_WITHIN:
        return (scree_statement_range){s->bound[1] - s->bound[0] * fabs(s->bound[1]),
                                       s->bound[1] + s->bound[0] * fabs(s->bound[1]), true};
    case SCREE_CRITERION_EQUIVALENT:
        return (scree_statement_range){s->bound[1] - s->bound[0], s->bound[1] + s->bound[0], true};
    case SCREE_CRITERION_GREATER:
        return (scree_statement_range){s->bound[0], INFINITY, false};
    case SCREE_CRITERION_LESS:
        return (scree_statement_range){-INFINITY, s->bound[0], false};
    case SCREE_CRITERION_BETWEEN:
        return (scree_statement_range){s->bound[0], s->bound[1], true};
    case SCREE_CRITERION_HOLDS:
        break;
    }
    return (scree_statement_range){0.5, INFINITY, false};
}
