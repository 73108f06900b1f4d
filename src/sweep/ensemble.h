/// Ensembles: continuum averages over the members of a point, made by `scree_measure` as of any several runs, in
/// ensemble/POINT of the folder of the sweep ("all" where nothing varies); and what expressions make of their results.
///
/// A name ends in ensemble_RESULT where it means a result of an ensemble; its interval is from RESULT_low to
/// RESULT_high of its summary.json. An expression f of several results x_k, each in [l_k, u_k], has the interval of
/// G. Y. Zou and A. Donner (Statist. Med. 27, 1693, 2008: variance estimates recovered from the limits)
///     f - (sum_e (sum_k (f - min f_k))^2)^(1/2)   to   f + (sum_e (sum_k (max f_k - f))^2)^(1/2),
/// f_k the two values of f with x_k at one of its ends and all others as they are. Results of different ensembles e are
/// independent; those of one are not, and their parts are added up without signs. Exact for one result in a monotonic
/// f, and theirs for sums and differences.
#ifndef SCREE_SWEEP_ENSEMBLE_H
#define SCREE_SWEEP_ENSEMBLE_H

#include "sweep/findings.h"
#include "sweep/sweep.h"

#define SCREE_ENSEMBLE_PREFIX  "ensemble_"
#define SCREE_ENSEMBLE_FIGURES "figures.txt" /* names of the figures that a report shows, beside them */
#define SCREE_ENSEMBLE_USUAL   "cuts-pressure-scaled"

/// A result of an ensemble.
typedef struct scree_ensemble_value {
    double middle, low, high; ///< ends NAN where there is no interval
    size_t group;             ///< which ensemble it belongs to
} scree_ensemble_value;

/// The options of `scree measure` that a sweep says; without output or message.
scree_measure_options scree_ensemble_options(const scree_sweep_ensemble *ensemble);

/// Number of runs that the averages in a folder are over; 0: there are none.
size_t scree_ensemble_runs(const char *folder);

/// A result (without prefix) of a folder; middle NAN: there is none of the name.
scree_ensemble_value scree_ensemble_get(const char *folder, const char *result);

/// Visits the names of all results of a folder, without prefix.
void scree_ensemble_visit(const char *folder, void (*take)(void *user, const char *name, const char *value),
                          void *user);

/// Whether a name of an expression means a result of an ensemble.
bool scree_reference_is_ensemble(const scree_reference *reference);

/// Samples of which fewer have no interval of 95 % by resampling: it lies within the range of their values, which holds
/// their median in 1 - 2^(1 - n) of all cases.
enum { SCREE_ENSEMBLE_FEWEST = 6 };

/// Most names that an expression may have.
enum { SCREE_ENSEMBLE_NAMES = 16 };

/// Value of an expression with its interval. value: [count], in the order in which the names occur in `text`, each as
/// often as it does. interval->count is left alone. Errors: of the expression.
scree_status scree_ensemble_evaluate(const char *text, const scree_ensemble_value *value, size_t count, double *middle,
                                     double *low, double *high, scree_error *error) SCREE_MUST_USE;

#endif
