/// The bar: bilinear elements in plane stress with one integration point (CPS4R), direct integration in time. With four
/// (CPS4) CalculiX 2.20 gives *DYNAMIC, though not *FREQUENCY, half of the mass: waves are too fast by the root of two
/// (test_finite_elements).
///
/// CalculiX gives plane elements a thickness and one element of a solid across it; with a thickness far below the size
/// of the elements the stress across vanishes, and what moves across has no inertia to speak of. Steps of time are
/// equal, the trapezoidal rule (*DYNAMIC, ALPHA=0: no numerical damping), Rayleigh damping beta K in the material. What
/// a bar could do as a whole is taken away by three equations between its corners.
///
/// Strains are (mean displacement of one end - that of the other) / length. Cost: a linear solve a step.
#include "base/memory.h"
#include "fem/solid.h"
#include "fem/solve.h"

#include <math.h>
#include <string.h>

/// Thickness over the width of an element.
#define SLICE 1e-2

enum { BOTTOM, TOP, LEFT, RIGHT, SIDES };
static const char *const side_name[SIDES] = {"BOTTOM", "TOP", "LEFT", "RIGHT"};

/// Nodes are numbered from 1, by rows from the lower left.
typedef struct grid {
    int64_t across, along;
} grid;

static grid grid_of(const scree_fem_bar *bar)
{
    const double size = bar->width / (double)bar->across;
    return (grid){bar->across, (int64_t)fmax(1, round(bar->height / size))};
}

static int64_t node_of(const grid *g, int64_t i, int64_t j)
{
    return j * (g->across + 1) + i + 1;
}

// ---- deck --------------------------------------------------------------------------------------------------------

static void write_mesh(FILE *deck, const scree_fem_bar *bar, const grid *g)
{
    fputs("*NODE, NSET=ALL\n", deck);
    for (int64_t j = 0; j <= g->along; j++)
        for (int64_t i = 0; i <= g->across; i++)
            fprintf(deck, "%lld, %.12e, %.12e, 0\n", (long long)node_of(g, i, j),
                    bar->width * ((double)i / (double)g->across - 0.5), bar->height * (double)j / (double)g->along);
    fputs("*ELEMENT, TYPE=CPS4R, ELSET=BAR\n", deck);
    int64_t element = 0;
    for (int64_t j = 0; j < g->along; j++)
        for (int64_t i = 0; i < g->across; i++)
            fprintf(deck, "%lld, %lld, %lld, %lld, %lld\n", (long long)++element, (long long)node_of(g, i, j),
                    (long long)node_of(g, i + 1, j), (long long)node_of(g, i + 1, j + 1),
                    (long long)node_of(g, i, j + 1));
}

static void write_sides(FILE *deck, const grid *g)
{
    for (int side = 0; side < SIDES; side++) {
        const bool end = side == BOTTOM || side == TOP;
        fprintf(deck, "*NSET, NSET=%s, GENERATE\n", side_name[side]);
        const int64_t first = side == TOP     ? node_of(g, 0, g->along)
                              : side == RIGHT ? node_of(g, g->across, 0)
                                              : node_of(g, 0, 0);
        const int64_t step = end ? 1 : g->across + 1, last = first + step * (end ? g->across : g->along);
        fprintf(deck, "%lld, %lld, %lld\n", (long long)first, (long long)last, (long long)step);
    }
    fprintf(deck, "*ELSET, ELSET=LOWEST, GENERATE\n1, %lld, 1\n*ELSET, ELSET=HIGHEST, GENERATE\n%lld, %lld, 1\n",
            (long long)g->across, (long long)(g->across * (g->along - 1) + 1), (long long)(g->across * g->along));
}

/// Opposite corners move in opposite ways, as they do in a bar that nothing holds: of the lower and of the upper ones
/// the components across, of the left ones those along.
static void hold(FILE *deck, const grid *g)
{
    const long long corner[4] = {node_of(g, 0, 0), node_of(g, g->across, 0), node_of(g, 0, g->along),
                                 node_of(g, g->across, g->along)};
    fprintf(deck, "*EQUATION\n2\n%lld, 1, 1., %lld, 1, 1.\n2\n%lld, 1, 1., %lld, 1, 1.\n2\n%lld, 2, 1., %lld, 2, 1.\n",
            corner[0], corner[1], corner[2], corner[3], corner[0], corner[2]);
}

