/// The CASE of a command line: a file, or the name of a built-in case.
#ifndef SCREE_CLI_CASE_ARGUMENT_H
#define SCREE_CLI_CASE_ARGUMENT_H

#include "cli/command.h"

/// Reads `name` with the command's --set and --quick. A file of that name wins over a built-in case. On failure
/// everything that is wrong has been printed to standard error.
scree_status scree_case_argument_read(const scree_command *command, const char *name, scree_case **out);

/// Text of a built-in case, or NULL after an error that names the nearest one.
const char *scree_case_argument_builtin(const scree_command *command, const char *name);

#endif
