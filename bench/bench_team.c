/// One thread and two beside other work: the built-in biaxial cases of 983 and 4000 discs from the begin of loading on,
/// everything on (pressure on the Delaunay boundary, energy ledger, guards), alone and beside one process that computes
/// and never waits. `two, kept` are two threads that do not give way (what a run does not do). All of a row are
/// measured in turn for SECONDS each, in ROUNDS rounds; the table shows the medians by the wall, and two threads over
/// one beside the same work. Other work on the machine spoils it. Argument: seconds of a measurement.
#include "bench.h"

#include "run/simulation.h"

#include <math.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ROUNDS = 5, WAYS = 3 };
static double measured_seconds = 2;

static pid_t start_busy_process(void)
{
    pid_t child = fork();
    if (child == 0)
        for (volatile unsigned k = 0;; k++) continue;
    return child;
}

static void stop_busy_process(pid_t child)
{
    (void)kill(child, SIGKILL);
    (void)waitpid(child, NULL, 0);
}

/// Million particle-steps per second. way: 0 one thread, 1 two that may give way, 2 two that are kept.
static double measure(scree_simulation *s, int way)
{
    scree_error error;
    s->work.threads = way == 0 ? 1 : 2;
    s->work.keep_threads = way == 2;
    uint64_t first = s->state.evaluations;
    double begin = seconds(2), passed = 0;
    while (passed < measured_seconds) {
        for (int k = 0; k < 16; k++) require(scree_simulation_step(s, &error), &error);
        passed = seconds(2) - begin;
    }
    return 1e-6 * (double)s->state.count * (double)(s->state.evaluations - first) / passed;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_row(scree_simulation *s, bool busy)
{
    double speed[WAYS][ROUNDS];
    for (int round = 0; round < ROUNDS; round++) {
        pid_t child = busy ? start_busy_process() : 0;
        for (int way = 0; way < WAYS; way++) speed[way][round] = measure(s, way);
        if (busy) stop_busy_process(child);
    }
    for (int way = 0; way < WAYS; way++) qsort(speed[way], ROUNDS, sizeof(double), compare);
    printf("%8zu %-20s", s->state.count, busy ? "one busy process" : "nothing");
    for (int way = 0; way < WAYS; way++) printf(" %10.2f", speed[way][ROUNDS / 2]);
    printf(" %10.2f\n", speed[1][ROUNDS / 2] / speed[0][ROUNDS / 2]);
}

int main(int argc, char **argv)
{
    // Slow enough that no measurement reaches the end of the loading.
    static const char *const sets[][2] = {{"particles.count=983", "stages.compress.rate=1e-3 1/s"},
                                          {"particles.count=4000", "stages.compress.rate=1e-3 1/s"}};
    if (argc > 1) measured_seconds = strtod(argv[1], NULL);
    printf("%8s %-20s %10s %10s %10s %10s\n", "discs", "beside", "one", "two", "two, kept", "two / one");
    for (int k = 0; k < 2; k++) {
        scree_case_options choice = {.overrides = sets[k], .override_count = 2};
        scree_problems *problems = NULL;
        scree_case *c = NULL;
        scree_error error;
        scree_simulation s;
        if (scree_case_read(SCREE_SOURCE_DIR "/cases/biaxial.yaml", &choice, &c, &problems))
            require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
        require(scree_simulation_open(c, 2, &s, &error), &error);
        while (!s.stage || !s.stage->loading) require(scree_simulation_step(&s, &error), &error);
        for (int busy = 0; busy < 2; busy++) print_row(&s, busy);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    return EXIT_SUCCESS;
}
