/// Averages over the members of a point, their results, and expressions of them.
#include "sweep/ensemble.h"
#include "sweep/expression.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// NULL for what is not said.
static const char *said(const char *text)
{
    return text && text[0] ? text : NULL;
}

scree_measure_options scree_ensemble_options(const scree_sweep_ensemble *ensemble)
{
    return (scree_measure_options){.fields = said(ensemble->fields),
                                   .cuts = said(ensemble->cuts),
                                   .element = said(ensemble->element),
                                   .grid = said(ensemble->grid),
                                   .kernel = said(ensemble->kernel),
                                   .at = said(ensemble->at),
                                   .from = said(ensemble->from),
                                   .axis = said(ensemble->axis),
                                   .fit = said(ensemble->fit),
                                   .sizes = said(ensemble->sizes),
                                   .mirror = ensemble->mirror,
                                   .two_slopes = ensemble->two_slopes,
                                   .points = (long)ensemble->points,
                                   .threads = 1};
}

// ---- reading them ------------------------------------------------------------------------------------------------

static json_t *load(const char *folder)
{
    char path[PATH_MAX + 32];
    if (!folder[0]) return NULL;
    (void)snprintf(path, sizeof path, "%s/" SCREE_FILE_SUMMARY, folder);
    return json_load_file(path, 0, NULL);
}

static double number_of(json_t *summary, const char *name, const char *end)
{
    char whole[200];
    (void)snprintf(whole, sizeof whole, "%s%s", name, end);
    json_t *value = json_object_get(summary, whole);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

size_t scree_ensemble_runs(const char *folder)
{
    json_t *summary = load(folder);
    const double runs = number_of(summary, "runs", "");
    json_decref(summary);
    return runs > 0 ? (size_t)runs : 0;
}

scree_ensemble_value scree_ensemble_get(const char *folder, const char *result)
{
    json_t *summary = load(folder);
    const scree_ensemble_value value = {.middle = number_of(summary, result, ""),
                                        .low = number_of(summary, result, "_low"),
                                        .high = number_of(summary, result, "_high")};
    json_decref(summary);
    return value;
}

void scree_ensemble_visit(const char *folder, void (*take)(void *user, const char *name, const char *value), void *user)
{
    json_t *summary = load(folder), *value;
    const char *name;
    json_object_foreach(summary, name, value) take(user, name, "");
    json_decref(summary);
}

bool scree_reference_is_ensemble(const scree_reference *reference)
{
    return strncmp(reference->result, SCREE_ENSEMBLE_PREFIX, sizeof SCREE_ENSEMBLE_PREFIX - 1) == 0;
}

// ---- expressions -------------------------------------------------------------------------------------------------

/// Which value is asked for, and which one is at an end of its interval.
typedef struct asking {
    const scree_ensemble_value *value;
    size_t next, count, changed; ///< SIZE_MAX: none
    bool high;
} asking;

static double answer_name(void *user, const char *name)
{
    asking *a = user;
    (void)name;
    const size_t k = a->next++;
    if (k >= a->count) return NAN;
    if (k != a->changed) return a->value[k].middle;
    return a->high ? a->value[k].high : a->value[k].low;
}

static scree_status evaluate_at(const char *text, const scree_ensemble_value *value, size_t count, size_t changed,
                                bool high, double *result, scree_error *error)
{
    asking a = {value, 0, count, changed, high};
    return scree_expression_evaluate(text, answer_name, &a, result, error);
}

scree_status scree_ensemble_evaluate(const char *text, const scree_ensemble_value *value, size_t count, double *middle,
                                     double *low, double *high, scree_error *error)
{
    double down[SCREE_ENSEMBLE_NAMES] = {0}, up[SCREE_ENSEMBLE_NAMES] = {0}, squares[2] = {0, 0};
    scree_status status = evaluate_at(text, value, count, SIZE_MAX, false, middle, error);
    for (size_t k = 0; k < count && !status; k++) {
        double end[2];
        status = evaluate_at(text, value, count, k, false, &end[0], error);
        if (!status) status = evaluate_at(text, value, count, k, true, &end[1], error);
        if (status) break;
        // A number that is none has to stay one: fmin and fmax would pass it over.
        const bool whole = isfinite(end[0]) && isfinite(end[1]);
        down[value[k].group] += whole ? *middle - fmin(*middle, fmin(end[0], end[1])) : NAN;
        up[value[k].group] += whole ? fmax(*middle, fmax(end[0], end[1])) - *middle : NAN;
    }
    for (size_t k = 0; k < SCREE_ENSEMBLE_NAMES; k++) {
        squares[0] += down[k] * down[k];
        squares[1] += up[k] * up[k];
    }
    *low = *middle - sqrt(squares[0]);
    *high = *middle + sqrt(squares[1]);
    return status;
}
