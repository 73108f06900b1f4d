/// Bodies sorted into bins, so that an element asks those near it alone.
#ifndef SCREE_AVERAGE_BINS_H
#define SCREE_AVERAGE_BINS_H

#include "average/element.h"

typedef struct scree_average_bins {
    double origin[3], width; ///< m
    size_t number[3];
    size_t *begin;   ///< bins + 1
    uint32_t *grain; ///< places of the counted ones, images too, by bin
    double reach;    ///< m, largest radius
} scree_average_bins;

/// width: m; made larger where there would be many more bins than bodies. Errors: memory.
scree_status scree_average_bins_make(const scree_average_sample *sample, double width, scree_average_bins *bins,
                                     scree_error *error) SCREE_MUST_USE;
void scree_average_bins_destroy(scree_average_bins *bins);

/// Calls `visit` with the place of each grain that may reach into the element.
void scree_average_bins_visit(const scree_average_bins *bins, const scree_average_element *element,
                              void (*visit)(void *user, uint32_t grain), void *user);

#endif
