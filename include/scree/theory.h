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

/// The values, and how many; they live as long as the theory.
SCREE_API size_t scree_theory_values(const scree_theory *theory, const scree_theory_value **values);

/// Writes values.csv and, where there are curves, their table and figure (CSV, SVG, PNG and the script) into a folder,
/// which is made; files of these names are replaced. Errors: SCREE_ERROR_IO, also without gnuplot.
SCREE_API scree_status scree_theory_write(const scree_theory *theory, const char *folder, scree_error *error);

SCREE_API void scree_theory_free(scree_theory *theory);

#ifdef __cplusplus
}
#endif
#endif
