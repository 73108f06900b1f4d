/// Speed of a small sample, everything on: the built-in case biaxial-timescales with 983 discs (pressure on the
/// Delaunay boundary, energy ledger, guards), scheme III (Padbidri 2010, table 2.1), from the begin of loading on.
/// Prints particle-steps per second of one thread and of two, and the hours that 10 % strain (1e8 steps) would take.
///
/// A figure is the best of several short runs, by the wall clock. Arguments: --threads N (1 and 2 when not given), and
/// key=value overrides of the case.
#include "run/recorder.h"
#include "run/simulation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 12, STEPS = 4000, MOST_OVERRIDES = 16 };
static const double full_steps = 1e8;

static void require(scree_status status, const scree_error *error)
{
    if (!status) return;
    (void)fprintf(stderr, "bench_small: %s\n", error->message);
    exit(EXIT_FAILURE);
}

static double measure(scree_simulation *s, int threads)
{
    double best = 0;
    scree_error error;
    s->work.threads = threads;
    for (int run = 0; run < RUNS; run++) {
        uint64_t first = s->state.evaluations;
        double begin = scree_clock();
        for (int k = 0; k < STEPS; k++) require(scree_simulation_step(s, &error), &error);
        double elapsed = scree_clock() - begin;
        best = fmax(best, (double)s->state.count * (double)(s->state.evaluations - first) / elapsed);
    }
    return best;
}

int main(int argc, char **argv)
{
    const char *overrides[MOST_OVERRIDES] = {"integrator.repeats=50", "integrator.large_multiple=1",
                                             "integrator.small_steps=0"};
    size_t count = 3;
    int from = 1, to = 2;
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--threads") == 0 && k + 1 < argc)
            from = to = (int)strtol(argv[++k], NULL, 10);
        else if (strchr(argv[k], '=') && count < MOST_OVERRIDES)
            overrides[count++] = argv[k];
        else
            return (void)fprintf(stderr, "bench_small: what is '%s'?\n", argv[k]), EXIT_FAILURE;
    }
    scree_case_options choice = {.overrides = overrides, .override_count = count};
    scree_problems *problems = NULL;
    scree_case *c = NULL;
    scree_error error;
    scree_simulation s;
    if (scree_case_read(SCREE_SOURCE_DIR "/cases/biaxial-timescales.yaml", &choice, &c, &problems))
        require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_simulation_open(c, 1, &s, &error), &error);
    while (!s.stage || !s.stage->loading) require(scree_simulation_step(&s, &error), &error);
    printf("%8s %8s %8s %10s %8s %20s\n", "discs", "threads", "Mps/s", "ns", "rebuilds", "hours of 1e8 steps");
    for (int threads = from; threads <= to; threads++) {
        uint64_t rebuilds = s.work.rebuilds;
        double rate = measure(&s, threads);
        printf("%8zu %8d %8.2f %10.1f %8llu %20.2f\n", s.state.count, threads, 1e-6 * rate, 1e9 / rate,
               (unsigned long long)(s.work.rebuilds - rebuilds), full_steps * (double)s.state.count / rate / 3600);
    }
    scree_simulation_close(&s);
    scree_case_free(c);
    return EXIT_SUCCESS;
}
