/// Plane waves in lattices of equal discs and spheres that touch, rigid or deformed by their mean stress: frequencies,
/// and the critical step as that of the fastest wave. lattice_waves.c has the method.
#ifndef SCREE_THEORY_LATTICE_WAVES_H
#define SCREE_THEORY_LATTICE_WAVES_H

#include "theory/lattice.h"

/// Most waves of one wave vector: motions of a particle.
enum { SCREE_LATTICE_BRANCHES = 6 };

/// How the strain of particles answers (specimen/stability.h): 0 not at all, -1 at once (implicit; what a wave of
/// deformable particles is), 1 and theta / (2 - theta) explicit and relaxed, for a wave that changes its sign in every
/// step.
#define SCREE_STRAIN_NONE     0.0
#define SCREE_STRAIN_AT_ONCE  (-1.0)
#define SCREE_STRAIN_EXPLICIT 1.0

/// Circular frequencies [rad/s], in ascending order, of the waves with the wave vector [rad/m], in the axes of the
/// cubic (square) cell; of a hexagonal lattice x is along a row. Returns how many: 3 in 2D, 6 in 3D. NAN: it grows
/// (which the published form with k_t > 0 allows). All are NAN where no step of the scheme is stable.
int scree_lattice_frequencies(scree_lattice lattice, const scree_lattice_material *material, const double wave[3],
                              double share, double frequency[SCREE_LATTICE_BRANCHES]);

/// Circular frequency [rad/s] of the wave whose displacements lie most along `direction`, a unit vector in the same
/// axes: of all waves of this wave vector the one that has the largest part of such a motion. NAN: it grows.
double scree_lattice_frequency_along(scree_lattice lattice, const scree_lattice_material *material,
                                     const double wave[3], double share, const double direction[3]);

/// Critical step of leapfrog schemes [s], 2 over the largest frequency of all waves, which is looked for in the whole
/// zone of wave vectors; 0 where no step is stable. wave: where it is, or NULL.
double scree_lattice_critical_step(scree_lattice lattice, const scree_lattice_material *material, double share,
                                   double wave[3]);

/// The usual path through the zone of wave vectors, from corner to corner.
enum { SCREE_LATTICE_CORNERS = 6 };
typedef struct scree_lattice_corner {
    const char *name; ///< NULL ends the path; "0" is the wave of infinite length
    double wave[3];   ///< 1 / (2 R)
} scree_lattice_corner;
const scree_lattice_corner *scree_lattice_path(scree_lattice lattice);

/// Directions of the contacts of a particle, one of each opposite two; returns how many.
int scree_lattice_contacts(scree_lattice lattice, const double (**direction)[3]);

#endif
