/// Minimal kinematic conditions; the descriptor is scree_boundary_minimal.
#ifndef SCREE_BOUNDARY_MINIMAL_H
#define SCREE_BOUNDARY_MINIMAL_H

/// The viscosity [Pa s] of `boundary.penalty: auto`: `pressure` [Pa] over a hundredth of the largest component of
/// `target` [1/s]; INFINITY, that is exact rates, where either is zero.
double scree_minimal_viscosity(double pressure, const double target[9]);

#endif
