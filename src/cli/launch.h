/// Whether a launcher of MPI (mpirun, srun with PMI) has started this program more than once.
#ifndef SCREE_CLI_LAUNCH_H
#define SCREE_CLI_LAUNCH_H

#include <stdbool.h>

/// False where this is one of several processes of a launcher: each would compute the whole case into the same folder.
/// Process 0 says so on standard error, the others are silent. verb: what was asked for.
bool scree_launch_is_single(const char *verb);

#endif
