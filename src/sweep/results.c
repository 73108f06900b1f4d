/// Reading what the members left behind, and collecting it into tables, curves and figures.
#include "sweep/results.h"

#include "base/handle.h"
#include "base/memory.h"
#include "io/run_directory.h"
#include "view/font.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void scree_sweep_tell(const scree_sweep_options *options, int level, const char *format, ...)
{
    char line[2048];
    va_list arguments;
    if (!options->message) return;
    va_start(arguments, format);
    (void)vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    options->message(options->user, level, line);
}

static double read_number(const char *folder, const char *name, scree_error *error)
{
    char text[64], *end;
    if (scree_result_get(folder, name, text, sizeof text, error)) return NAN;
    double value = strtod(text, &end);
    return end != text && !*end ? value : NAN;
}

/// Measures of a finished member.
static void read_member(scree_sweep_results *results, const scree_member_paths *paths, size_t member)
{
    const scree_sweep *sweep = results->sweep;
    results->wall_time[member] = read_number(paths->folder, "wall_time", NULL);
    for (size_t k = 0; k < sweep->measure_count; k++)
        results->value[member * sweep->measure_count + k] = read_number(paths->folder, sweep->measure[k], NULL);
}

/// A measure that no finished member has: it belongs to another case, or was never reached.
static void warn_of_missing(const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    for (size_t k = 0; k < sweep->measure_count && results->done > 0; k++) {
        bool found = false;
        for (size_t i = 0; i < sweep->member_count && !found; i++)
            found = isfinite(results->value[i * sweep->measure_count + k]);
        if (!found)
            scree_sweep_tell(results->options, 1, "measures: none of the %zu members that are done has a value of '%s'",
                             results->done, sweep->measure[k]);
    }
}

static scree_status look_at_members(scree_sweep_results *results, scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < sweep->member_count && !status; i++) {
        scree_case *c;
        scree_member_paths paths;
        status = scree_member_find(sweep, i, results->options->output, &paths, error);
        if (!status) status = scree_member_resolve(sweep, i, &c, error);
        if (status) break;
        results->state[i] = scree_member_look(&paths, c, NULL, 0);
        scree_case_free(c);
        results->wall_time[i] = NAN;
        for (size_t k = 0; k < sweep->measure_count; k++) results->value[i * sweep->measure_count + k] = NAN;
        if (results->state[i] == SCREE_MEMBER_DONE) read_member(results, &paths, i);
        results->done += results->state[i] == SCREE_MEMBER_DONE;
        results->failed += results->state[i] == SCREE_MEMBER_FAILED;
    }
    return status;
}

static scree_status estimate_measures(scree_sweep_results *results, scree_error *error)
{
    const scree_sweep *sweep = results->sweep;
    double *value;
    scree_status status = scree_allocate(&value, sweep->realisations, sizeof *value, error);
    if (status) return status;
    for (size_t point = 0; point < sweep->point_count; point++)
        for (size_t k = 0; k < sweep->measure_count; k++) {
            for (size_t r = 0; r < sweep->realisations; r++)
                value[r] = results->value[(r * sweep->point_count + point) * sweep->measure_count + k];
            results->estimate[point * sweep->measure_count + k] =
                scree_estimate_mean(value, sweep->realisations, sweep->config.confidence);
        }
    scree_release(&value);
    return SCREE_OK;
}

scree_status scree_sweep_results_read(scree_sweep_results *results, const scree_sweep *sweep,
                                      const scree_sweep_options *options, scree_error *error)
{
    *results = (scree_sweep_results){.sweep = sweep, .options = options};
    size_t members = sweep->member_count, measures = sweep->measure_count;
    scree_status status = scree_allocate(&results->state, members, sizeof *results->state, error);
    if (!status) status = scree_allocate(&results->wall_time, members, sizeof(double), error);
    if (!status) status = scree_allocate(&results->value, members * measures, sizeof(double), error);
    if (!status)
        status = scree_allocate(&results->estimate, sweep->point_count * measures, sizeof(scree_estimate), error);
    if (!status) status = look_at_members(results, error);
    if (!status) status = estimate_measures(results, error);
    if (!status) warn_of_missing(results);
    if (status) scree_sweep_results_destroy(results);
    return status;
}

