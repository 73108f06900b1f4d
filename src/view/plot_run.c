/// A run as its figures see it: series, strains of the snapshots, strain windows.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "case/case.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The axial strain goes back by more than a part of its range.
static bool turns_back(const scree_plot_run *run)
{
    const double *strain = scree_series_get(&run->series, "axial_strain"), part = 0.05;
    double low = INFINITY, high = -INFINITY, back = 0, ahead = 0;
    for (size_t k = run->first_row; strain && k < run->first_row + run->row_count; k++) {
        low = fmin(low, strain[k]);
        high = fmax(high, strain[k]);
        back = fmax(back, high - strain[k]);
        ahead = fmax(ahead, strain[k] - low);
    }
    return fmin(back, ahead) > part * (high - low);
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
    run->path = scree_loading_path_find(&run->series);
    run->winding = run->path.label || turns_back(run);
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
        run->dimension = snapshot.dimension;
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

/// Whether the particles of a case differ in size.
static bool sizes_vary(const scree_config *config)
{
    if (scree_config_species_count(&config->particles) > 1) return true;
    const int distribution = scree_config_species_at(&config->particles, 0).distribution;
    return distribution >= 0 && !scree_modules[distribution]->sizes->equal;
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
    const size_t count = (size_t)c->config.measure.window_count;
    run->sizes_vary = sizes_vary(&c->config);
    status = scree_allocate(&run->window, count, sizeof *run->window, error);
    if (!status) run->window_count = count;
    for (size_t k = 0; k < run->window_count; k++) run->window[k] = c->config.measure.windows[k];
    scree_case_free(c);
    return status;
}

/// Without windows in the case: the first and the last quarter of the loading; none where no two snapshots differ in
/// strain, or the strain turns back, so that it does not say when.
static scree_status find_windows(scree_plot_run *run, scree_error *error)
{
    scree_status status = read_case_windows(run, error);
    if (status || run->window_count > 0 || turns_back(run)) return status;
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < run->snapshot_count; k++) {
        low = fmin(low, run->strain[k]);
        high = fmax(high, run->strain[k]);
    }
    if (!(low < high)) return SCREE_OK;
    scree_release(&run->window);
    status = scree_allocate(&run->window, 2, sizeof *run->window, error);
    if (status) return status;
    run->window[0] = (scree_config_window){low, low + (high - low) / 4};
    run->window[1] = (scree_config_window){high - (high - low) / 4, high};
    run->window_count = 2;
    return SCREE_OK;
}

scree_status scree_plot_run_open(scree_plot_run *run, const char *directory, scree_error *error)
{
    *run = (scree_plot_run){.directory = directory};
    run->series_status = read_series(run, &run->series_error);
    run->snapshot_status = read_strains(run, &run->snapshot_error);
    if (run->series_status && run->snapshot_status && run->snapshot_count == 0)
        return scree_error_set(error, SCREE_ERROR_IO, "no run to draw in '%s': %s", directory,
                               run->series_error.message);
    return find_windows(run, error);
}

void scree_plot_run_close(scree_plot_run *run)
{
    scree_series_destroy(&run->series);
    scree_release(&run->strain);
    scree_release(&run->window);
}

// ---- snapshots ---------------------------------------------------------------------------------------------------

bool scree_plot_has_snapshot(const scree_plot_run *run, const scree_figure *figure)
{
    (void)figure;
    return run->snapshot_count > 0;
}

size_t scree_plot_end_snapshot(const scree_plot_run *run, bool last)
{
    for (size_t k = 0; k < run->snapshot_count; k++) {
        size_t which = last ? run->snapshot_count - 1 - k : k;
        if (isfinite(run->strain[which])) return which;
    }
    return last ? run->snapshot_count - 1 : 0;
}

static size_t nearest_snapshot(const scree_plot_run *run, double strain)
{
    size_t best = scree_plot_end_snapshot(run, false);
    for (size_t k = 0; k < run->snapshot_count; k++)
        if (fabs(run->strain[k] - strain) < fabs(run->strain[best] - strain)) best = k;
    return best;
}

scree_status scree_plot_find_snapshot(const scree_plot_run *run, scree_plot_when when, size_t *which,
                                      scree_error *error)
{
    *which = scree_plot_end_snapshot(run, when == SCREE_AT_END);
    if (when == SCREE_AT_WINDOW && run->window_count > 0)
        *which = nearest_snapshot(run, 0.5 * (run->window[0].from + run->window[0].to));
    if (when != SCREE_AT_PEAK) return SCREE_OK;
    const double *strain = scree_series_get(&run->series, "axial_strain");
    const double *ratio = scree_series_get(&run->series, "stress_ratio");
    scree_peak peak = {NAN, NAN};
    const scree_loading_rows rows = {run->first_row, run->first_row + run->row_count};
    if (strain && ratio) peak = scree_peak_find(ratio, strain, rows);
    *which = nearest_snapshot(run, peak.strain);
    if (isfinite(peak.value)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no stress ratio to find the peak of", SCREE_FILE_SERIES);
}

scree_status scree_plot_find_window(const scree_plot_run *run, const scree_config_window *window, size_t *first,
                                    size_t *second, scree_error *error)
{
    *first = nearest_snapshot(run, window->from);
    *second = nearest_snapshot(run, window->to);
    if (*first != *second && isfinite(run->strain[*first]) && isfinite(run->strain[*second])) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "too few snapshots of loading for this strain window");
}

scree_status scree_plot_read_two(const scree_plot_run *run, size_t first, size_t second, scree_snapshot *a,
                                 scree_snapshot *b, scree_error *error)
{
    scree_status status = scree_snapshot_read(run->directory, first, a, error);
    if (status) return status;
    status = scree_snapshot_read(run->directory, second, b, error);
    if (!status && (a->count != b->count || memcmp(a->id, b->id, a->count * sizeof *a->id) != 0)) {
        status = scree_error_set(error, SCREE_ERROR_INPUT, "snapshots %zu and %zu are not of the same particles", first,
                                 second);
        scree_snapshot_destroy(b);
    }
    if (status) scree_snapshot_destroy(a);
    return status;
}

double scree_plot_result(const scree_plot_run *run, const char *name)
{
    char text[128];
    scree_error ignored;
    return scree_result_get(run->directory, name, text, sizeof text, &ignored) ? NAN : strtod(text, NULL);
}

void scree_plot_percent(char *text, size_t size, double strain, bool name)
{
    double percent = 100 * strain;
    if (!name && fabs(percent) < 0.95) {
        (void)snprintf(text, size, "%.2g", percent + 0.0);
        return;
    }
    bool whole = fabs(percent - round(percent)) < 0.05;
    if (whole) percent = round(percent) + 0.0; // no minus zero
    (void)snprintf(text, size, "%0*.*f", !name ? 0 : whole ? 2 : 4, whole ? 0 : 1, percent);
}
