/// Minimal kinematic conditions.
#ifndef SCREE_BOUNDARY_MINIMAL_H
#define SCREE_BOUNDARY_MINIMAL_H

#include "model/model.h"

typedef struct scree_minimal_config {
    double penalty; ///< Pa s, stress over error of the rate; auto
} scree_minimal_config;

/// The viscosity [Pa s] of `boundary.penalty: auto`: `pressure` [Pa] over a hundredth of the largest component of
/// `target` [1/s]; INFINITY, that is exact rates, where either is zero.
double scree_minimal_viscosity(double pressure, const double target[9]);

/// That of the case [Pa s]: what it gives, or the automatic one under this pressure [Pa] at this largest rate [1/s].
double scree_minimal_viscosity_at(const scree_model *model, double pressure, double rate);

#endif
