/// All figures of a run directory. A figure that cannot be drawn does not keep the others from being drawn: the first
/// failure is what scree_plot returns at the end.
#include "view/plot.h"

#include "view/plot_parts.h"

#include "base/memory.h"
#include "case/case.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void tell(const scree_plot_run *run, const char *line)
{
    if (run->message) run->message(run->user, line);
}

void scree_plot_report(scree_plot_run *run, const char *name, scree_status status, const scree_error *error)
{
    char line[PATH_MAX + 300];
    if (status == SCREE_OK)
        (void)snprintf(line, sizeof line, "%s/%s.svg", run->figures, name);
    else
        (void)snprintf(line, sizeof line, "%s %s: %.900s", name, status == SCREE_ERROR_INPUT ? "left out" : "failed",
                       error->message);
    tell(run, line);
    if (status == SCREE_OK || status == SCREE_ERROR_INPUT || run->status) return;
    run->status = status;
    run->error = *error;
}

static scree_status read_series(scree_plot_run *run, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_read(&run->series, path, error);
    if (status) return status;
    scree_loading_rows rows = scree_loading_rows_find(&run->series);
    run->first_row = rows.first;
    run->row_count = rows.last - rows.first;
    return status;
}

/// Leaves only the strains of the loading stage, the last `count` of the snapshots up to `last`.
static void keep_loading_stage(scree_plot_run *run, size_t last, size_t count)
{
    for (size_t k = 0; k < run->snapshot_count; k++)
        if (k > last || k + count <= last) run->strain[k] = NAN;
}

/// Only the strain of each snapshot is kept: a scene reads the snapshots that it needs again.
static scree_status read_strains(scree_plot_run *run, scree_error *error)
{
    scree_snapshot snapshot;
    char stage[sizeof snapshot.stage] = "";
    size_t count = 0, last = 0, of_stage = 0;
    scree_status status = scree_snapshot_count(run->directory, &count, error);
    if (!status) status = scree_allocate(&run->strain, count, sizeof *run->strain, error);
    for (size_t k = 0; !status && k < count; k++) {
        status = scree_snapshot_read(run->directory, k, &snapshot, error);
        if (status) break;
        run->strain[run->snapshot_count++] = snapshot.axial_strain;
        run->of_cell = snapshot.periodic.directions == (1u << snapshot.dimension) - 1;
        if (isfinite(snapshot.axial_strain)) {
            of_stage = scree_snapshot_begins_stage(stage, snapshot.stage, snapshot.axial_strain) ? 1 : of_stage + 1;
            last = k;
        }
        memcpy(stage, snapshot.stage, sizeof stage);
        scree_snapshot_destroy(&snapshot);
    }
    keep_loading_stage(run, last, of_stage);
    return status;
}

/// Windows of the case, when case.yaml can be read and has some.
static scree_status read_case_windows(scree_plot_run *run, scree_error *error)
{
    char path[PATH_MAX];
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_CASE, error);
    if (status) return status;
    if (scree_case_reread(path, scree_former_keys, &c, &problems)) {
        scree_problems_free(problems);
        return SCREE_OK;
    }
    size_t count = (size_t)c->config.measure.window_count;
    status = scree_allocate(&run->window, count, sizeof *run->window, error);
    if (!status) run->window_count = count;
    for (size_t k = 0; k < run->window_count; k++) run->window[k] = c->config.measure.windows[k];
    scree_case_free(c);
    return status;
}

/// Without a case: the first and the last quarter of the loading.
static scree_status find_windows(scree_plot_run *run, scree_error *error)
{
    scree_status status = read_case_windows(run, error);
    if (status || run->window_count > 0) return status;
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < run->snapshot_count; k++) {
        low = fmin(low, run->strain[k]);
        high = fmax(high, run->strain[k]);
    }
    scree_release(&run->window);
    status = scree_allocate(&run->window, 2, sizeof *run->window, error);
    if (status) return status;
    run->window[0] = (scree_config_window){low, low + (high - low) / 4};
    run->window[1] = (scree_config_window){high - (high - low) / 4, high};
    run->window_count = 2;
    return SCREE_OK;
}

scree_status scree_plot(const char *directory, void (*message)(void *user, const char *path), void *user,
                        scree_error *error)
{
    scree_folder_lock lock = {0};
    scree_status status = SCREE_OK;
    // Without a folder there is no run, and drawing says so.
    if (access(directory, F_OK) == 0) status = scree_folder_lock_take(&lock, directory, "scree plot", error);
    if (!status) status = scree_plot_draw(directory, message, user, error);
    scree_folder_lock_release(&lock);
    return status;
}

scree_status scree_plot_draw(const char *directory, void (*message)(void *user, const char *path), void *user,
                             scree_error *error)
{
    scree_plot_run run = {.directory = directory, .message = message, .user = user};
    scree_error series_error = {0}, snapshot_error = {0};
    scree_status series = read_series(&run, &series_error);
    scree_status snapshots = read_strains(&run, &snapshot_error);
    scree_status status = SCREE_OK;
    if (series && snapshots && run.snapshot_count == 0) {
        status = scree_error_set(error, SCREE_ERROR_IO, "no run to draw in '%s': %s", directory, series_error.message);
    } else {
        status = scree_path_join(run.figures, sizeof run.figures, directory, SCREE_FOLDER_FIGURES, error);
        if (!status && mkdir(run.figures, 0777) != 0 && errno != EEXIST)
            status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot create the folder '%s'", run.figures);
        if (!status) status = find_windows(&run, error);
    }
    if (!status) {
        if (series)
            scree_plot_report(&run, SCREE_FILE_SERIES, series, &series_error);
        else
            scree_plot_charts(&run);
        if (snapshots) scree_plot_report(&run, SCREE_FILE_RUN, snapshots, &snapshot_error);
        scree_plot_scenes(&run);
        scree_plot_rotation(&run);
        status = run.status;
        if (status && error) *error = run.error;
    }
    scree_series_destroy(&run.series);
    scree_release(&run.strain);
    scree_release(&run.window);
    return status;
}
