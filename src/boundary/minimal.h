/// Minimal kinematic conditions.
#ifndef SCREE_BOUNDARY_MINIMAL_H
#define SCREE_BOUNDARY_MINIMAL_H

#include "case/config.h"

typedef struct scree_minimal_config {
    double penalty; ///< Pa s, stress over error of the rate; auto
} scree_minimal_config;

/// What the case says of it; NAN: auto.
double scree_minimal_penalty(const scree_config *config);

/// The viscosity [Pa s] of `boundary.penalty: auto`: `pressure` [Pa] over a hundredth of the largest component of
/// `target` [1/s]; INFINITY, that is exact rates, where either is zero.
double scree_minimal_viscosity(double pressure, const double target[9]);

#endif
