/// Fits of theories to measured stresses: weighted least squares over all components that have an error.
///
/// chi^2 = sum ((measured - theory) / error)^2 is made least by Levenberg's and Marquardt's method (GSL). The errors of
/// parameters are roots of the diagonal of (J^T J)^-1, J the derivatives over the errors: right where the given errors
/// are those of independent, normally distributed values. Values of elements that overlap are not independent; then
/// errors come out too small, and chi^2 too. Theories are compared by AIC = chi^2 + 2 k of the same values, k free
/// parameters: the smaller, the better, and exp(-difference / 2) is how likely the other one is beside it.
///
/// Stresses of piles have kinks; a fit may end in a minimum that is not the lowest. Begin near what is expected, and
/// elsewhere, too.
#ifndef SCREE_THEORY_FIT_H
#define SCREE_THEORY_FIT_H

#include "theory/fit_theories.h"

/// A theory with its parameters, and what the fit found.
typedef struct scree_fit {
    const scree_fit_theory *theory;
    size_t parameters;
    scree_fit_parameter parameter[SCREE_FIT_PARAMETERS];
    double covariance[SCREE_FIT_PARAMETERS][SCREE_FIT_PARAMETERS]; ///< of all parameters; 0 with those that are held
    size_t values;                                                 ///< components that counted
    size_t free;                                                   ///< free parameters, k
    double chi_square;
    double reduced;     ///< chi^2 over (values - k); NAN without a degree of freedom
    double probability; ///< of a larger chi^2, if the theory and the errors are right
    double information; ///< AIC, chi^2 + 2 k
    size_t iterations;
} scree_fit;

/// Names of the theories: ife, bcc, fpa, osl (eta free, mu by R 4.24), oriented (eta and mu free), wedge_dip,
/// wedge_smooth, wedge_peak, wedge_core (the boundary of the core free), flamant, layer_smooth, layer_bonded. NULL
/// behind the last one.
const char *scree_fit_theory_name(size_t number);

/// Whether a theory of this name is one of the response of a layer to a load; else it is one of a pile.
bool scree_fit_is_layer(const char *theory);

/// The parameters of a theory, with values to begin with; which are free is the usual choice: the slopes are held.
/// Errors: SCREE_ERROR_INPUT with the nearest name.
scree_status scree_fit_begin(const char *theory, scree_fit *fit, scree_error *error) SCREE_MUST_USE;

/// Sets where a parameter begins and whether it is free. Errors: SCREE_ERROR_INPUT for a name that the theory does not
/// have.
scree_status scree_fit_set(scree_fit *fit, const char *name, double value, bool free,
                           scree_error *error) SCREE_MUST_USE;

/// NULL when the theory does not have it.
const scree_fit_parameter *scree_fit_find(const scree_fit *fit, const char *name);

/// Stress of the theory with its present parameters at the places of the points, one each. Errors: SCREE_ERROR_INPUT
/// for parameters for which it has no solution; memory.
scree_status scree_fit_stress(const scree_fit *fit, size_t count, const scree_fit_point *points,
                              scree_stress_2d *stress, scree_error *error) SCREE_MUST_USE;

/// Finds the free parameters. With none it compares. Errors: SCREE_ERROR_INPUT for fewer values than free parameters,
/// for a beginning without a solution, and for parameters that the points cannot tell apart; SCREE_ERROR_GUARD when the
/// search does not end; memory.
scree_status scree_fit_solve(scree_fit *fit, size_t count, const scree_fit_point *points,
                             scree_error *error) SCREE_MUST_USE;

#endif
