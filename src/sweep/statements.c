/// Schema and rules of the tables of statements.
#include "sweep/statements.h"

#include "base/units.h"
#include "sweep/expression.h"

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
#define TABLE(title, text, keys)                                                                                       \
    {                                                                                                                  \
        title, text, keys, COUNT(keys)                                                                                 \
    }

static const scree_choice forms[] = {
    {"any", SCREE_FORM_ANY, "both forms"},
    {"quick", SCREE_FORM_QUICK, "the quick form only"},
    {"full", SCREE_FORM_FULL, "the full form only"},
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
         .meaning = "within 10 %, greater than 2, less than 3, between 2 and 4, or holds."),
    KEY(statement, unit, "unit", SCREE_KEY_TEXT, .standard = "", FROM("0"), TO("30"), .meaning = "Shown behind."),
    KEY(statement, form, "form", SCREE_KEY_CHOICE, .choices = forms, .standard = "any",
        .meaning = "Forms of the case that it is about."),
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

/// Criterion as text to kind and bounds; false when it is not one.
static bool read_criterion(scree_statement *s)
{
    static const struct {
        const char *begin;
        scree_criterion kind;
    } forms_of[] = {{"within ", SCREE_CRITERION_WITHIN},
                    {"greater than ", SCREE_CRITERION_GREATER},
                    {"less than ", SCREE_CRITERION_LESS},
                    {"between ", SCREE_CRITERION_BETWEEN}};
    s->kind = SCREE_CRITERION_HOLDS;
    if (strcmp(s->criterion, "holds") == 0) return true;
    for (size_t i = 0; i < COUNT(forms_of); i++) {
        const char *rest = s->criterion + strlen(forms_of[i].begin);
        if (strncmp(s->criterion, forms_of[i].begin, strlen(forms_of[i].begin)) != 0) continue;
        s->kind = forms_of[i].kind;
        if (s->kind != SCREE_CRITERION_BETWEEN) return read_bound(rest, NULL, &s->bound[0]);
        const char *and = strstr(rest, " and ");
        return and&&read_bound(rest, and, &s->bound[0]) && read_bound(and+5, NULL, &s->bound[1]) &&
               s->bound[0] < s->bound[1];
    }
    return false;
}

/// Every name of an expression has a result of a run.
static double check_name(void *user, const char *name)
{
    const char *dot = strrchr(name, '.');
    bool *good = user;
    *good &= dot && dot[1] && dot != name;
    return 1.5;
}

static void check_statement(scree_reader *reader, scree_statement *s, const scree_node *node)
{
    double value;
    bool good = true;
    scree_error error;
    if (!s->id || !s->criterion || !s->value || !s->given) return; // noted
    const scree_node *criterion = scree_node_find(node, "criterion"), *expression = scree_node_find(node, "value");
    if (!read_criterion(s))
        scree_problem_add(reader, criterion->place, s->id, s->criterion,
                          "within 10 %, greater than 2, less than 3, between 2 and 4, holds", "is not a criterion");
    if (scree_expression_evaluate(s->value, check_name, &good, &value, &error))
        scree_problem_add(reader, expression->place, s->id, s->value, NULL, "%s", error.message);
    else if (!good)
        scree_problem_add(reader, expression->place, s->id, s->value, "CASE/LABEL.RESULT",
                          "names are not of this form");
    if (s->kind == SCREE_CRITERION_WITHIN && scree_units_parse(s->given, "1", &s->bound[1], NULL))
        scree_problem_add(reader, node->place, s->id, s->given, "a number", "'within' needs a number in 'given'");
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

static void check_table(scree_reader *reader, void *user)
{
    scree_statement_table *table = user;
    const scree_node *cases = scree_node_find(reader->root, "cases");
    for (int64_t i = 0; i < table->case_count; i++) {
        const scree_node *list = scree_node_find(scree_node_at(cases, (size_t)i), "statements");
        for (int64_t k = 0; k < table->cases[i].statement_count; k++) {
            check_statement(reader, &table->cases[i].statements[k], scree_node_at(list, (size_t)k));
            check_id(reader, table, i, k, scree_node_at(list, (size_t)k));
        }
    }
}

scree_status scree_statements_read(const char *name, const char *text, size_t length, scree_arena *arena,
                                   scree_statement_table *table, scree_problems **problems)
{
    scree_document document = {&schema, check_table, table, name, text, length};
    return scree_document_read(&document, arena, table, sizeof *table, problems);
}

bool scree_statement_agrees(const scree_statement *s, double value)
{
    switch (s->kind) {
    case SCREE_CRITERION_WITHIN:
        return fabs(value - s->bound[1]) <= s->bound[0] * fabs(s->bound[1]);
    case SCREE_CRITERION_GREATER:
        return value > s->bound[0];
    case SCREE_CRITERION_LESS:
        return value < s->bound[0];
    case SCREE_CRITERION_BETWEEN:
        return value >= s->bound[0] && value <= s->bound[1];
    case SCREE_CRITERION_HOLDS:
        return value > 0.5;
    }
    return false;
}
