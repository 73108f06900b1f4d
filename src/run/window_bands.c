/// P looks at displacements in two windows of strain, one behind the other (figs. 3.7 to 3.9): localisation that began
/// in the first is seen to intensify in the second, or is not propagated to it. The windows are those of
/// measure.windows, the first pair that adjoins; the distortion of the cells in each is smoothed and measured as in
/// windows of measure.band_window (measure/localisation.h). Where there is one window alone (figs. 2.6, 2.7), its
/// index.
///
/// Snapshots of the loading stage that lie nearest to the three strains are taken; where one is off by more than APART
/// of the shorter window there are no results. Cost: three snapshots read, two localisations.
#include "run/window_bands.h"

#include "io/loading_stage.h"
#include "io/run_directory.h"
#include "io/snapshot.h"
#include "measure/localisation.h"
#include "module/module.h"
#include "run/conclusion.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static const double APART = 0.25;

bool scree_windows_followed(const scree_config_measure *measure, scree_followed *out)
{
    for (int64_t k = 0; k + 1 < measure->window_count; k++) {
        const scree_config_window *one = &measure->windows[k], *next = one + 1;
        if (!(fabs(one->to - next->from) <= 1e-9)) continue;
        *out = (scree_followed){{one->from, one->to, next->to}, 3};
        return true;
    }
    if (measure->window_count != 1) return false;
    *out = (scree_followed){{measure->windows[0].from, measure->windows[0].to}, 2};
    return true;
}

// ---- two windows -------------------------------------------------------------------------------------------------

static double mean_diameter(const scree_assembly *assembly)
{
    double sum = 0;
    for (size_t i = 0; i < assembly->count; i++) sum += 2 * assembly->radius[i];
    return sum / (double)assembly->count;
}

static scree_status measure_window(const scree_cell_snapshot *from, const scree_cell_snapshot *to,
                                   scree_localisation *localisation, double *field, uint8_t *inside, scree_error *error)
{
    double *distortion = NULL;
    const double *place = from->assembly.position;
    scree_status status = scree_cells_window_distortion(&from->cells, place, to->assembly.position, &distortion, error);
    if (!status)
        status = scree_localisation_measure(&from->cells, place, distortion, mean_diameter(&from->assembly),
                                            localisation, field, inside, error);
    scree_release(&distortion);
    return status;
}

scree_status scree_window_bands_compare(const scree_cell_snapshot *first, const scree_cell_snapshot *middle,
                                        const scree_cell_snapshot *last, scree_window_bands *out, scree_error *error)
{
    size_t bodies = first->assembly.count;
    double *field = NULL;
    uint8_t *inside = NULL;
    scree_localisation localisation[2] = {{.index = NAN}, {.index = NAN}};
    scree_status status = scree_allocate(&field, 2 * bodies, sizeof *field, error);
    if (!status) status = scree_allocate(&inside, 2 * bodies, 1, error);
    if (!status) status = measure_window(first, middle, &localisation[0], field, inside, error);
    if (!status && last)
        status = measure_window(middle, last, &localisation[1], field + bodies, inside + bodies, error);
    if (!status)
        *out = (scree_window_bands){.correlation = last ? scree_field_correlation(field, field + bodies, bodies) : NAN,
                                    .overlap = last ? scree_band_overlap(inside, inside + bodies, bodies) : NAN,
                                    .index = {localisation[0].index, localisation[1].index}};
    scree_release(&field);
    scree_release(&inside);
    return status;
}

// ---- the run -----------------------------------------------------------------------------------------------------

/// A snapshot that is looked for.
typedef struct nearest {
    scree_cell_snapshot snapshot;
    double away; ///< from its strain; INFINITY: none yet
} nearest;

static void forget(nearest place[3])
{
    for (int k = 0; k < 3; k++) {
        scree_cell_snapshot_destroy(&place[k].snapshot);
        place[k] = (nearest){.away = INFINITY};
    }
}

/// Takes over `number` of the run where it is nearer than what is there.
static scree_status offer(const char *directory, size_t number, const scree_cell_snapshot *seen,
                          const scree_followed *at, nearest place[3], scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < at->count && !status; k++) {
        double away = fabs(seen->axial_strain - at->strain[k]);
        if (!(away < place[k].away)) continue;
        scree_cell_snapshot_destroy(&place[k].snapshot);
        place[k] = (nearest){.away = INFINITY};
        status = scree_cell_snapshot_read(directory, number, &place[k].snapshot, error);
        if (!status) place[k].away = away;
    }
    return status;
}

/// Fills `place` from the last stage that strains the sample.
static scree_status find_snapshots(const char *directory, const scree_followed *at, nearest place[3],
                                   scree_error *error)
{
    size_t count = 0;
    char stage[32] = "";
    scree_status status = scree_snapshot_count(directory, &count, error);
    for (size_t n = 0; n < count && !status; n++) {
        scree_cell_snapshot seen;
        status = scree_cell_snapshot_read(directory, n, &seen, error);
        if (status == SCREE_ERROR_INPUT) { // without cells
            status = SCREE_OK;
            continue;
        }
        if (!status && isfinite(seen.axial_strain)) {
            if (scree_snapshot_begins_stage(stage, seen.stage, seen.axial_strain)) forget(place);
            memcpy(stage, seen.stage, sizeof stage);
            status = offer(directory, n, &seen, at, place, error);
        }
        scree_cell_snapshot_destroy(&seen);
    }
    return status;
}

static bool are_near(const scree_followed *at, const nearest place[3])
{
    double allowed = APART * (at->strain[1] - at->strain[0]);
    if (at->count == 3) allowed = fmin(allowed, APART * (at->strain[2] - at->strain[1]));
    for (size_t k = 0; k < at->count; k++)
        if (!(place[k].away <= allowed) || !scree_cell_snapshots_agree(&place[0].snapshot, &place[k].snapshot))
            return false;
    return true;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_model *model = &run->s->model;
    scree_followed at;
    scree_window_bands bands;
    char path[4096];
    if (!model->measure.cells || model->periodic || !scree_windows_followed(&model->measure, &at)) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_RUN, error);
    if (status || access(path, F_OK) != 0) return status;
    nearest place[3] = {{.away = INFINITY}, {.away = INFINITY}, {.away = INFINITY}};
    status = find_snapshots(run->directory, &at, place, error);
    bool found = !status && are_near(&at, place);
    const bool two = at.count == 3;
    if (found)
        status = scree_window_bands_compare(&place[0].snapshot, &place[1].snapshot, two ? &place[2].snapshot : NULL,
                                            &bands, error);
    if (found && !status) scree_summary_set_number(run->summary, "window_index", bands.index[0]);
    if (found && !status && two) {
        scree_summary_set_number(run->summary, "window_correlation", bands.correlation);
        scree_summary_set_number(run->summary, "window_overlap", bands.overlap);
        scree_summary_set_number(run->summary, "window_index_next", bands.index[1]);
    }
    forget(place);
    return status;
}

static const scree_result results[] = {
    {"window_correlation", "1", "correlation of the distortion in two adjoining strain windows"},
    {"window_overlap", "1", "grains in the bands of both over grains in either"},
    {"window_index", "1", "localisation index of the first of these windows, or of the only one"},
    {"window_index_next", "1", "localisation index of the second"},
};

const scree_module scree_module_window_bands = {
    .name = "window_bands",
    .meaning = "localisation in a strain window, or in two that adjoin",
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
