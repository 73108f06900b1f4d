/// What a case says of a forced rotation.
#ifndef SCREE_RUN_STAGE_ROTATE_CONFIG_H
#define SCREE_RUN_STAGE_ROTATE_CONFIG_H

#include "measure/rotation.h"

typedef enum scree_axis { SCREE_AXIS_X, SCREE_AXIS_Y, SCREE_AXIS_Z } scree_axis;

typedef struct scree_rotate_config {
    double spin;      ///< rad/s, that the particle is brought to
    int axis;         ///< scree_axis, about which it turns
    double particle;  ///< id of the particle; auto: of those near the centre the one that bears most
    double rest_time; ///< s, before, in which it is held still and the spins that there are anyway are measured
    double ramp_time; ///< s, in which the spin is reached; auto
    double hold_time; ///< s, at that spin, in which the others are measured
    double cutoff;    ///< mean diameters, of the force network around it
} scree_rotate_config;

/// State of the module `rotate_particle`.
typedef struct scree_rotation {
    scree_rotation_background background; ///< spins at rest over the prescribed one; NAN: no rest
    double turn;                          ///< rad, that the particle turns by in the whole stage
} scree_rotation;

static inline scree_rotation *scree_rotation_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_rotate_particle];
}

#endif
