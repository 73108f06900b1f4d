/// The specimen as it stands, as a linear operator: what explicit steps it bears, and how it deforms.
#ifndef SCREE_SPECIMEN_H
#define SCREE_SPECIMEN_H

#include <scree/simulation.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Reads the newest state in the folder of a run (the newest checkpoint, else a snapshot), without changing anything
/// there. Free both; the case outlives the simulation. Errors: SCREE_ERROR_INPUT, SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_simulation_open_run(const char *directory, scree_case **c, scree_simulation **out,
                                                 scree_error *error);

/// Runs until the stage of this name has begun; NULL: the first one that takes steps. Errors: SCREE_ERROR_INPUT for a
/// name that no stage has (`accepted` holds the nearest), or one that the simulation is past; those of
/// scree_simulation_advance.
SCREE_API scree_status scree_simulation_begin_stage(scree_simulation *s, const char *stage, scree_error *error);

/// Particles as if they were elastic (Madan 2019, DDEM): discs in plane strain. NULL in place of it: as the case says.
typedef struct scree_particle_elasticity {
    double young_modulus; ///< Pa
    double poisson_ratio;
} scree_particle_elasticity;

/// Steps and stiffnesses that explicit schemes bear, from eigenvalues of the specimen as it stands
/// (docs/theory/ddem.md). Numbers that do not exist are NAN; steps are INFINITY without contacts, and 0 where none is
/// stable.
typedef struct scree_stability {
    size_t bodies, contacts;
    double step;                   ///< s, of the case
    double critical_step;          ///< s, rigid particles, dashpots counted
    double critical_step_undamped; ///< s, the same without dashpots
    double step_of_bodies;         ///< s, from single bodies (M 2.18)
    double step_of_extremes;       ///< s, sqrt(m_min / k_max) (M 2.19 with alpha = 1)
    double normal_stiffness;       ///< N/m, mean over the contacts
    bool has_potential;     ///< elastic particles: the strain acts on slips as slips act on the strain (or there is no
                            ///< k_t); if not, vibrations may grow at any step where nothing damps them
    double spectral_radius; ///< 1, of the iteration of forces
    double stiffness_ratio; ///< mean k_n over E_p [m]
    double largest_ratio;   ///< the same at the limit of the explicit scheme
    double ratio_at_step;   ///< the same at the step of the case, which is less
    double row_ratio;       ///< limit of an unbounded row [m] (M 3.27)
    double square_ratio;    ///< of a square lattice (M 3.43); in 3D simple cubic
    double hexagonal_ratio; ///< of a hexagonal one (M 3.78); in 3D face-centred cubic
    double explicit_step, relaxed_step, implicit_step; ///< s, critical steps with deformable particles
    double relaxation;                                 ///< theta that `relaxed_step` stands for
} scree_stability;

/// Errors: SCREE_ERROR_INPUT without bodies or for an elasticity that is none; SCREE_ERROR_GUARD when an eigenvalue is
/// not found; memory.
SCREE_API scree_status scree_simulation_stability(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                                  scree_stability *out, scree_error *error);

/// Draws the fastest mode, of rigid particles or with explicit strains where a step bears these: PATH.svg and PATH.png,
/// movements as arrows, turning as colours; of spheres a cut through the middle. Errors: as above; SCREE_ERROR_INPUT
/// without contacts; SCREE_ERROR_IO.
SCREE_API scree_status scree_simulation_draw_mode(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                                  const char *path, scree_error *error);

/// What is known of these limits before a run.
typedef enum scree_limits_known {
    SCREE_LIMITS_NONE,  ///< nothing: no bonds, rigid particles; the estimate of the case holds
    SCREE_LIMITS_LATER, ///< the specimen comes from stages that take steps: only `*_ratio` of lattices and the present
                        ///< stiffness_ratio of mean particles
    SCREE_LIMITS_EXACT, ///< it stands before the first step
} scree_limits_known;

/// Limits of a case as far as they are known before it runs: its sample is prepared, and no step is taken. Errors:
/// those of scree_simulation_create, of the preparation, and as above.
SCREE_API scree_status scree_case_limits(const scree_case *c, scree_limits_known *known, scree_stability *out,
                                         scree_error *error);

/// Isotropic moduli [Pa, 1, Pa, Pa]. In the plane those of the plane: `bulk` of areas, `young` and `poisson` of a
/// stress along one of its axes, K = E / (2 (1 - nu)).
typedef struct scree_isotropic_moduli {
    double young, poisson, bulk, shear;
} scree_isotropic_moduli;

/// How a specimen deforms as it stands, periodic or a box strained by its outermost particles, from static solutions.
/// Compression and extension alike: contacts keep what they are.
typedef struct scree_moduli {
    int dimension;
    size_t bodies, contacts, iterations;
    double stiffness[36]; ///< Pa, C_ijkl by rows, 3 x 3 of xx, yy, xy in 2D; 6 x 6 of xx, yy, zz, yz, xz, xy in 3D
    scree_isotropic_moduli isotropic; ///< of the nearest isotropic tensor
    scree_isotropic_moduli voigt;     ///< the same if rigid particles followed the mean strain without turning
    scree_isotropic_moduli estimate;  ///< the same from number of contacts and mean square radius (M 4.15-4.18)
    double anisotropy;                ///< 1, distance from the nearest isotropic tensor over the size of the tensor
    double asymmetry;                 ///< 1, skew part over the size of the tensor
    double fabric[9];                 ///< mean of n n over the contacts, 3 x 3
    double uniaxial_young[3];   ///< Pa, between smooth plates across each axis, sides free; NAN: periodic somewhere
    double uniaxial_poisson[9]; ///< 1, 3 x 3: across axis j under a stress along i; NAN of i itself
    double pressed_bulk; ///< Pa, of discs that of areas, between smooth plates all around; NAN: periodic somewhere
} scree_moduli;

/// Errors: SCREE_ERROR_INPUT without bodies, for an elasticity that is none, or a sample that is neither periodic in
/// all directions nor a box; SCREE_ERROR_GUARD when no solution is found; memory.
SCREE_API scree_status scree_simulation_moduli(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                               scree_moduli *out, scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
