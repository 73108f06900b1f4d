/// Which sweeps the built-in statements of a form are about: those that an expression names.
#include "sweep/expression.h"
#include "sweep/findings.h"
#include "sweep/statements.h"
#include "sweep/templates.h"

#include <scree/scree.h>

#include <string.h>

typedef struct looking {
    const char *sweep;
    bool found;
} looking;

static double look_at(void *user, const char *name)
{
    looking *l = user;
    scree_reference reference;
    l->found |= scree_reference_read(name, &reference) && strcmp(reference.name, l->sweep) == 0;
    return 1;
}

/// Whether its value names the sweep.
static bool statement_judges(const scree_statement *statement, const char *sweep)
{
    looking l = {sweep, false};
    double ignored;
    scree_error error;
    return !scree_expression_evaluate(statement->value, look_at, &l, &ignored, &error) && l.found;
}

static bool table_judges(const scree_statement_table *table, const char *sweep, bool quick)
{
    const int other = quick ? SCREE_FORM_FULL : SCREE_FORM_QUICK;
    for (int64_t i = 0; i < table->case_count; i++)
        for (int64_t k = 0; k < table->cases[i].statement_count; k++) {
            const scree_statement *s = &table->cases[i].statements[k];
            if (s->form != other && statement_judges(s, sweep)) return true;
        }
    return false;
}

bool scree_report_judges(const char *sweep, bool quick)
{
    bool found = false;
    for (size_t i = 0; i < scree_statement_templates_count && !found; i++) {
        const scree_template *built_in = &scree_statement_templates[i];
        scree_arena arena = {0};
        scree_statement_table table;
        // What cannot be read (memory) leaves nothing out.
        found = scree_statements_read(built_in->name, built_in->text, built_in->length, NULL, &arena, &table, NULL) ||
                table_judges(&table, sweep, quick);
        scree_arena_release(&arena);
    }
    return found;
}
