/// Asking a run or a sweep to stop: SIGINT, SIGTERM, SIGUSR1, SIGHUP and SIGXCPU ask, a second SIGINT or SIGTERM
/// ends the program at once. SIGUSR1 is what a batch system sends some time before a job's limit (docs/clusters.md).
#ifndef SCREE_CLI_STOP_H
#define SCREE_CLI_STOP_H

/// Where the number of the signal appears, for the options of a run or a sweep.
const volatile int *scree_stop_signal(void);

/// From here on the signals are caught.
void scree_stop_catch(void);

#endif