void scree_sweep_results_destroy(scree_sweep_results *results)
{
    scree_release(&results->state);
    scree_release(&results->wall_time);
    scree_release(&results->value);
    scree_release(&results->estimate);
}

/// Folders of an older form of the sweep stay, but count no more.
static void warn_of_strangers(const scree_sweep *sweep, const scree_sweep_options *options)
{
    char path[PATH_MAX];
    size_t count = 0;
    if (scree_path_join(path, sizeof path, options->output, "members", NULL)) return;
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        if (entry->d_name[0] == '.' || entry->d_type != DT_DIR) continue;
        bool known = false;
        for (size_t i = 0; i < sweep->member_count && !known; i++) known = strcmp(entry->d_name, sweep->folder[i]) == 0;
        count += !known;
    }
    if (folder) closedir(folder);
    if (count > 0)
        scree_sweep_tell(options, 1, "%zu folders in '%s' do not belong to this sweep and are left alone", count, path);
}

static scree_status make_curves(const scree_sweep_results *results, scree_error *error)
{
    for (int64_t i = 0; i < results->sweep->config.curve_count; i++) {
        scree_mean_curve curve;
        scree_error problem;
        scree_status status = scree_mean_curve_make(results, (size_t)i, &curve, &problem);
        if (!status) status = scree_mean_curve_write(results, &curve, &problem);
        if (!status && results->options->figures) scree_sweep_draw_curve(results, &curve);
        scree_mean_curve_destroy(&curve);
        // A curve that no member has is left out; a full disk is not passed over.
        if (status == SCREE_ERROR_INPUT) scree_sweep_tell(results->options, 1, "%s", problem.message);
        if (status && status != SCREE_ERROR_INPUT) {
            *error = problem;
            return status;
        }
    }
    return SCREE_OK;
}

static scree_status make_folders(const char *output, scree_error *error)
{
    static const char *const names[] = {"curves", "figures"};
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < sizeof names / sizeof *names && !status; i++) {
        char path[PATH_MAX];
        status = scree_path_join(path, sizeof path, output, names[i], error);
        if (!status) status = scree_folders_make(path, error);
    }
    return status;
}

static void warn_of_font(const scree_sweep_options *options)
{
    char said[300];
    if (options->figures && scree_font_missing(said, sizeof said)) scree_sweep_tell(options, 1, "%s", said);
}

static scree_status collect(const scree_sweep *sweep, const scree_sweep_options *options, scree_error *error)
{
    scree_sweep_results results;
    scree_status status = scree_sweep_results_read(&results, sweep, options, error);
    if (status) return status;
    status = scree_sweep_write_tables(&results, error);
    if (!status) status = scree_sweep_write_record(&results, error);
    if (!status && results.done > 0) status = make_curves(&results, error);
    if (!status && results.done > 0 && options->figures) scree_sweep_draw_measures(&results);
    if (!status) status = scree_ensembles_measure(&results, error);
    warn_of_strangers(sweep, options);
    warn_of_font(options);
    size_t missing = sweep->member_count - results.done - results.failed;
    if (!status && missing > 0)
        scree_sweep_tell(options, 1, "%zu of %zu members are still to be run", missing, sweep->member_count);
    if (!status && results.failed > 0)
        status = scree_error_set(error, SCREE_ERROR_GUARD,
                                 "%zu of %zu members have failed, the means are those of the others; why is in "
                                 "%s/members/*.txt, and --retry runs them anew",
                                 results.failed, sweep->member_count, options->output);
    scree_sweep_results_destroy(&results);
    return status;
}

scree_status scree_sweep_collect(const scree_sweep *sweep, const scree_sweep_options *options, scree_error *error)
{
    scree_handle_check(sweep, "a sweep");
    scree_error local;
    scree_folder_lock lock = {0};
    if (!error) error = &local;
    scree_status status = make_folders(options->output, error);
    // Members may run meanwhile; the tables have one writer.
    if (!status) status = scree_folder_lock_take(&lock, options->output, "scree sweep", error);
    if (!status) status = collect(sweep, options, error);
    scree_folder_lock_release(&lock);
    return status;
}
