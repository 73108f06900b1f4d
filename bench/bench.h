/// What the benchmarks share: failing, clocks, and running a peer.
#ifndef SCREE_BENCH_BENCH_H
#define SCREE_BENCH_BENCH_H

#include "base/error.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static inline void require(scree_status status, const scree_error *error)
{
    if (!status) return;
    (void)fprintf(stderr, "%s: %s\n", program_invocation_short_name, error->message);
    exit(EXIT_FAILURE);
}

/// One thread is timed by its processor time, so that other processes on the machine disturb less; several by the wall.
static inline double seconds(int threads)
{
    struct timespec now;
    (void)clock_gettime(threads > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Runs a LAMMPS command: processor time [s] of its last loop, out of "Loop time of T on ..." and "P% CPU use ..."; 0
/// when it failed. Every line of its output is handed to `look` (may be NULL).
static inline double peer_seconds(const char *command, void (*look)(const char *line, void *user), void *user)
{
    char line[512];
    double elapsed = 0, use = 0;
    FILE *pipe = popen(command, "r");
    while (pipe && fgets(line, sizeof line, pipe)) {
        if (look) look(line, user);
        if (sscanf(line, "Loop time of %lf", &elapsed) == 1) use = 0;
        if (strstr(line, "CPU use")) use = strtod(line, NULL) / 100;
    }
    return pipe && pclose(pipe) == 0 ? elapsed * use : 0;
}

#endif
