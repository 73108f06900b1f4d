/// What the published sources state, and how it is judged: tables in cases/reproduction, in the language of cases.
#ifndef SCREE_SWEEP_STATEMENTS_H
#define SCREE_SWEEP_STATEMENTS_H

#include "case/document.h"

typedef enum scree_criterion {
    SCREE_CRITERION_WITHIN,     ///< of the source's value, by a fraction of it
    SCREE_CRITERION_EQUIVALENT, ///< the same by a number, so that the value may be 0
    SCREE_CRITERION_GREATER,    ///< than a number
    SCREE_CRITERION_LESS,
    SCREE_CRITERION_BETWEEN, ///< two numbers
    SCREE_CRITERION_HOLDS,   ///< the value is a comparison, true in more than half of all samples
} scree_criterion;

/// What a row is: only findings count in the headline of the page.
typedef enum scree_statement_class {
    SCREE_CLASS_FINDING, ///< of the source: its claim about grains, or a value that it measured
    SCREE_CLASS_CHECK,   ///< our own: an identity, a stop rule, a closed form
    SCREE_CLASS_BEYOND,  ///< beyond the source
    SCREE_CLASSES,
} scree_statement_class;

typedef enum scree_statement_average {
    SCREE_AVERAGE_AUTO,
    SCREE_AVERAGE_PLAIN,
    SCREE_AVERAGE_LOGARITHMS
} scree_statement_average;

typedef enum scree_statement_form { SCREE_FORM_ANY, SCREE_FORM_QUICK, SCREE_FORM_FULL } scree_statement_form;

typedef struct scree_statement {
    char *id;
    char *text;         ///< the statement
    char *source;       ///< "P table 2.1"
    char *given;        ///< the source's value, as it is shown
    char *value;        ///< expression
    char *criterion;    ///< "within 10 %", "equivalent within 0.5", "between 2 and 4", ...
    char *unit;         ///< shown behind our value; "" for none
    int class;          ///< scree_statement_class
    bool deterministic; ///< does not depend on the sample: one decides
    int average;        ///< scree_statement_average
    int form;           ///< scree_statement_form
    char *reason;       ///< why the other form cannot decide it
    char *explanation;  ///< of a known difference; shown only when there is one
    scree_criterion kind;
    double bound[2];
    scree_place place, value_place; ///< in its file
} scree_statement;

typedef struct scree_statement_group {
    char *name; ///< case
    char *meaning;
    scree_statement *statements;
    int64_t statement_count;
    scree_place place; ///< of the name
} scree_statement_group;

typedef struct scree_statement_table {
    int64_t language;
    char *source; ///< of the whole table, e.g. "Padbidri 2010"
    scree_statement_group *cases;
    int64_t case_count;
} scree_statement_table;

struct scree_findings;

/// Reads a table; texts live in `arena`. With `findings` the names of sweeps, points and results are checked against
/// the built-in sweeps and what was found (names.c). Errors as scree_document_read: all problems at once, with
/// positions.
scree_status scree_statements_read(const char *name, const char *text, size_t length,
                                   const struct scree_findings *findings, scree_arena *arena,
                                   scree_statement_table *table, scree_problems **problems) SCREE_MUST_USE;

/// Notes the names of a table that mean nothing, with the nearest right one.
void scree_statements_check_names(scree_reader *reader, const scree_statement_table *table,
                                  const struct scree_findings *findings);

/// Values that meet the criterion: from low to high, the ends themselves if `closed`.
typedef struct scree_statement_range {
    double low, high;
    bool closed;
} scree_statement_range;
scree_statement_range scree_statement_accepts(const scree_statement *statement);

#endif
