/// What the verbs that run sweeps share.
#ifndef SCREE_CLI_SWEEP_COMMAND_H
#define SCREE_CLI_SWEEP_COMMAND_H

#include "cli/command.h"
#include "cli/progress.h"

#include <limits.h>

typedef struct scree_sweep_command {
    scree_sweep_read_options read;
    scree_sweep_options options;
    scree_progress_display display;
    const char **overrides;
    char program[PATH_MAX];
} scree_sweep_command;

/// Options of the command line into *sweep; close it in any case. Errors: as printed.
scree_status scree_sweep_command_open(const scree_command *command, scree_sweep_command *sweep);
void scree_sweep_command_close(scree_sweep_command *sweep);

/// Reads a sweep; everything that is wrong has then been printed.
scree_status scree_sweep_command_read(const scree_command *command, const scree_sweep_command *sweep, const char *name,
                                      scree_sweep **out);

#endif
