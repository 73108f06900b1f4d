/// Nanoseconds of scree_polygon_pair_overlap a pair: polygons with 6 to 24 corners (in sectors of a circle, equal area, any
/// angle) that touch at a depth of 0.002 radii, and that are 0.01 radii apart, with the edge remembered and without.
/// So many pairs that no processor learns by heart how each of them branches, as in a run; one thread. bench_polygons_v3
/// and _v4 have corners in lanes (shape/corner_lanes.h), as runs do where the processor has such instructions.
#include "bench.h"

#include "base/processor.h"
#include "base/random.h"
#include "shape/polygon_make.h"
#include "shape/polygon_pair.h"

enum { PAIRS = 4096, ROUNDS = 250 };

typedef struct pair {
    double corner[2][SCREE_POLYGON_CORNERS][2], apart[2];
    scree_polygon polygon[2];
    int hint;
} pair;

static pair pairs[PAIRS];

/// The call as a kernel makes it, but for being inline.
__attribute__((noinline)) static bool look(pair *p, scree_overlap *overlap)
{
    return scree_polygon_pair_overlap(&p->polygon[0], &p->polygon[1], p->apart, &p->hint, overlap);
}

static void put(pair *p, double angle, double distance)
{
    p->apart[0] = distance * cos(angle);
    p->apart[1] = distance * sin(angle);
    p->hint = 0;
}

/// Two polygons at the distance `beyond` the one at which they come to touch.
static void make(uint64_t id, int corners, double beyond)
{
    pair *p = &pairs[id];
    scree_overlap overlap;
    scree_error error = {0};
    for (uint64_t b = 0; b < 2; b++) {
        double own[SCREE_POLYGON_CORNERS][2], turn = 7 * scree_random_uniform(1, SCREE_RANDOM_TEST, 2 * id + b);
        require(scree_polygon_make_on_ellipse(1, 2 * id + b, corners, 1, SCREE_POLYGON_SECTORS, 1, own, &error),
                &error);
        scree_polygon_turn(corners, (const double(*)[2])own, cos(turn), sin(turn), p->corner[b]);
        const double(*posed)[2] = (const double(*)[2])p->corner[b];
        p->polygon[b] = (scree_polygon){posed, corners, 1, scree_polygon_measure(corners, posed).bound * (1 + 1e-12)};
    }
    double angle = (double)id, near = 0, far = 4;
    for (int k = 0; k < 40; k++) {
        put(p, angle, (near + far) / 2);
        *(look(p, &overlap) ? &near : &far) = (near + far) / 2;
    }
    put(p, angle, near + beyond);
}

/// Nanoseconds a pair; *met: how many overlap.
static double measure(bool forget, int *met)
{
    scree_overlap overlap;
    double best = INFINITY;
    for (int run = 0; run < 5; run++) {
        double start = seconds(1);
        *met = 0;
        for (int round = 0; round < ROUNDS; round++)
            for (int k = 0; k < PAIRS; k++) {
                if (forget) pairs[k].hint = 0;
                *met += look(&pairs[k], &overlap);
            }
        best = fmin(best, seconds(1) - start);
        *met /= ROUNDS;
    }
    return 1e9 * best / ROUNDS / PAIRS;
}

/// The level of the processor that this file is compiled for; 0: any.
#ifndef MEASURED_LEVEL
#define MEASURED_LEVEL 0
#endif

int main(void)
{
    if (scree_processor_best() < MEASURED_LEVEL) {
        (void)printf("this processor has no instructions of level %d\n", MEASURED_LEVEL);
        return 0;
    }
    static const int corners[] = {6, 7, 8, 12, 24};
    for (size_t c = 0; c < sizeof corners / sizeof *corners; c++) {
        int met[3];
        for (uint64_t id = 0; id < PAIRS; id++) make(id, corners[c], -0.002);
        double touching = measure(false, &met[0]);
        for (uint64_t id = 0; id < PAIRS; id++) make(id, corners[c], 0.01);
        double anew = measure(true, &met[1]), remembered = measure(false, &met[2]);
        (void)printf(
            "%2d corners: touching %5.1f ns (%d of %d), apart %5.1f ns, with the edge remembered %5.1f ns (%d)\n",
            corners[c], touching, met[0], PAIRS, anew, remembered, met[1] + met[2]);
    }
    return 0;
}
