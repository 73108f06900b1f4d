/// Dips, their intervals and tests.
#include "average/dip.h"

#include "average/table.h"
#include "base/random.h"

#include <math.h>

enum { EXACT_PILES = 12, FLIPS = 20000 };

/// Place of the largest one of the half profile.
static size_t find_most(const double *half, size_t count)
{
    size_t most = 0;
    for (size_t j = 1; j < count; j++)
        if (half[j] > half[most]) most = j;
    return most;
}

/// Sum over the piles that were drawn (NULL: each once), pile `without` left out.
static void add_up(const double *halves, size_t piles, size_t count, size_t resample, size_t without, double *sum)
{
    for (size_t j = 0; j < count; j++) sum[j] = 0;
    for (size_t i = 0; i < piles; i++) {
        const size_t which = resample == SIZE_MAX ? i : scree_average_drawn(resample, i, piles);
        if (i == without) continue;
        for (size_t j = 0; j < count; j++) sum[j] += halves[which * count + j];
    }
}

static double dip_of(const double *sum, size_t count)
{
    const double most = sum[find_most(sum, count)];
    return most > 0 ? 1 - sum[0] / most : NAN;
}

/// Share of the changes of sign whose sum is not smaller than what was found.
static double test(const double *difference, size_t piles)
{
    const size_t flips = piles <= EXACT_PILES ? (size_t)1 << piles : FLIPS;
    double found = 0, scale = 0, reached = 0;
    for (size_t i = 0; i < piles; i++) {
        found += difference[i];
        scale += fabs(difference[i]);
    }
    for (size_t f = 0; f < flips; f++) {
        double sum = 0;
        for (size_t i = 0; i < piles; i++) {
            const bool minus = piles <= EXACT_PILES
                                   ? f >> i & 1
                                   : scree_random_uniform(1, SCREE_RANDOM_BOOTSTRAP, f * piles + i) < 0.5;
            sum += minus ? -difference[i] : difference[i];
        }
        reached += sum >= found - 1e-12 * scale;
    }
    return reached / (double)flips;
}

/// What the piles say where each is looked at in the place that the others name.
static void check(const double *halves, size_t piles, size_t count, double *sum, double *difference,
                  scree_average_dip *dip)
{
    double centre = 0, most = 0;
    for (size_t i = 0; i < piles; i++) {
        add_up(halves, piles, count, SIZE_MAX, i, sum);
        const double *half = halves + i * count, at = half[find_most(sum, count)];
        difference[i] = at - half[0];
        centre += half[0];
        most += at;
    }
    dip->checked = most > 0 ? 1 - centre / most : NAN;
    dip->p = test(difference, piles);
}

/// `checked` of resamples of whole piles, in which all copies of a pile are left out together.
static void resample_checked(const double *halves, size_t piles, size_t count, double *sum, double *draw,
                             scree_average_dip *dip)
{
    for (size_t b = 0; b < SCREE_AVERAGE_BOOTSTRAP; b++) {
        double centre = 0, most = 0;
        for (size_t i = 0; i < piles; i++) {
            const double *half = halves + scree_average_drawn(b, i, piles) * count;
            for (size_t j = 0; j < count; j++) sum[j] = 0;
            for (size_t k = 0; k < piles; k++) {
                const double *other = halves + scree_average_drawn(b, k, piles) * count;
                for (size_t j = 0; j < count && other != half; j++) sum[j] += other[j];
            }
            centre += half[0];
            most += half[find_most(sum, count)];
        }
        draw[b] = most > 0 ? 1 - centre / most : NAN;
    }
    dip->checked_low = scree_average_quantile(draw, SCREE_AVERAGE_BOOTSTRAP, scree_average_tail(piles));
    dip->checked_high = scree_average_quantile(draw, SCREE_AVERAGE_BOOTSTRAP, 1 - scree_average_tail(piles));
}

static void resample(const double *halves, size_t piles, size_t count, double *sum, double *draw,
                     scree_average_dip *dip)
{
    for (size_t b = 0; b < SCREE_AVERAGE_BOOTSTRAP; b++) {
        add_up(halves, piles, count, b, SIZE_MAX, sum);
        draw[b] = dip_of(sum, count);
    }
    dip->low = scree_average_quantile(draw, SCREE_AVERAGE_BOOTSTRAP, scree_average_tail(piles));
    dip->high = scree_average_quantile(draw, SCREE_AVERAGE_BOOTSTRAP, 1 - scree_average_tail(piles));
}

/// The mean of each pile and its mirror image, from the axis outwards; -INFINITY, which is never the largest, where
/// some pile has none. Returns how many piles have any number.
static size_t fold(const double *profile, size_t piles, size_t points, double *halves)
{
    const size_t middle = points / 2, count = middle + 1;
    size_t kept = 0;
    for (size_t i = 0; i < piles; i++) {
        bool any = false;
        for (size_t j = 0; j < count; j++) {
            const double left = profile[i * points + middle - j], right = profile[i * points + middle + j];
            halves[kept * count + j] = 0.5 * (left + right);
            any = any || isfinite(left + right);
        }
        kept += any;
    }
    for (size_t j = 0; j < count; j++) {
        bool all = true;
        for (size_t i = 0; i < kept; i++) all = all && isfinite(halves[i * count + j]);
        for (size_t i = 0; i < kept && !all; i++) halves[i * count + j] = -INFINITY;
    }
    return kept;
}

scree_status scree_average_dip_find(const double *profile, size_t piles, size_t points, scree_average_dip *dip,
                                    scree_error *error)
{
    const size_t count = points / 2 + 1;
    double *halves = NULL, *sum = NULL, *difference = NULL, *draw = NULL;
    bool known = false;
    *dip = (scree_average_dip){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    scree_status status = scree_allocate(&halves, piles * count, sizeof *halves, error);
    if (!status) status = scree_allocate(&sum, count, sizeof *sum, error);
    if (!status) status = scree_allocate(&difference, piles, sizeof *difference, error);
    if (!status) status = scree_allocate(&draw, SCREE_AVERAGE_BOOTSTRAP, sizeof *draw, error);
    if (!status) {
        piles = fold(profile, piles, points, halves);
        known = piles > 0 && isfinite(halves[0]);
    }
    if (known) {
        add_up(halves, piles, count, SIZE_MAX, SIZE_MAX, sum);
        const size_t most = find_most(sum, count);
        dip->dip = dip_of(sum, count);
        dip->place = count > 1 ? (double)most / (double)(count - 1) : 0;
        dip->centre = sum[0] / (double)piles;
        dip->most = sum[most] / (double)piles;
        if (piles > 1) {
            check(halves, piles, count, sum, difference, dip);
            resample(halves, piles, count, sum, draw, dip);
            resample_checked(halves, piles, count, sum, draw, dip);
        }
    }
    scree_release(&halves);
    scree_release(&sum);
    scree_release(&difference);
    scree_release(&draw);
    return status;
}
