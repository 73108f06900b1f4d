/// Closed forms: what continuum and lattice theory say of a material, without a run. Each theory has a function that
/// solves it; what it finds is a list of values and curves, which can be looked at, written and drawn alike.
#ifndef SCREE_THEORY_H
#define SCREE_THEORY_H

#include <scree/api.h>
#include <scree/error.h>

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct scree_theory scree_theory;

typedef struct scree_theory_value {
    const char *name;
    double value;
    const char *unit; ///< SI
    const char *meaning;
} scree_theory_value;

/// Equal discs or spheres on a lattice, each contact with springs k_n and k_t, rigid or deformed by their mean stress.
typedef struct scree_theory_lattice_of {
    const char *kind;        ///< row, square, hexagonal, simple_cubic, body_centred, face_centred
    double radius;           ///< m
    double length;           ///< m, of discs
    double density;          ///< kg/m3, of particles
    double normal_stiffness; ///< N/m
    double stiffness_ratio;  ///< 1, k_t / k_n
    double young_modulus;    ///< Pa, of particles; INFINITY: rigid
    double poisson_ratio;    ///< 1, of particles
    bool plane_stress;       ///< discs are free to change their thickness
    bool corrected;          ///< strains stretch tangential springs, too
} scree_theory_lattice_of;

/// Limits, moduli, critical steps and waves of a lattice (docs/theory/ddem-3d.md). Free *theory. Errors:
/// SCREE_ERROR_INPUT with the member as field; memory.
SCREE_API scree_status scree_theory_lattice(const scree_theory_lattice_of *of, scree_theory **theory,
                                            scree_error *error);

/// A pile in the plane whose stress grows in proportion to the depth below its apex: ife (incipient failure
/// everywhere), bcc (constant ratio of the normal stresses), fpa (fixed principal axes), osl (oriented stress
/// linearity), wedge (elasto-plastic). A number that is NAN has not been given.
typedef struct scree_theory_pile_of {
    const char *kind;
    double slope[2]; ///< degree, left and right; two different ones for a wedge alone
    double height;   ///< m
    double density;  ///< kg/m3, of the pile: that of its grains times the solid fraction
    double gravity;  ///< m/s2
    double eta, mu;  ///< 1, of osl: one of them, the other follows where the surface yields; or both
    double ratio;    ///< 1, K of osl, with tau
    double tau;      ///< degree, of osl; alone: K follows where the surface yields
    double friction; ///< degree, of a wedge; NAN: that of each side is its slope
    bool passive;    ///< of a wedge whose friction is above its slopes: the passive state at the surface
    double axis; ///< degree from the vertical, of a wedge: the ray between the halves of its core; NAN: without shear
    double core; ///< degree from the vertical, of a wedge: the right boundary of a core that is shown beside the others
} scree_theory_pile_of;

/// Parameters, stress on the base, dip, and residuals of the balance of forces, of the closure, at the surface and
/// between sectors (docs/theory/piles.md). Free *theory. Errors: SCREE_ERROR_INPUT with the member as field; memory.
SCREE_API scree_status scree_theory_pile(const scree_theory_pile_of *of, scree_theory **theory, scree_error *error);

/// A line load on an elastic half-space or on an elastic layer on a rigid base.
typedef struct scree_theory_layer_of {
    const char *base;     ///< none (half-space, Flamant), smooth, bonded
    double force;         ///< N/m
    double thickness;     ///< m; of a half-space the depth down to which it is looked at
    double poisson_ratio; ///< 1; felt by a bonded base alone
    bool plane_stress;
} scree_theory_layer_of;

/// Peaks and widths of the response, beside those of the half-space and of the other base, and residuals of the balance
/// of forces, of compatibility, at the surface and at the base. Free *theory. Errors: as above.
SCREE_API scree_status scree_theory_layer(const scree_theory_layer_of *of, scree_theory **theory, scree_error *error);

/// The values, and how many; they live as long as the theory.
SCREE_API size_t scree_theory_values(const scree_theory *theory, const scree_theory_value **values);

/// Writes values.csv and, where there are curves, their tables and figures (CSV, SVG, PNG and the script) into a
/// folder, which is made; files of these names are replaced. Errors: SCREE_ERROR_IO, also without gnuplot.
SCREE_API scree_status scree_theory_write(const scree_theory *theory, const char *folder, scree_error *error);

SCREE_API void scree_theory_free(scree_theory *theory);

#ifdef __cplusplus
}
#endif
#endif
