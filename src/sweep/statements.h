/// What the published sources state, and how it is judged: tables in cases/reproduction, in the language of cases.
#ifndef SCREE_SWEEP_STATEMENTS_H
#define SCREE_SWEEP_STATEMENTS_H

#include "case/document.h"

typedef enum scree_criterion {
    SCREE_CRITERION_WITHIN,  ///< of the source's value, by a fraction of it
    SCREE_CRITERION_GREATER, ///< than a number
    SCREE_CRITERION_LESS,
    SCREE_CRITERION_BETWEEN, ///< two numbers
    SCREE_CRITERION_HOLDS,   ///< the value is a comparison, true in more than half of the realisations
} scree_criterion;

typedef enum scree_statement_form { SCREE_FORM_ANY, SCREE_FORM_QUICK, SCREE_FORM_FULL } scree_statement_form;

typedef struct scree_statement {
    char *id;
    char *text;        ///< the statement
    char *source;      ///< "P table 2.1"
    char *given;       ///< the source's value, as it is shown
    char *value;       ///< expression
    char *criterion;   ///< "within 10 %", "between 2 and 4", ...
    char *unit;        ///< shown behind our value; "" for none
    int form;          ///< scree_statement_form
    char *explanation; ///< of a known difference; shown only when there is one
    scree_criterion kind;
    double bound[2];
} scree_statement;

typedef struct scree_statement_group {
    char *name; ///< case
    char *meaning;
    scree_statement *statements;
    int64_t statement_count;
} scree_statement_group;

typedef struct scree_statement_table {
    int64_t language;
    char *source; ///< of the whole table, e.g. "Padbidri 2010"
    scree_statement_group *cases;
    int64_t case_count;
} scree_statement_table;

/// Reads a table; texts live in `arena`. Errors as scree_document_read: all problems at once, with positions.
scree_status scree_statements_read(const char *name, const char *text, size_t length, scree_arena *arena,
                                   scree_statement_table *table, scree_problems **problems) SCREE_MUST_USE;

/// Whether `value` meets the criterion.
bool scree_statement_agrees(const scree_statement *statement, double value);

#endif
