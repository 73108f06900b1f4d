/// A range of bodies that deform, several at once: stretch.h has the equations, stretch_batch.c is compiled for each
/// instruction set.
#ifndef SCREE_CONTACT_STRETCH_BATCH_H
#define SCREE_CONTACT_STRETCH_BATCH_H

#include "model/compliance.h"
#include "state/state.h"

typedef struct stretch_job {
    const scree_state *state;
    const scree_compliance *by; ///< of each material, times the force quantum; of discs over V / R^2, too
    bool alike;                 ///< all bodies are of the first material
    double theta;
    double *term; ///< J, one a body
    size_t begin, end;
} stretch_job;

typedef struct stretch_extremes {
    double reach;  ///< m
    double square; ///< m2, of a change; infinite where something is not a number
    double term;   ///< J, magnitude
} stretch_extremes;

typedef stretch_extremes stretch_kernel(const stretch_job *job);
stretch_kernel stretch_bodies_v0, stretch_bodies_v2, stretch_bodies_v3, stretch_bodies_v4;
stretch_kernel stretch_settle_v0, stretch_settle_v2, stretch_settle_v3, stretch_settle_v4;

#endif
