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
                                   .points = (long)ensemble->points,
                                   .threads = 1};
}

scree_status scree_ensemble_folder(char *path, size_t size, const char *directory, const char *point,
                                   scree_error *error)
{
    char name[220];
    (void)snprintf(name, sizeof name, "ensemble/%s", point[0] ? point : "all");
    return scree_path_join(path, size, directory, name, error);
}

// ---- making them -------------------------------------------------------------------------------------------------

/// What may be wrong with averages is told; their numbers are in the files.
static void pass_warning(void *user, const char *line)
{
    const scree_sweep_results *results = user;
    static const char mark[] = "warning: ";
    if (strncmp(line, mark, sizeof mark - 1) == 0)
        scree_sweep_tell(results->options, 1, "ensemble: %s", line + sizeof mark - 1);
}

/// Folders of the finished members of a point, in the order of seeds; each is to be released.
static scree_status list_members(const scree_sweep_results *results, size_t point, char **folder, size_t *count,
                                 scree_error *error)
{
    scree_status status = SCREE_OK;
    *count = 0;
    for (size_t i = point; i < results->sweep->member_count && !status; i += results->sweep->point_count) {
        scree_member_paths paths;
        if (results->state[i] != SCREE_MEMBER_DONE) continue;
        status = scree_member_find(results->sweep, i, results->options->output, &paths, error);
        if (!status) status = scree_allocate(&folder[*count], strlen(paths.folder) + 1, 1, error);
        if (!status) memcpy(folder[(*count)++], paths.folder, strlen(paths.folder) + 1);
    }
    return status;
}

static scree_status measure_point(const scree_sweep_results *results, size_t point, char **folder, scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    scree_measure_options options = scree_ensemble_options(&sweep->config.ensemble);
    char output[PATH_MAX];
    size_t count;
    scree_error problem = {0};
    scree_status status = list_members(results, point, folder, &count, error);
    if (!status)
        status = scree_ensemble_folder(output, sizeof output, results->options->output, sweep->point[point], error);
    options.output = output;
    options.no_figures = !results->options->figures;
    options.message = pass_warning;
    options.user = (void *)results;
    if (!status && count > 0) {
        status = scree_measure((const char *const *)folder, count, &options, &problem);
        if (status == SCREE_ERROR_INPUT)
            scree_sweep_tell(results->options, 1, "ensemble of '%s': %s", sweep->point[point], problem.message);
        else if (status)
            *error = problem;
        if (status == SCREE_ERROR_INPUT) status = SCREE_OK;
    }
    for (size_t k = 0; k < count; k++) scree_release(&folder[k]);
    return status;
}

scree_status scree_ensembles_measure(const scree_sweep_results *results, scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    char **folder;
    if (!sweep->measures_ensembles || results->done == 0) return SCREE_OK;
    scree_status status = scree_allocate(&folder, sweep->realisations, sizeof *folder, error);
    for (size_t point = 0; point < sweep->point_count && !status; point++)
        status = measure_point(results, point, folder, error);
    scree_release(&folder);
    return status;
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
