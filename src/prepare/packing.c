/// A packing in the making, its box, and the round sample cut out of one.
///
/// Round samples. A larger packing is made in a square or cubic box, and those bodies are kept that reach least far
/// from its centre, |x - c| + R: a circle (ball) just holds them, and the number is exact. The larger packing is wider
/// than that circle by MARGIN mean radii all around, so that nothing of the order that plane walls impose is left (it
/// dies away within about five diameters in packings of equal bodies, sooner with many sizes).
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MARGIN = 6;

scree_status scree_packing_create(scree_packing *packing, int dimension, size_t count, scree_error *error)
{
    *packing = (scree_packing){.dimension = dimension, .count = count, .aspect_ratio = 1};
    scree_status status = scree_allocate(&packing->radius, count, sizeof(double), error);
    if (!status) status = scree_allocate(&packing->species, count, sizeof *packing->species, error);
    if (!status) status = scree_allocate(&packing->number, count, sizeof *packing->number, error);
    for (int c = 0; c < dimension && !status; c++)
        status = scree_allocate(&packing->place[c], count, sizeof(double), error);
    if (status) scree_packing_destroy(packing);
    return status;
}

void scree_packing_destroy(scree_packing *packing)
{
    scree_release(&packing->radius);
    scree_release(&packing->species);
    scree_release(&packing->number);
    for (int c = 0; c < 3; c++) scree_release(&packing->place[c]);
    *packing = (scree_packing){.dimension = packing->dimension};
}

void scree_packing_draw(const scree_model *model, scree_packing *packing)
{
    for (size_t i = 0; i < packing->count; i++) {
        packing->species[i] = (uint8_t)scree_model_drawn_species(model, i);
        packing->radius[i] = scree_model_drawn_bound(model, i);
        packing->number[i] = (uint32_t)i;
    }
}

double scree_packing_solid(const scree_packing *packing)
{
    double in_3d = 0;
    for (size_t i = 0; i < packing->count; i++) {
        double r = packing->radius[i];
        in_3d += packing->dimension == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    }
    return in_3d;
}

double scree_packing_largest(const scree_packing *packing)
{
    double largest = 0;
    for (size_t i = 0; i < packing->count; i++) largest = fmax(largest, packing->radius[i]);
    return largest;
}

void scree_packing_fit_box(scree_packing *packing, double in_3d, double solid_fraction, double least)
{
    scree_box *box = &packing->box;
    double room = in_3d / solid_fraction, face = room / packing->aspect_ratio;
    if (packing->dimension == 2) {
        if (isnan(box->width)) box->width = fmax(least, sqrt(in_3d / (solid_fraction * packing->aspect_ratio)));
        box->height = in_3d / (solid_fraction * box->width);
        return;
    }
    if (isnan(box->width)) box->width = fmax(least, isnan(box->depth) ? cbrt(face) : sqrt(face / box->depth));
    if (isnan(box->depth)) box->depth = box->width;
    box->height = room / (box->width * box->depth);
}

/// Number of bodies of a square (cubic) packing that is wide enough for a round one of `count`.
static size_t square_count(const scree_packing *packing, double margin)
{
    // A round sample at a solid fraction of 0.5 or more is at most sqrt(2 N), cbrt(2 N) mean radii in radius, and at
    // least three quarters of that, which the margin is compared with.
    bool in_3d = packing->dimension == 3;
    double count = (double)packing->count, radius = 0.75 * (in_3d ? cbrt(2 * count) : sqrt(2 * count));
    double wider = 1 + margin / radius;
    return (size_t)ceil(count * (in_3d ? 6 / M_PI * wider * wider * wider : 4 / M_PI * wider * wider));
}

/// A body of the larger packing and how far it reaches from the centre.
typedef struct candidate {
    double reach;
    size_t index;
} candidate;

static int by_reach(const void *a, const void *b)
{
    const candidate *one = a, *other = b;
    if (one->reach != other->reach) return one->reach > other->reach ? 1 : -1;
    return one->index > other->index ? 1 : one->index < other->index ? -1 : 0;
}

static int by_index(const void *a, const void *b)
{
    const candidate *one = a, *other = b;
    return one->index > other->index ? 1 : one->index < other->index ? -1 : 0;
}

/// Copies the middle of `larger` into `packing`. False if its circle or ball does not lie inside of the box.
static bool keep_middle(const scree_packing *larger, candidate *of, scree_packing *packing)
{
    const scree_box *box = &larger->box;
    const bool in_3d = packing->dimension == 3;
    const double centre[3] = {box->width / 2, (in_3d ? box->depth : box->height) / 2, box->height / 2};
    for (size_t i = 0; i < larger->count; i++) {
        double square = 0;
        for (int c = 0; c < packing->dimension; c++) {
            double away = larger->place[c][i] - centre[c];
            square += away * away;
        }
        of[i] = (candidate){sqrt(square) + larger->radius[i], i};
    }
    qsort(of, larger->count, sizeof *of, by_reach);
    double reach = packing->count > 0 ? of[packing->count - 1].reach : 0;
    if (reach > fmin(fmin(centre[0], centre[1]), in_3d ? centre[2] : INFINITY)) return false;
    // The order of placement stays.
    qsort(of, packing->count, sizeof *of, by_index);
    for (size_t i = 0; i < packing->count; i++) {
        scree_packing_take(packing, i, larger, of[i].index);
        for (int c = 0; c < packing->dimension; c++)
            packing->place[c][i] = larger->place[c][of[i].index] - centre[c] + reach;
    }
    packing->box = (scree_box){.width = 2 * reach, .depth = 2 * reach, .height = 2 * reach};
    return true;
}

scree_status scree_packing_cut_round(const scree_model *model, const scree_config_stage *stage,
                                     const scree_preparation *method, scree_packing *packing, scree_error *error)
{
    scree_status status = SCREE_OK;
    bool cut = false;
    for (double margin = MARGIN; !cut && !status; margin *= 1.5) {
        scree_packing larger;
        candidate *of = NULL;
        size_t count = square_count(packing, margin);
        status = scree_packing_create(&larger, packing->dimension, count, error);
        if (!status) status = scree_allocate(&of, count, sizeof *of, error);
        if (!status) {
            larger.box = (scree_box){.width = NAN, .depth = NAN};
            scree_packing_draw(model, &larger);
            status = method->place(model, stage, &larger, error);
        }
        if (!status) cut = keep_middle(&larger, of, packing);
        scree_release(&of);
        scree_packing_destroy(&larger);
    }
    return status;
}
