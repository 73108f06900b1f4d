/// Drop-and-roll packing after Jodrey & Tory 1979, as Padbidri 2010 (2.5, 3.3) prepares his samples.
///
/// Bed: discs take random places on the floor, in the order of their radii drawn, until one has found none in ATTEMPTS
/// trials. Then each disc falls at a random abscissa of the box and rolls to a stable place: two discs on either side
/// of its centre, a disc and a side wall, or a gap of the bed that it fits into (deposit.c).
///
/// Width auto. The packing is loose along walls, floor and surface, so its height is not known before it is made. The
/// first guess takes SOLID_FRACTION over the whole box; a packing made with it tells the height, and the second one has
/// the width that gives the aspect ratio if the solid fraction stays the same. The error left is that of the rough
/// surface.
#include "prepare/deposit.h"
#include "prepare/methods.h"

#include "base/random.h"

#include <math.h>

enum { ATTEMPTS = 100 };
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

/// Fills x, y and the box's height for its width.
static scree_status fill(uint64_t seed, const double *radius, size_t count, double *x, double *y, scree_box *box,
                         scree_error *error)
{
    scree_deposit deposit;
    scree_status status = scree_deposit_create(&deposit, radius, count, box->width, x, y, error);
    if (status) return status;
    size_t bed = 0;
    status = lay_bed(&deposit, seed, count, &bed, error);
    for (size_t i = bed; i < count && !status; i++)
        status = scree_deposit_drop(&deposit, i, random_abscissa(seed, SCREE_RANDOM_POSITION, i, radius[i], box->width),
                                    error);
    scree_deposit_destroy(&deposit);
    box->height = 0;
    for (size_t i = 0; i < count && !status; i++) box->height = fmax(box->height, y[i] + radius[i]);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, const double *radius, size_t count,
                          double *x, double *y, scree_box *box, scree_error *error)
{
    uint64_t seed = (uint64_t)model->config->seed;
    double largest = 0, area = 0;
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, radius[i]);
        area += M_PI * radius[i] * radius[i];
    }
    bool automatic = isnan(box->width);
    if (automatic) box->width = fmax(2 * largest, sqrt(area / (SOLID_FRACTION * stage->aspect_ratio)));
    scree_status status = fill(seed, radius, count, x, y, box, error);
    if (status || !automatic) return status;
    double solid_fraction = area / (box->width * box->height);
    box->width = fmax(2 * largest, sqrt(area / (solid_fraction * stage->aspect_ratio)));
    return fill(seed, radius, count, x, y, box, error);
}

const scree_preparation scree_prepare_drop_and_roll = {
    .name = "drop_and_roll",
    .meaning = "discs fall one by one and roll to a stable place on those below, over a random bed",
    .place = place,
};
