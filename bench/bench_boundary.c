/// Cost of the Delaunay boundary (discs: loop; spheres: hull), and its share of a run at the prescribed interval.
///
/// Built-in cases biaxial and triaxial: the time of one update on the confined sample, that of a step between updates,
/// and update / (interval x step + update). Then one update of large packings as they were dropped. A figure is the
/// best of several, in processor time of one thread. Arguments: the parts to run (discs, spheres, dropped-discs,
/// dropped-spheres); all without any.
#include "bench.h"

#include "boundary/pressure.h"
#include "run/simulation.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 16 };

static void open_case(const char *name, long count, scree_case **c, scree_simulation *s)
{
    char path[512], number[64];
    (void)snprintf(path, sizeof path, "%s/cases/%s.yaml", SCREE_SOURCE_DIR, name);
    (void)snprintf(number, sizeof number, "particles.count=%ld", count);
    const char *overrides[] = {number};
    scree_case_options choice = {.overrides = overrides, .override_count = 1};
    scree_problems *problems = NULL;
    scree_error error;
    if (scree_case_read(path, &choice, c, &problems)) require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_simulation_open(*c, 1, s, &error), &error);
}

/// One update of the boundary [s].
static double time_update(scree_simulation *s)
{
    scree_error error;
    // Due again: as if the interval had passed.
    s->state.step += s->model.upkeep.every;
    double begin = seconds(1);
    require(scree_boundary_refresh(&s->model, &s->state, &error), &error);
    return seconds(1) - begin;
}

/// One step without an update, the mean of many [s]; an update has just been made.
static double time_step(scree_simulation *s)
{
    const int steps = (int)(s->model.upkeep.every / s->model.largest_step) / 2;
    scree_error error;
    double begin = seconds(1);
    for (int k = 0; k < steps; k++) require(scree_simulation_step(s, &error), &error);
    return (seconds(1) - begin) / steps;
}

static void bench_confined(const char *name, long count)
{
    scree_case *c;
    scree_simulation s;
    scree_error error;
    open_case(name, count, &c, &s);
    while (!s.stage || !s.stage->loading) require(scree_simulation_step(&s, &error), &error);
    // In turn, so that both see the machine at its best.
    double step = INFINITY, update = INFINITY, interval = (double)c->config.boundary.every;
    for (int run = 0; run < RUNS; run++) {
        update = fmin(update, time_update(&s));
        step = fmin(step, time_step(&s));
    }
    printf("%-10s %8zu %12.2f %12.1f %10.0f %8.1f %%\n", name, s.state.count, 1e3 * update, 1e6 * step, interval,
           100 * update / (interval * step + update));
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void bench_packing(const char *name, long count)
{
    scree_case *c;
    scree_simulation s;
    scree_error error;
    open_case(name, count, &c, &s);
    while (s.state.stage.index == 0) require(scree_simulation_step(&s, &error), &error);
    double update = INFINITY;
    for (int run = 0; run < RUNS; run++) update = fmin(update, time_update(&s));
    printf("%-10s %8zu %12.2f\n", name, s.state.count, 1e3 * update);
    scree_simulation_close(&s);
    scree_case_free(c);
}

typedef struct part {
    const char *name, *case_name;
    long count;
    void (*bench)(const char *name, long count);
} part;

static bool is_wanted(const char *name, int argc, char **argv)
{
    bool wanted = argc < 2;
    for (int k = 1; k < argc; k++) wanted = wanted || strcmp(argv[k], name) == 0;
    return wanted;
}

int main(int argc, char **argv)
{
    static const part parts[] = {{"discs", "biaxial", 4000, bench_confined},
                                 {"spheres", "triaxial", 3413, bench_confined},
                                 {"dropped-discs", "biaxial", 100000, bench_packing},
                                 {"dropped-spheres", "triaxial", 100000, bench_packing}};
    printf("%-10s %8s %12s %12s %10s %10s\n", "case", "bodies", "update, ms", "step, us", "interval", "share");
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
        if (is_wanted(parts[k].name, argc, argv)) parts[k].bench(parts[k].case_name, parts[k].count);
    return EXIT_SUCCESS;
}
