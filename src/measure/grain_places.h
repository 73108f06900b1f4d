/// Places of all grains, in the order of their ids: what the boundary of a sample is found in.
#ifndef SCREE_MEASURE_GRAIN_PLACES_H
#define SCREE_MEASURE_GRAIN_PLACES_H

#include "state/state.h"

typedef struct scree_grain_place {
    scree_vector position; ///< m
    double radius;         ///< m, bounding
    uint64_t id;
} scree_grain_place;

/// Those of all processes where the state is a part: 40 bytes a grain of the whole sample in each, for the moment; all
/// of them call it. *grain is to be released. Errors: memory.
scree_status scree_grain_places(const scree_state *state, scree_grain_place **grain, size_t *count,
                                scree_error *error) SCREE_MUST_USE;

#endif
