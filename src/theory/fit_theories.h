/// The theories that can be fitted: a row each.
#ifndef SCREE_THEORY_FIT_THEORIES_H
#define SCREE_THEORY_FIT_THEORIES_H

#include "theory/fit.h"

typedef struct scree_fit_theory {
    const char *name;
    scree_fit_parameter parameter[SCREE_FIT_PARAMETERS]; ///< ends with one that has no name
    /// Stresses at the points; `kind` is the number below.
    scree_status (*stress)(const struct scree_fit_theory *theory, const scree_fit_parameter *parameter, size_t count,
                           const scree_fit_point *points, scree_stress_2d *stress, scree_error *error);
    int kind;
} scree_fit_theory;

extern const scree_fit_theory scree_fit_theories[]; ///< ends with a row that has no name

#endif
