/// Clocks of the machine, in seconds. No result of a run follows them.
#ifndef SCREE_BASE_CLOCK_H
#define SCREE_BASE_CLOCK_H

#include <time.h>

/// One clock of clock_gettime(2) [s].
static inline double scree_clock_read(clockid_t which)
{
    struct timespec now;
    clock_gettime(which, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Wall time since an arbitrary moment [s].
static inline double scree_clock(void)
{
    return scree_clock_read(CLOCK_MONOTONIC);
}

#endif
