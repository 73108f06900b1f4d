/// Members of several processes each, which `mpirun` starts: that of PATH, so that its place can be taken by another
/// launcher which understands `-n N PROGRAM ARGUMENTS` and passes SIGUSR1 on (srun does).
#ifndef SCREE_SWEEP_SEVERAL_H
#define SCREE_SWEEP_SEVERAL_H

#include "sweep/sweep.h"

/// The launcher and its arguments, kept in the struct.
typedef struct scree_several {
    char launcher[4096], ranks[16];
} scree_several;

/// Whether members of this sweep can have options->ranks processes; the first one stands for all. `starts`: here and
/// now, so that the launcher has to be there. Errors: SCREE_ERROR_INPUT, memory.
scree_status scree_several_check(const scree_sweep *sweep, const scree_sweep_options *options, bool starts,
                                 scree_error *error) SCREE_MUST_USE;

/// Puts the words before the program into `arguments`; returns how many: 0 for one process.
size_t scree_several_put(scree_several *several, const scree_sweep_options *options, const char **arguments);

#endif
