/// Nanoseconds of scree_polygon_pair_overlap a pair: polygons with 6 to 24 corners (in sectors of a circle, equal area,
/// any angle) that touch at a depth of 0.002 radii, and that are 0.01 radii apart, with the edge remembered and
/// without. So many pairs that no processor learns by heart how each of them branches, as in a run; one thread. Then
/// what it takes to look at a pair that touches and to keep where it crosses (shape/polygon_hint.h), as runs do of
/// pairs that have moved.
#include "bench.h"

#include "base/random.h"
#include "shape/polygon_hint.h"
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

/// Nanoseconds of a look that renews a hint.
static double measure_hints(void)
{
    static scree_pair_hint hint[PAIRS];
    double best = INFINITY;
    for (int run = 0; run < 5; run++) {
        const double start = seconds(1);
        for (int round = 0; round < ROUNDS; round++)
            for (int k = 0; k < PAIRS; k++) {
                const pair *p = &pairs[k];
                const scree_polygon_pose pose = {.polygon = {&p->polygon[0], &p->polygon[1]},
                                                 .apart = {p->apart[0], p->apart[1]}};
                (void)scree_pair_hint_renew(&pose, &hint[k]);
            }
        best = fmin(best, seconds(1) - start);
    }
    return 1e9 * best / ROUNDS / PAIRS;
}

int main(void)
{
    static const int corners[] = {6, 7, 8, 12, 24};
    for (size_t c = 0; c < sizeof corners / sizeof *corners; c++) {
        int met[3];
        for (uint64_t id = 0; id < PAIRS; id++) make(id, corners[c], -0.002);
        double touching = measure(false, &met[0]), kept = measure_hints();
        for (uint64_t id = 0; id < PAIRS; id++) make(id, corners[c], 0.01);
        double anew = measure(true, &met[1]), remembered = measure(false, &met[2]);
        (void)printf("%2d corners: touching %5.1f ns (%d of %d), to keep where %5.1f ns, apart %5.1f ns, with the edge "
                     "remembered %5.1f ns (%d)\n",
                     corners[c], touching, met[0], PAIRS, kept, anew, remembered, met[1] + met[2]);
    }
    return 0;
}
