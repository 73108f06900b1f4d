/// A command line, read against the table of verbs.
#ifndef SCREE_CLI_COMMAND_H
#define SCREE_CLI_COMMAND_H

#include "cli/verbs.h"

typedef struct scree_command_option {
    const scree_verb_option *option;
    const char *value; ///< NULL for a switch
} scree_command_option;

typedef struct scree_command {
    const scree_verb *verb;
    const char **argument;
    size_t argument_count;
    scree_command_option *option; ///< in the order given
    size_t option_count;
} scree_command;

/// Reads the words after the verb: `--name value`, `--name=value`, `-n value`, `-nvalue`, switches and arguments in any
/// order; `--` ends the options. Free *command in any case. Errors: SCREE_ERROR_INPUT with the option as field and the
/// nearest option as accepted; SCREE_ERROR_IO out of memory. With --help the arguments are not checked.
scree_status scree_command_parse(const scree_verb *verb, size_t count, char *const *words, scree_command *command,
                                 scree_error *error);
void scree_command_free(scree_command *command);

bool scree_command_has(const scree_command *command, const char *name);
/// Value of an option; of the last one when it was given several times; NULL when it was not given.
const char *scree_command_value(const scree_command *command, const char *name);
/// All values of a repeatable option into `values`, which holds option_count; returns how many.
size_t scree_command_values(const scree_command *command, const char *name, const char **values);

/// Whole number from `least` to `most` of an option into *value, which stays as it is when the option was not given.
scree_status scree_command_number(const scree_command *command, const char *name, long least, long most, long *value,
                                  scree_error *error);

/// Finite number in SI units of an option into *value, which stays as it is when the option was not given.
scree_status scree_command_real(const scree_command *command, const char *name, double *value, scree_error *error);

/// Place in `words`, which NULL ends, of the value of an option; *index stays as it is when it was not given.
scree_status scree_command_choice(const scree_command *command, const char *name, const char *const *words,
                                  size_t *index, scree_error *error);

/// Fills `error` as an error of input: `field: message (accepted: accepted)`. Returns SCREE_ERROR_INPUT.
scree_status scree_command_refuse(scree_error *error, const char *field, const char *accepted, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
