/// The velocity gradient that a boundary imposes through forces on the bodies of the Delaunay boundary.
#ifndef SCREE_MEASURE_IMPOSED_GRADIENT_H
#define SCREE_MEASURE_IMPOSED_GRADIENT_H

#include "state/state.h"

/// What a boundary imposes through forces on its own bodies (boundary/minimal.c, affine.c): the stress of the boundary
/// (measure/stress.c) has a share of these forces.
typedef struct scree_imposed_gradient {
    double target[9];      ///< 1/s, wanted velocity gradient (d v_row / d x_column), extension positive
    int64_t prescribed[9]; ///< of each component: scree_prescription
    double viscosity;      ///< Pa s, stress over error of the rate (INFINITY: no error is left)
    double rate[9];        ///< 1/s, velocity gradient of the boundary at n - 1/2
    double stress[9];      ///< Pa, uniform stress applied besides the pressure at n, tension positive
    double achieved;       ///< 1/s, integral of target : rate over time since the last sample
    double wanted;         ///< 1/s, the same of target : target
    scree_vector *force;   ///< count, N, on the bodies of the boundary at n (scree_boundary_row in measure/facets.h)
    size_t count, capacity;
    double (*surface)[6]; ///< N, one a body that deforms: moments over the radius of these forces at n; may be NULL
} scree_imposed_gradient;

/// How a component of the velocity gradient is prescribed.
typedef enum scree_prescription {
    SCREE_FREE,
    SCREE_FULL,      ///< itself
    SCREE_SYMMETRIC, ///< the mean of it and its mirror, which then says free: a strain rate, which leaves rotations
                     ///< free
} scree_prescription;

extern const scree_group scree_imposed_nodes;
extern const scree_field *const scree_imposed_surface; ///< asked for where bodies deform

static inline scree_imposed_gradient *scree_imposed(const scree_state *state)
{
    return state->own[SCREE_SLOT_imposed_gradient];
}

#endif
