/// The CASE|DIR of verbs that look at a specimen: a simulation that stands where --at says.
#ifndef SCREE_CLI_SPECIMEN_ARGUMENT_H
#define SCREE_CLI_SPECIMEN_ARGUMENT_H

#include "cli/command.h"

typedef struct scree_specimen_argument {
    scree_case *c;
    scree_simulation *simulation;
    scree_particle_elasticity given;
    const scree_particle_elasticity *elasticity; ///< of --young-modulus and --poisson-ratio; NULL: as the case says
} scree_specimen_argument;

/// Free it. On failure everything that is wrong has been printed, and nothing is left to free.
scree_status scree_specimen_argument_read(const scree_command *command, scree_specimen_argument *out);
void scree_specimen_argument_free(scree_specimen_argument *argument);

/// A folder with a case in it, which every run writes first.
bool scree_argument_is_run(const char *folder);

#endif
