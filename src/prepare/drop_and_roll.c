/// Drop-and-roll packing after Jodrey & Tory 1979, as Padbidri 2010 (2.5, 3.3) prepares his samples, of discs or
/// spheres.
///
/// Bed: bodies take random places on the floor, in the order of their radii drawn, until one has found none in ATTEMPTS
/// trials. Then each falls at a random place of the box and rolls to a stable place: a disc on two discs on either side
/// of its centre or on a disc and a side wall (drop_2d.c); a sphere on three spheres or walls whose contacts carry its
/// weight (drop_3d.c); either in a gap of the bed that it fits into.
///
/// Levelling. The surface of such a deposit is rough by several diameters, more so the wider it is, and a plate would
/// rest on its highest hill. So more bodies are dropped than are asked for, and those with the lowest centres are kept:
/// what is left is level to about a radius, and still stable, since a body rests on bodies that are kept with it.
///
/// Width auto. The packing is loose along walls and floor, so its height is not known before it is made. The first
/// guess takes a solid fraction over the whole box; a packing made with it tells the height, and the second one has the
/// width that gives the aspect ratio if the solid fraction stays the same.
#include "module/key_rows.h"
#include "prepare/drop_2d.h"
#include "prepare/drop_3d.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ATTEMPTS = 100 };
#define SURPLUS_LAYERS 4.0

/// First guess, by dimension.
static const double SOLID_FRACTION[] = {0, 0, 0.79, 0.56};

/// Bodies dropped into a box, in the order in which they fell.
typedef struct drop {
    uint64_t seed;
    scree_packing packing;
    double *level; ///< m, highest centre among a body and all that it rests on
    union {
        scree_drop_2d discs;   ///< 2D
        scree_drop_3d spheres; ///< 3D
    } pile;
} drop;

static scree_status begin_pile(drop *d, scree_error *error)
{
    const scree_packing *p = &d->packing;
    if (p->dimension == 2)
        return scree_drop_2d_create(&d->pile.discs, p->radius, p->count, p->box.width, p->place[0], p->place[1],
                                    d->level, error);
    const double sides[2] = {p->box.width, p->box.depth};
    return scree_drop_3d_create(&d->pile.spheres, p->radius, p->count, sides, p->place, d->level, error);
}

static void end_pile(drop *d)
{
    if (d->packing.dimension == 2)
        scree_drop_2d_destroy(&d->pile.discs);
    else
        scree_drop_3d_destroy(&d->pile.spheres);
}

/// Random place above the floor at which body `index` does not touch the side walls.
static void random_place(const drop *d, scree_random_stream stream, uint64_t counter, size_t index, double place[2])
{
    const double side[2] = {d->packing.box.width, d->packing.box.depth}, radius = d->packing.radius[index];
    uint64_t axes = d->packing.dimension == 3 ? 2 : 1;
    for (uint64_t c = 0; c < axes; c++)
        place[c] = radius + scree_random_uniform(d->seed, stream, axes * counter + c) * (side[c] - 2 * radius);
}

static bool sees_floor(const drop *d, size_t index, const double place[2])
{
    if (d->packing.dimension == 2) return scree_drop_2d_sees_floor(&d->pile.discs, index, place[0]);
    return scree_drop_3d_sees_floor(&d->pile.spheres, index, place[0], place[1]);
}

static scree_status drop_one(drop *d, size_t index, const double place[2], scree_error *error)
{
    if (d->packing.dimension == 2) return scree_drop_2d_add(&d->pile.discs, index, place[0], error);
    return scree_drop_3d_add(&d->pile.spheres, index, place[0], place[1], error);
}

/// Places the bed; tells how many bodies it has.
static scree_status lay_bed(drop *d, size_t *placed, scree_error *error)
{
    uint64_t trials = 0;
    for (*placed = 0; *placed < d->packing.count; ++*placed) {
        double place[2];
        bool free = false;
        for (int attempt = 0; attempt < ATTEMPTS && !free; attempt++) {
            random_place(d, SCREE_RANDOM_BED, trials++, *placed, place);
            free = sees_floor(d, *placed, place);
        }
        if (!free) return SCREE_OK;
        scree_status status = drop_one(d, *placed, place, error);
        if (status) return status;
    }
    return SCREE_OK;
}

