/// The one table of the command line: every verb with its arguments, options, texts and function. Parsing, --help, the
/// man page and shell completion are made from it and from nothing else.
///
/// Long texts are paragraphs separated by an empty line; words between backquotes are literal.
#ifndef SCREE_CLI_VERBS_H
#define SCREE_CLI_VERBS_H

#include <scree/scree.h>

/// What a value stands for, so that a shell can complete it.
typedef enum scree_value_kind {
    SCREE_VALUE_TEXT,
    SCREE_VALUE_FILE,
    SCREE_VALUE_FOLDER,
    SCREE_VALUE_CASE,    ///< a case file or the name of a built-in case
    SCREE_VALUE_BUILTIN, ///< the name of a built-in case
    SCREE_VALUE_RESULT,  ///< the name of a result of the run in the first argument
    SCREE_VALUE_FIGURE,  ///< the name of a figure of the run in the first argument
    SCREE_VALUE_VERB,
    SCREE_VALUE_SWEEP, ///< a sweep file or the name of a built-in sweep
    SCREE_VALUE_KEY,   ///< KEY=VALUE, with a key of the case in the first argument
} scree_value_kind;

typedef struct scree_verb_argument {
    const char *name; ///< in capitals
    const char *meaning;
    scree_value_kind kind;
    bool optional;
    bool repeated; ///< the last one only: takes all that follow
} scree_verb_argument;

typedef struct scree_verb_option {
    const char *name;  ///< without its two dashes
    char letter;       ///< one-letter form, 0: none
    const char *value; ///< name of its value, in capitals; NULL: a switch
    const char *meaning;
    const char *preset; ///< what holds without the option; NULL: nothing to say
    scree_value_kind kind;
    bool repeatable;
} scree_verb_option;

typedef struct scree_verb_example {
    const char *line;
    const char *meaning;
} scree_verb_example;

enum { SCREE_VERB_ROWS = 32 }; ///< most arguments, options, examples of a verb; each list ends with an empty row

struct scree_command;

typedef struct scree_verb {
    const char *name;    ///< a word, or two: of a group of verbs, `theory`, and what distinguishes it
    const char *meaning; ///< one line
    const char *text;
    scree_verb_argument argument[SCREE_VERB_ROWS];
    scree_verb_option option[SCREE_VERB_ROWS];
    scree_verb_example example[SCREE_VERB_ROWS];
    bool alone;    ///< computes: one process, not several that a launcher of MPI started
    bool together; ///< `alone`, but several processes can compute one run where the program is built with MPI
    int status[6]; ///< exit statuses beside 0, ends with 0
    scree_status (*function)(const struct scree_command *command);
} scree_verb;

/// The verbs in their order; NULL behind the last one.
const scree_verb *scree_verb_at(size_t number);

/// Those of the group `theory` (verbs_theory.c).
extern const scree_verb scree_theory_verbs[];
extern const size_t scree_theory_verbs_count;

/// Those that are asked of a run that is there (verbs_results.c).
extern const scree_verb scree_results_verbs[];
extern const size_t scree_results_verbs_count;

/// Options that every verb has.
extern const scree_verb_option scree_common_options[];

/// Variables that the program reads: name and meaning; ends with a NULL line.
extern const scree_verb_example scree_environment[];

/// What the program is, for the head of the help and the man page.
extern const char scree_purpose[];

typedef struct scree_exit_status {
    int status;
    const char *meaning;
} scree_exit_status;
extern const scree_exit_status scree_exit_statuses[]; ///< ends with a NULL meaning

/// NULL when there is none.
const scree_verb *scree_verb_find(const char *name);
/// The verb that a line of words begins with, and how many words its name takes. NULL: none; prints to standard error
/// that there is no such verb, or which verbs of the group there are.
const scree_verb *scree_verb_match(size_t count, const char *const *words, size_t *used);
const char *scree_exit_status_meaning(int status);
scree_status scree_verb_list(const struct scree_command *command);
scree_status scree_verb_new(const struct scree_command *command);
scree_status scree_verb_check(const struct scree_command *command);
scree_status scree_verb_stability(const struct scree_command *command);
scree_status scree_verb_moduli(const struct scree_command *command);
scree_status scree_verb_theory_lattice(const struct scree_command *command);
scree_status scree_verb_theory_pile(const struct scree_command *command);
scree_status scree_verb_theory_layer(const struct scree_command *command);
scree_status scree_verb_run(const struct scree_command *command);
scree_status scree_verb_bisect(const struct scree_command *command);
scree_status scree_verb_sweep(const struct scree_command *command);
scree_status scree_verb_reproduce(const struct scree_command *command);
scree_status scree_verb_report(const struct scree_command *command);
scree_status scree_verb_measure(const struct scree_command *command);
scree_status scree_verb_get(const struct scree_command *command);
scree_status scree_verb_export(const struct scree_command *command);
scree_status scree_verb_plot(const struct scree_command *command);
scree_status scree_verb_help(const struct scree_command *command);

#endif
