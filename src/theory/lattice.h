/// Regular lattices of equal discs and spheres that touch, every contact with the springs k_n, k_t [N/m], particles
/// rigid or deformed by their mean stress (M, chapters 3 and 4): limits of the iteration of forces and elastic moduli.
#ifndef SCREE_THEORY_LATTICE_H
#define SCREE_THEORY_LATTICE_H

#include <stdbool.h>

typedef enum scree_lattice {
    SCREE_LATTICE_SQUARE,
    SCREE_LATTICE_HEXAGONAL,
    SCREE_LATTICE_SIMPLE_CUBIC,
    SCREE_LATTICE_BODY_CENTRED,
    SCREE_LATTICE_FACE_CENTRED,
    SCREE_LATTICES,
    SCREE_LATTICE_ROW = SCREE_LATTICES, ///< of discs: no solid, so without moduli; lattice_waves.h, scree_row_*
} scree_lattice;

/// Strains in which a lattice and an isotropic particle both answer with a multiple of the strain. In 2D `diagonal` is
/// (1, -1), in 3D also (1, 1, -2); `shear` is one off the diagonal, in the axes of the cubic (square) cell.
typedef enum scree_lattice_strain {
    SCREE_LATTICE_ALL_ROUND,
    SCREE_LATTICE_DIAGONAL,
    SCREE_LATTICE_SHEAR,
    SCREE_LATTICE_STRAINS
} scree_lattice_strain;

/// Contacts and particles. Particles are rigid where shear and trace are zero.
typedef struct scree_lattice_material {
    double radius;       ///< m
    double length;       ///< m, of discs
    double density;      ///< kg/m3, of particles; for what moves
    double normal;       ///< N/m, k_n
    double tangential;   ///< N/m, k_t
    double shear, trace; ///< 1/Pa, compliance of a particle (model/compliance.h)
    bool corrected;      ///< the tangential displacement feels the strain of the particles, too
} scree_lattice_material;

const char *scree_lattice_name(scree_lattice lattice);
int scree_lattice_dimension(scree_lattice lattice);

/// Spectral radius of the iteration of normal forces in the unbounded lattice, proportional to k_n: M 3.41, 3.77, in
/// space by the same argument. The largest k_n is k_n over it.
double scree_lattice_radius(scree_lattice lattice, const scree_lattice_material *material);

/// The same of a straight row of discs or spheres (M 3.27).
double scree_row_radius(int dimension, const scree_lattice_material *material);

/// Volume of a particle and of its cell [m3].
double scree_particle_volume(int dimension, const scree_lattice_material *material);
double scree_lattice_cell(scree_lattice lattice, const scree_lattice_material *material);

/// Force of a compressed row over the way of the centres [N/m], k_n k_p / (2 k_n + k_p) (M 3.27 and Table 3.1), and
/// strain of its particles across it over the strain along it, with the sign changed.
double scree_row_stiffness(int dimension, const scree_lattice_material *material);
double scree_row_poisson(int dimension, const scree_lattice_material *material);

/// Stress over strain [Pa] in one of these strains: d K, 2 G, 2 G' with the bulk modulus K of d dimensions (in 2D that
/// of areas).
double scree_lattice_modulus(scree_lattice lattice, scree_lattice_strain strain,
                             const scree_lattice_material *material);

/// Young's modulus and Poisson's ratio along an axis of the cubic (square) cell, stress across it zero.
void scree_lattice_axial(scree_lattice lattice, const scree_lattice_material *material, double *young, double *poisson);

/// K [Pa] of the lattice, and G of the isotropic tensor that is nearest to its own (the mean over all directions).
void scree_lattice_isotropic(scree_lattice lattice, const scree_lattice_material *material, double *bulk,
                             double *shear);

/// Isotropic moduli of a packing of `contacts` contacts between particles of mean square radius [m2] in a volume [m3],
/// if all follow the mean strain without turning (Voigt): M 4.15-4.18 in the plane, in space by the same average.
/// In the plane E and nu are those of uniaxial stress within it, and K = E / (2 (1 - nu)); M 4.11 is that of space.
typedef struct scree_voigt_moduli {
    double young, poisson, bulk, shear; ///< Pa, 1, Pa, Pa
} scree_voigt_moduli;
scree_voigt_moduli scree_voigt_estimate(int dimension, double contacts, double square_radius, double volume,
                                        double normal, double tangential);

/// Young's modulus and Poisson's ratio of K and G in the plane or in space.
void scree_moduli_of_bulk_and_shear(int dimension, double bulk, double shear, double *young, double *poisson);

#endif
