/// Whether a launcher of MPI (mpirun, srun with PMI) has started this program more than once.
#ifndef SCREE_CLI_LAUNCH_H
#define SCREE_CLI_LAUNCH_H

#include "cli/verbs.h"

/// True in one process, and in several of a launcher that compute one run together: the verb can, and the program is
/// built with MPI. Else each would compute the whole case into the same folder: process 0 says so on standard error,
/// the others are silent.
bool scree_launch_allows(const scree_verb *verb);

/// What all processes would say, process 0 says: the others are silent until scree_launch_speak with what this returns.
int scree_launch_hush(void);
void scree_launch_speak(int kept);

#endif
