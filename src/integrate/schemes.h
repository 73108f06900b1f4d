/// The descriptors, one per file of this folder.
#ifndef SCREE_INTEGRATE_SCHEMES_H
#define SCREE_INTEGRATE_SCHEMES_H

#include "integrate/integrate.h"

extern const scree_integrator scree_position_verlet;
extern const scree_integrator scree_velocity_verlet;
extern const scree_integrator scree_two_timescales;

#endif
