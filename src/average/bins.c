/// Bins by counting.
#include "average/bins.h"

#include <math.h>

static size_t bin_along(const scree_average_bins *bins, int axis, double place)
{
    const double at = floor((place - bins->origin[axis]) / bins->width);
    const size_t last = bins->number[axis] - 1;
    return at <= 0 ? 0 : at >= (double)last ? last : (size_t)at;
}

static size_t bin_of(const scree_average_bins *bins, const scree_vector place)
{
    size_t bin = 0;
    for (int k = 0; k < 3; k++) bin = bin * bins->number[k] + bin_along(bins, k, place[k]);
    return bin;
}

/// Box of all counted ones; the largest radius.
static void find_box(const scree_average_sample *sample, scree_average_bins *bins, double size[3])
{
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) bins->origin[k] = INFINITY;
    for (size_t p = 0; p < sample->count; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!grain->counted) continue;
        bins->reach = fmax(bins->reach, grain->radius);
        for (int k = 0; k < 3; k++) {
            bins->origin[k] = fmin(bins->origin[k], grain->position[k]);
            high[k] = fmax(high[k], grain->position[k]);
        }
    }
    for (int k = 0; k < 3; k++) size[k] = high[k] - bins->origin[k];
}

scree_status scree_average_bins_make(const scree_average_sample *sample, double width, scree_average_bins *bins,
                                     scree_error *error)
{
    double size[3], total;
    *bins = (scree_average_bins){.width = width};
    find_box(sample, bins, size);
    do {
        total = 1;
        for (int k = 0; k < 3; k++) {
            bins->number[k] = (size_t)fmin(1e9, floor(size[k] / bins->width)) + 1;
            total *= (double)bins->number[k];
        }
        if (total > 8 * (double)sample->count + 64) bins->width *= 1.5;
    } while (total > 8 * (double)sample->count + 64);
    const size_t bins_count = (size_t)total;
    scree_status status = scree_allocate(&bins->begin, bins_count + 2, sizeof *bins->begin, error);
    if (!status) status = scree_allocate(&bins->grain, sample->count, sizeof *bins->grain, error);
    if (status) {
        scree_average_bins_destroy(bins);
        return status;
    }
    // Counted two places ahead, summed, and moved on by one as each is filled.
    for (size_t p = 0; p < sample->count; p++)
        if (sample->grain[p].counted) bins->begin[bin_of(bins, sample->grain[p].position) + 2]++;
    for (size_t b = 2; b <= bins_count + 1; b++) bins->begin[b] += bins->begin[b - 1];
    for (size_t p = 0; p < sample->count; p++)
        if (sample->grain[p].counted)
            bins->grain[bins->begin[bin_of(bins, sample->grain[p].position) + 1]++] = (uint32_t)p;
    return SCREE_OK;
}

void scree_average_bins_destroy(scree_average_bins *bins)
{
    scree_release(&bins->begin);
    scree_release(&bins->grain);
}

void scree_average_bins_visit(const scree_average_bins *bins, const scree_average_element *element,
                              void (*visit)(void *user, uint32_t grain), void *user)
{
    size_t from[3], to[3];
    for (int k = 0; k < 3; k++) {
        from[k] = bin_along(bins, k, element->low[k] - bins->reach);
        to[k] = bin_along(bins, k, element->high[k] + bins->reach);
    }
    for (size_t i = from[0]; i <= to[0]; i++)
        for (size_t j = from[1]; j <= to[1]; j++) {
            // Bins along the last axis lie side by side.
            const size_t row = (i * bins->number[1] + j) * bins->number[2];
            for (size_t at = bins->begin[row + from[2]]; at < bins->begin[row + to[2] + 1]; at++)
                visit(user, bins->grain[at]);
        }
}
