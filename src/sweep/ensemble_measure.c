/// Making the averages over the members of each point: scree_measure of their folders.
#include "sweep/ensemble.h"
#include "sweep/results.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <string.h>

/// Who is told what may be wrong with averages; their numbers are in the files.
typedef struct listener {
    const scree_sweep_results *results;
    size_t told, known; ///< warnings of these averages, and of the same without a fit, which come in the same order
} listener;

static void pass_warning(void *user, const char *line)
{
    listener *l = user;
    static const char mark[] = "warning: ";
    if (strncmp(line, mark, sizeof mark - 1) == 0 && ++l->told > l->known)
        scree_sweep_tell(l->results->options, 1, "ensemble: %s", line + sizeof mark - 1);
}

/// What was wrong with the averages of a point, and with which key. A sweep of one point has no name for it.
static void tell_problem(const scree_sweep_results *results, size_t point, const scree_error *problem)
{
    const char *name = results->sweep->point[point], *option = problem->field;
    const bool keyed = strncmp(option, "--", 2) == 0;
    scree_sweep_tell(results->options, 1, "ensemble%s%s%s: %s%s%s%s", name[0] ? " of '" : "", name, name[0] ? "'" : "",
                     keyed ? "ensemble." : "", keyed ? option + 2 : "", keyed ? ": " : "", problem->message);
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

/// Says beside the figures which of them a report shows.
static scree_status name_figures(const char *folder, const char *names, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    if (!names || !names[0]) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, folder, SCREE_ENSEMBLE_FIGURES, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    (void)fprintf(file, "%s\n", names);
    return scree_replace_finish(path, file, true, error);
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
    listener l = {.results = results};
    options.message = pass_warning;
    options.user = &l;
    if (!status && count > 0) {
        status = scree_measure((const char *const *)folder, count, &options, &problem);
        // Too few piles, or too small ones, for theories still have their averages.
        if (status == SCREE_ERROR_INPUT && options.fit && strcmp(problem.field, "--fit") == 0) {
            tell_problem(results, point, &problem);
            options.fit = NULL;
            l = (listener){.results = results, .known = l.told};
            status = scree_measure((const char *const *)folder, count, &options, &problem);
        }
        if (status == SCREE_ERROR_INPUT)
            tell_problem(results, point, &problem);
        else if (status)
            *error = problem;
        if (status == SCREE_ERROR_INPUT)
            status = SCREE_OK;
        else if (!status)
            status = name_figures(output, sweep->config.ensemble.figures, error);
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
