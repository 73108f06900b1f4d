/// The theories that can be fitted: a row each.
#ifndef SCREE_THEORY_FIT_THEORIES_H
#define SCREE_THEORY_FIT_THEORIES_H

#include "base/error.h"
#include "theory/pile.h"

enum { SCREE_FIT_PARAMETERS = 8, SCREE_FIT_DERIVED = 8 };

/// A measured stress, in the frame of the theory (theory/pile.h, theory/layer.h). A component without an error above
/// zero is left out.
typedef struct scree_fit_point {
    double x, y;            ///< m
    scree_stress_2d stress; ///< Pa, compression positive
    scree_stress_2d error;  ///< Pa, standard error
} scree_fit_point;

typedef struct scree_fit_parameter {
    const char *name, *unit, *meaning;
    double value; ///< where the search begins; after it the best
    double error; ///< standard error; 0 of what is held
    bool free;
} scree_fit_parameter;

/// A number that follows from the parameters.
typedef struct scree_fit_derived {
    const char *name, *unit;
    double value; ///< NAN where they have no solution
} scree_fit_derived;

typedef struct scree_fit_theory {
    const char *name;
    scree_fit_parameter parameter[SCREE_FIT_PARAMETERS]; ///< ends with one that has no name
    /// Stresses at the points; `kind` is the number below.
    scree_status (*stress)(const struct scree_fit_theory *theory, const scree_fit_parameter *parameter, size_t count,
                           const scree_fit_point *points, scree_stress_2d *stress, scree_error *error);
    int kind;
    /// What follows from the parameters, always the same names; returns how many. NULL: nothing.
    size_t (*derive)(const struct scree_fit_theory *theory, const scree_fit_parameter *parameter,
                     scree_fit_derived derived[SCREE_FIT_DERIVED]);
} scree_fit_theory;

extern const scree_fit_theory scree_fit_theories[]; ///< ends with a row that has no name

#endif
