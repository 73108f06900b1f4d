/// Speed of a small sample, everything on: the built-in case biaxial-timescales with 983 discs (pressure on the
/// Delaunay boundary, energy ledger, guards), scheme III (Padbidri 2010, table 2.1), from the begin of loading on.
/// Prints particle-steps per second of one thread and of two, and the hours that 10 % strain (1e8 steps) would take.
///
/// Then table 2.1: the sequences of two timescales, one after the other on the same sample with one thread, as
/// speed-ups over scheme III in force evaluations and in wall time.
///
/// A figure is the best of several short runs. Arguments: --threads N (1 and 2 when not given, no
/// table then), and key=value overrides of the case.
#include "bench.h"

#include "run/simulation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 8, STEPS = 4000, SEQUENCE_TICKS = 5000, MOST_OVERRIDES = 16 };
static const double full_steps = 1e8;

static double measure(scree_simulation *s, int threads)
{
    double best = 0;
    scree_error error;
    s->work.threads = threads;
    for (int run = 0; run < RUNS; run++) {
        uint64_t first = s->state.evaluations;
        double begin = seconds(threads);
        for (int k = 0; k < STEPS; k++) require(scree_simulation_step(s, &error), &error);
        double elapsed = seconds(threads) - begin;
        best = fmax(best, (double)s->state.count * (double)(s->state.evaluations - first) / elapsed);
    }
    return best;
}

/// Ticks (small steps) per second with the sequence m(n+q).
static double measure_sequence(scree_simulation *s, uint64_t n, uint64_t q, double *evaluations)
{
    double best = 0;
    scree_error error;
    s->stage_model.large_multiple = n;
    s->stage_model.small_steps = q;
    for (int run = 0; run < RUNS; run++) {
        uint64_t step = s->state.step, first = s->state.evaluations;
        double begin = seconds(1);
        while (s->state.step < step + SEQUENCE_TICKS) require(scree_simulation_step(s, &error), &error);
        best = fmax(best, SEQUENCE_TICKS / (seconds(1) - begin));
        *evaluations = (double)(s->state.evaluations - first);
    }
    return best;
}

static void print_table(scree_simulation *s)
{
    static const struct {
        const char *name;
        uint64_t n, q;
    } table[] = {{"III", 1, 0},        {"2(20+5)", 20, 5}, {"2(15+10)", 15, 10},
                 {"2(10+15)", 10, 15}, {"5(5+5)", 5, 5},   {"I", 50, 0}};
    double rate_of_small_steps = 0;
    s->work.threads = 1;
    printf("\n%-10s %20s %12s\n", "sequence", "force evaluations", "wall time");
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        double evaluations, rate = measure_sequence(s, table[k].n, table[k].q, &evaluations);
        if (k == 0) rate_of_small_steps = rate;
        printf("%-10s %20.4f %12.3f\n", table[k].name, SEQUENCE_TICKS / evaluations, rate / rate_of_small_steps);
    }
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
    if (from < to) print_table(&s);
    scree_simulation_close(&s);
    scree_case_free(c);
    return EXIT_SUCCESS;
}
