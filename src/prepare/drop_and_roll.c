/// Drop-and-roll packing after Jodrey & Tory 1979, as Padbidri 2010 (2.5, 3.3) prepares his samples.
///
/// Bed: discs take random places on the floor, in the order of their radii drawn, until one has found none in ATTEMPTS
/// trials. Then each disc falls at a random abscissa of the box and rolls to a stable place: two discs on either side
/// of its centre, a disc and a side wall, or a gap of the bed that it fits into (deposit.c).
///
/// Levelling. The surface of such a deposit is rough by several diameters, more so the wider it is, and a plate would
/// rest on its highest hill. So more discs are dropped than are asked for, and those with the lowest centres are kept:
/// what is left is level to about a radius, and still stable, since a disc rests on discs with lower centres.
///
/// Width auto. The packing is loose along walls and floor, so its height is not known before it is made. The first
/// guess takes SOLID_FRACTION over the whole box; a packing made with it tells the height, and the second one has the
/// width that gives the aspect ratio if the solid fraction stays the same.
#include "prepare/deposit.h"
#include "prepare/methods.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ATTEMPTS = 100 };
#define SURPLUS_LAYERS 4.0
static const double SOLID_FRACTION = 0.79;

/// Abscissa in [radius, width - radius].
static double random_abscissa(uint64_t seed, scree_random_stream stream, uint64_t counter, double radius, double width)
{
    return radius + scree_random_uniform(seed, stream, counter) * (width - 2 * radius);
}

/// Places the bed; returns how many discs it has.
static scree_status lay_bed(scree_deposit *deposit, uint64_t seed, size_t count, size_t *placed, scree_error *error)
{
    uint64_t trials = 0;
    for (*placed = 0; *placed < count; ++*placed) {
        double radius = deposit->radius[*placed], x = 0;
        bool free = false;
        for (int attempt = 0; attempt < ATTEMPTS && !free; attempt++) {
            x = random_abscissa(seed, SCREE_RANDOM_BED, trials++, radius, deposit->width);
            free = scree_deposit_sees_floor(deposit, *placed, x);
        }
        if (!free) return SCREE_OK;
        scree_status status = scree_deposit_drop(deposit, *placed, x, error);
        if (status) return status;
    }
    return SCREE_OK;
}

/// Drops `count` discs into a box of `width`.
static scree_status drop_all(uint64_t seed, const double *radius, size_t count, double width, double *x, double *y,
                             double *height, scree_error *error)
{
    scree_deposit deposit;
    scree_status status = scree_deposit_create(&deposit, radius, count, width, x, y, height, error);
    if (status) return status;
    size_t bed = 0;
    status = lay_bed(&deposit, seed, count, &bed, error);
    for (size_t i = bed; i < count && !status; i++)
        status =
            scree_deposit_drop(&deposit, i, random_abscissa(seed, SCREE_RANDOM_POSITION, i, radius[i], width), error);
    scree_deposit_destroy(&deposit);
    return status;
}

/// Discs dropped beyond `count`: a layer as high as the surface is rough, which grows with the square root of the
/// width.
static size_t surplus_discs(const scree_model *model, double width)
{
    double across = width / (2 * model->mean_radius);
    return (size_t)ceil((SURPLUS_LAYERS + sqrt(across)) * across);
}

static int compare_heights(const void *a, const void *b)
{
    double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

/// Keeps the `count` lowest of `dropped` discs, in the order in which they were placed; of equally high ones the first.
static void keep_lowest(size_t dropped, const double *r, const double *x, const double *y, const double *height,
                        double *sorted, scree_packing *packing)
{
    memcpy(sorted, height, dropped * sizeof *sorted);
    qsort(sorted, dropped, sizeof *sorted, compare_heights);
    double last = packing->count > 0 ? sorted[packing->count - 1] : -1;
    size_t equal = 0, kept = 0;
    for (size_t k = 0; k < packing->count; k++) equal += sorted[k] == last;
    packing->box.height = 0;
    for (size_t i = 0; i < dropped; i++) {
        if (height[i] > last || (height[i] == last && equal-- == 0)) continue;
        packing->radius[kept] = r[i];
        packing->x[kept] = x[i];
        packing->y[kept] = y[i];
        packing->box.height = fmax(packing->box.height, y[i] + r[i]);
        kept++;
    }
}

/// Fills the packing and the height of its box for the width of its box.
static scree_status fill(const scree_model *model, scree_packing *packing, scree_error *error)
{
    size_t dropped = packing->count + surplus_discs(model, packing->box.width);
    double *room = NULL;
    scree_status status = scree_allocate(&room, 5 * dropped, sizeof *room, error);
    if (status) return status;
    double *r = room, *x = room + dropped, *y = room + 2 * dropped;
    double *height = room + 3 * dropped, *sorted = room + 4 * dropped;
    scree_draw_radii(model, r, dropped);
    status = drop_all((uint64_t)model->config->seed, r, dropped, packing->box.width, x, y, height, error);
    if (!status) keep_lowest(dropped, r, x, y, height, sorted, packing);
    scree_release(&room);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    double largest = 0, area = 0;
    for (size_t i = 0; i < packing->count; i++) {
        largest = fmax(largest, packing->radius[i]);
        area += M_PI * packing->radius[i] * packing->radius[i];
    }
    bool automatic = isnan(packing->box.width);
    if (automatic) packing->box.width = fmax(2 * largest, sqrt(area / (SOLID_FRACTION * stage->aspect_ratio)));
    scree_status status = fill(model, packing, error);
    if (status || !automatic) return status;
    double solid_fraction = area / (packing->box.width * packing->box.height);
    packing->box.width = fmax(2 * largest, sqrt(area / (solid_fraction * stage->aspect_ratio)));
    return fill(model, packing, error);
}

const scree_preparation scree_prepare_drop_and_roll = {
    .name = "drop_and_roll",
    .meaning = "discs fall one by one and roll to a stable place on those below, over a random bed",
    .place = place,
};
