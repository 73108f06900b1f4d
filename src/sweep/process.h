/// Members as processes of their own: the only place of Scree that forks to run Scree.
///
/// A child is the leader of its own process group, so that Ctrl-C on the terminal reaches the sweep alone, which passes
/// it on once (a second signal would end a run without a checkpoint). When the sweep dies, the kernel sends the
/// child SIGTERM: it stops after a checkpoint and no orphan computes on.
#ifndef SCREE_SWEEP_PROCESS_H
#define SCREE_SWEEP_PROCESS_H

#include "base/error.h"

#include <stdbool.h>
#include <sys/types.h>

/// Starts `arguments[0]` (a path) with `arguments`, NULL-terminated; standard output and error go to `output`.
/// Errors (SCREE_ERROR_IO): the process cannot be made, or the program cannot be started.
scree_status scree_process_start(const char *const *arguments, int output, pid_t *process,
                                 scree_error *error) SCREE_MUST_USE;

/// Whether the process has ended; then *state is its wait status and the process is gone.
bool scree_process_ended(pid_t process, int *state);

/// Asks a process that has not ended to stop after a checkpoint; `several`: it is a launcher of MPI, which passes the
/// signal on to those that it has started.
void scree_process_interrupt(pid_t process, bool several);

#endif