static void write_deck(FILE *deck, const scree_fem_bar *bar)
{
    const grid g = grid_of(bar);
    const double duration = bar->time[bar->points - 1];
    fputs("** A bar that is pressed on both ends: plane stress, SI units\n", deck);
    write_mesh(deck, bar, &g);
    write_sides(deck, &g);
    fprintf(deck, "*MATERIAL, NAME=SOLID\n*ELASTIC\n%.12e, %.12e\n*DENSITY\n%.12e\n", bar->young_modulus,
            bar->poisson_ratio, bar->density);
    if (bar->damping > 0) fprintf(deck, "*DAMPING, ALPHA=0, BETA=%.12e\n", bar->damping);
    fprintf(deck, "*SOLID SECTION, ELSET=BAR, MATERIAL=SOLID\n%.12e\n", SLICE * bar->width / (double)g.across);
    fputs("*AMPLITUDE, NAME=PRESSURE\n", deck);
    for (size_t k = 0; k < bar->points; k++) fprintf(deck, "%.12e, %.12e\n", bar->time[k], bar->pressure[k]);
    hold(deck, &g);
    fprintf(deck, "*STEP, INC=%lld\n*DYNAMIC, DIRECT, ALPHA=0\n%.12e, %.12e\n", (long long)(2 * bar->steps),
            duration / (double)bar->steps, duration);
    fputs("*DLOAD, AMPLITUDE=PRESSURE\nLOWEST, P1, 1\nHIGHEST, P3, 1\n", deck);
    for (int side = 0; side < SIDES; side++) fprintf(deck, "*NODE PRINT, NSET=%s\nU\n", side_name[side]);
    fputs("*END STEP\n", deck);
}

// ---- results -----------------------------------------------------------------------------------------------------

/// Sums over the nodes of the sides at one time, component across them.
typedef struct reading {
    const scree_fem_bar *bar;
    scree_fem_bar_result *result;
    size_t room;
    double sum[SIDES];
    int64_t count[SIDES];
} reading;

/// The rows of a time are complete when another one begins.
static void close_time(reading *r)
{
    double mean[SIDES];
    scree_fem_bar_result *out = r->result;
    for (int side = 0; side < SIDES; side++) {
        if (r->count[side] == 0) return;
        mean[side] = r->sum[side] / (double)r->count[side];
    }
    out->axial[out->count - 1] = (mean[BOTTOM] - mean[TOP]) / r->bar->height;
    out->lateral[out->count - 1] = (mean[LEFT] - mean[RIGHT]) / r->bar->width;
}

static void visit(void *user, const scree_fem_row *row)
{
    reading *r = user;
    scree_fem_bar_result *out = r->result;
    if (out->time[out->count - 1] < row->time && out->count < r->room) {
        close_time(r);
        memset(r->sum, 0, sizeof r->sum);
        memset(r->count, 0, sizeof r->count);
        out->time[out->count++] = row->time;
    }
    for (int side = 0; side < SIDES; side++)
        if (strcmp(row->set, side_name[side]) == 0) {
            r->sum[side] += row->value[side == BOTTOM || side == TOP];
            r->count[side]++;
        }
}

void scree_fem_bar_result_destroy(scree_fem_bar_result *result)
{
    scree_release(&result->time);
    scree_release(&result->axial);
    scree_release(&result->lateral);
    *result = (scree_fem_bar_result){0};
}

scree_status scree_fem_bar_solve(const char *directory, const scree_fem_bar *bar, scree_fem_bar_result *result,
                                 scree_error *error)
{
    FILE *deck;
    // The begin, where all is at rest, and a row a step.
    reading r = {.bar = bar, .result = result, .room = (size_t)bar->steps + 1};
    *result = (scree_fem_bar_result){.count = 1};
    scree_status status = scree_allocate(&result->time, r.room, sizeof(double), error);
    if (!status) status = scree_allocate(&result->axial, r.room, sizeof(double), error);
    if (!status) status = scree_allocate(&result->lateral, r.room, sizeof(double), error);
    if (!status) status = scree_fem_deck_open(directory, &deck, error);
    if (!status) {
        write_deck(deck, bar);
        status = scree_fem_deck_solve(directory, deck, error);
    }
    if (!status) status = scree_fem_read(directory, visit, &r, error);
    if (!status) close_time(&r);
    if (!status && result->count < 2)
        status = scree_error_set(error, SCREE_ERROR_IO, "CalculiX (ccx) has left no displacements in '%s'", directory);
    if (status) scree_fem_bar_result_destroy(result);
    return status;
}
