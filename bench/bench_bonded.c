/// Time of a step of 5000 bonded discs (bench/data/bonded.yaml): rigid, and with strains that follow the forces
/// (deformation: explicit), in turn in short slices, so that other work on the machine hits all alike. Prints the
/// least time of a step of each, one thread, and over that of rigid bodies. Argument: the number of slices (400).
#include "bench.h"

#include "run/simulation.h"

#include <math.h>

enum { SLICES = 400, MOST_SLICES = 1000000, STEPS = 25, VARIANTS = 3 };

typedef struct runner {
    const char *name, *override;
    scree_case *c;
    scree_simulation s;
    double best; ///< s
} runner;

/// Up to the first step of the stage behind the bonds.
static void begin(runner *r)
{
    const scree_case_options choice = {.overrides = &r->override, .override_count = r->override ? 1 : 0};
    scree_problems *problems = NULL;
    scree_error error;
    if (scree_case_read(SCREE_SOURCE_DIR "/bench/data/bonded.yaml", &choice, &r->c, &problems))
        require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_simulation_open(r->c, 1, &r->s, &error), &error);
    while (r->s.state.stage.index < 3) require(scree_simulation_step(&r->s, &error), &error);
    r->best = INFINITY;
}

static void slice(runner *r)
{
    scree_error error;
    const double first = seconds(1);
    for (int k = 0; k < STEPS; k++) require(scree_simulation_step(&r->s, &error), &error);
    r->best = fmin(r->best, (seconds(1) - first) / STEPS);
}

int main(int argc, char **argv)
{
    const long given = argc > 1 ? strtol(argv[1], NULL, 10) : SLICES;
    const int slices = given > 0 && given <= MOST_SLICES ? (int)given : SLICES;
    runner runners[VARIANTS] = {{.name = "rigid"},
                                {.name = "explicit", .override = "contact.deformation=explicit"},
                                {.name = "relaxed", .override = "contact.deformation=relaxed"}};
    for (int k = 0; k < VARIANTS; k++) begin(&runners[k]);
    for (int n = 0; n < slices; n++)
        for (int k = 0; k < VARIANTS; k++) slice(&runners[k]);
    printf("%-12s %10s %10s\n", "deformation", "us a step", "over rigid");
    for (int k = 0; k < VARIANTS; k++) {
        printf("%-12s %10.1f %10.2f\n", runners[k].name, 1e6 * runners[k].best, runners[k].best / runners[0].best);
        scree_simulation_close(&runners[k].s);
        scree_case_free(runners[k].c);
    }
    return EXIT_SUCCESS;
}
