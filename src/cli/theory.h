/// What all verbs of the group `theory` do with what they have found.
#ifndef SCREE_CLI_THEORY_H
#define SCREE_CLI_THEORY_H

#include "cli/command.h"

/// Prints the values of a theory that was solved with `status`, writes it into the folder of --output, and frees it.
/// Returns the exit status.
scree_status scree_theory_show(const scree_command *command, scree_theory *theory, scree_status status,
                               scree_error *error);

#endif