/// Drops all bodies into the box.
static scree_status drop_all(drop *d, scree_error *error)
{
    scree_status status = begin_pile(d, error);
    if (status) return status;
    size_t bed = 0;
    status = lay_bed(d, &bed, error);
    for (size_t i = bed; i < d->packing.count && !status; i++) {
        double place[2];
        random_place(d, SCREE_RANDOM_POSITION, i, i, place);
        status = drop_one(d, i, place, error);
    }
    end_pile(d);
    return status;
}

/// Bodies dropped beyond those asked for: a layer as high as the surface is rough, which grows with the square root of
/// the width in 2D, and hardly in 3D.
static size_t surplus(const scree_model *model, const scree_packing *packing)
{
    double across = packing->box.width / (2 * model->mean_radius), deep = packing->box.depth / (2 * model->mean_radius);
    if (packing->dimension == 2) return (size_t)ceil((SURPLUS_LAYERS + sqrt(across)) * across);
    return (size_t)ceil((SURPLUS_LAYERS + cbrt(fmax(across, deep))) * across * deep);
}

static int compare_heights(const void *a, const void *b)
{
    double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

/// Keeps the lowest of the dropped bodies, in the order in which they were placed; of equally high ones the first.
static void keep_lowest(const drop *d, double *sorted, scree_packing *packing)
{
    const scree_packing *from = &d->packing;
    const int up = packing->dimension - 1;
    memcpy(sorted, d->level, from->count * sizeof *sorted);
    qsort(sorted, from->count, sizeof *sorted, compare_heights);
    double last = packing->count > 0 ? sorted[packing->count - 1] : -1;
    size_t equal = 0, kept = 0;
    for (size_t k = 0; k < packing->count; k++) equal += sorted[k] == last;
    packing->box.height = 0;
    for (size_t i = 0; i < from->count; i++) {
        if (d->level[i] > last || (d->level[i] == last && equal == 0)) continue;
        equal -= d->level[i] == last;
        scree_packing_take(packing, kept, from, i);
        for (int c = 0; c < packing->dimension; c++) packing->place[c][kept] = from->place[c][i];
        packing->box.height = fmax(packing->box.height, from->place[up][i] + from->radius[i]);
        kept++;
    }
}

/// Fills the packing and the height of its box for the width and depth of its box.
static scree_status fill(const scree_model *model, scree_packing *packing, scree_error *error)
{
    drop d = {.seed = model->seed};
    size_t dropped = packing->count + surplus(model, packing);
    scree_status status = scree_packing_create(&d.packing, packing->dimension, dropped, error);
    if (status) return status;
    status = scree_allocate(&d.level, 2 * dropped, sizeof *d.level, error);
    if (!status) {
        d.packing.box = packing->box;
        scree_packing_draw(model, &d.packing);
        status = drop_all(&d, error);
    }
    if (!status) keep_lowest(&d, d.level + dropped, packing);
    scree_release(&d.level);
    scree_packing_destroy(&d.packing);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    (void)stage;
    const scree_box given = packing->box;
    const bool in_3d = packing->dimension == 3;
    double least = 2 * scree_packing_largest(packing), room = scree_packing_solid(packing);
    scree_packing_fit_box(packing, room, SOLID_FRACTION[packing->dimension], least);
    scree_status status = fill(model, packing, error);
    if (status || !isnan(given.width)) return status;
    double solid_fraction = room / (packing->box.width * packing->box.height * (in_3d ? packing->box.depth : 1));
    packing->box = given;
    scree_packing_fit_box(packing, room, solid_fraction, least);
    return fill(model, packing, error);
}

static const scree_preparation preparation = {.needs_walls = true, .dense = true, .place = place};

const scree_module scree_module_drop_and_roll = {
    .name = "drop_and_roll",
    .meaning = "each particle falls and rolls on those below until it is stable (Jodrey and Tory 1979)",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .preparation = &preparation,
};
