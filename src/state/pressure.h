/// The confining pressure: what it is now. Who carries it to the sample is the boundary's affair (boundary/pressure.c,
/// plates, membrane, periodic cell).
#ifndef SCREE_STATE_PRESSURE_H
#define SCREE_STATE_PRESSURE_H

#include "state/state.h"

/// State of the module `pressure`.
typedef struct scree_pressure {
    double now; ///< Pa, compression positive
    /// N, moments over the radius of the forces of the last step on the surfaces of bodies that deform, symmetric: xx,
    /// yy, xy in 2D; xx, yy, zz, yz, xz, xy. NULL until the pressure acts on such bodies.
    double (*surface)[6];
} scree_pressure;

/// Pa.
static inline double scree_pressure_now(const scree_state *state)
{
    return ((const scree_pressure *)state->own[SCREE_SLOT_pressure])->now;
}

static inline void scree_pressure_set(scree_state *state, double pressure)
{
    ((scree_pressure *)state->own[SCREE_SLOT_pressure])->now = pressure;
}

#endif
