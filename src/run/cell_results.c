/// Pressure over growing circles (P fig. 3.12) and shear bands, from the snapshots of the loading stages.
///
/// Circles (spheres in 3D) around three fixed places on the axis of the sample, at 1/8, 1/2 and 7/8 of the height of
/// its cells, grow by a mean diameter until they are as wide as the sample. Strain windows run from a snapshot to the
/// first one of the same stage that is at least measure.band_window of axial strain later, and the next from there on:
/// cells and positions are those of the first instant, displacements lead to the second. A restarted run gives the same
/// files: everything is read from run.h5. summary.json tells of the loading stage (io/loading_stage.h).
#include "run/cell_results.h"
#include "model/measure_keys.h"

#include "io/cell_file.h"
#include "io/loading_stage.h"
#include "io/run_directory.h"
#include "io/snapshot.h"
#include "measure/localisation.h"
#include "module/key_rows.h"
#include "run/cell_averages.h"
#include "run/conclusion.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { CIRCLE_COLUMNS = 9, BAND_COLUMNS = 24 };

static const scree_series_column circle_columns[CIRCLE_COLUMNS] = {
    {"snapshot", "1", "number of the snapshot"},
    {"time", "s", "simulated time"},
    {"axial_strain", "1", "axial strain of the snapshot"},
    {"position", "1", "0 near the bottom, 1 centre, 2 near the top"},
    {"diameter", "m", "diameter of the circle"},
    {"diameter_ratio", "1", "the same over the mean diameter of the particles"},
    {"volume", "m3", "volume of the cells in the circle"},
    {"pressure", "Pa", "their mean pressure"},
    {"pressure_ratio", "1", "the same over that of all cells"},
};

static const scree_series_column band_columns[BAND_COLUMNS] = {
    {"window", "1", "number of the strain window in its stage"},
    {"from_snapshot", "1", "snapshot at its begin"},
    {"to_snapshot", "1", "snapshot at its end"},
    {"from_strain", "1", "axial strain at its begin"},
    {"to_strain", "1", "axial strain at its end"},
    {"mean_distortion", "1", "distortion of the cells, mean over the volume"},
    {"localisation_index", "1", "0 uniform, 1 all in vanishing volume; of the smoothed distortion"},
    {"index_random", "1", "the same when the cells change places at random"},
    {"significance", "1", "their difference over the scatter of the random ones"},
    {"localised", "1", "1: index and significance are above their limits"},
    {"band", "1", "1: a band is found"},
    {"angle", "degree", "between band and axial direction"},
    {"normal_x", "1", "unit normal of the band"},
    {"normal_y", "1", "unit normal of the band"},
    {"normal_z", "1", "unit normal of the band"},
    {"offset", "m", "middle of the band, along the normal from the centre of the sample"},
    {"thickness_diameters", "1", "thickness in mean diameters"},
    {"volume_fraction", "1", "of the sample"},
    {"share", "1", "of the distortion"},
    {"contrast", "1", "mean distortion inside over outside"},
    {"explained", "1", "share of the variance of the distortion that the band explains"},
    {"percolation", "1", "length of the connected active part over the length of the band"},
    {"correlation", "1", "of the distortion at the particles with the window before"},
    {"overlap", "1", "particles in this and the last band over particles in either"},
};

/// The state of the walk through the snapshots.
typedef struct walk {
    const scree_config_measure *measure;
    double band_window; ///< 1, least axial strain over which shear bands are looked for
    scree_series_writer circles, bands;
    scree_cell_snapshot first; ///< begin of the present window; no bodies: none
    scree_cell_snapshot last;  ///< the last snapshot of it; no bodies: `first`
    scree_band_window *window; ///< of the present stage
    size_t window_count, window_capacity;
    double *field[2]; ///< at the bodies: the last window and this one
    uint8_t *inside[2];
    double diameter; ///< m, of the last window
    const scree_series *series;
    scree_cell_averages averages; ///< of the present stage
    int dimension;
} walk;

// ---- circles -----------------------------------------------------------------------------------------------------

static double mean_diameter(const scree_assembly *assembly)
{
    double sum = 0;
    for (size_t i = 0; i < assembly->count; i++) sum += 2 * assembly->radius[i];
    return sum / (double)assembly->count;
}

/// Corners of the box around the bodies' centres.
static void box_of(const scree_assembly *assembly, scree_vector low, scree_vector high)
{
    for (int i = 0; i < 3; i++) {
        low[i] = INFINITY;
        high[i] = -INFINITY;
    }
    for (size_t k = 0; k < 3 * assembly->count; k++) {
        low[k % 3] = fmin(low[k % 3], assembly->position[k]);
        high[k % 3] = fmax(high[k % 3], assembly->position[k]);
    }
}

static scree_status write_circles(walk *w, const scree_cell_snapshot *snapshot, scree_error *error)
{
    const scree_assembly *assembly = &snapshot->assembly;
    static const double height[SCREE_CIRCLES] = {1.0 / 8, 1.0 / 2, 7.0 / 8};
    scree_vector low, high, centre;
    box_of(assembly, low, high);
    int axis = assembly->dimension - 1;
    double step = mean_diameter(assembly), mean = scree_cells_mean(&snapshot->cells, snapshot->cells.pressure);
    size_t count = (size_t)fmax(1, fmin(1e4, (high[0] - low[0]) / step));
    double *pressure = NULL, *ratio;
    scree_status status = scree_allocate(&pressure, (2 + SCREE_CIRCLES) * count, sizeof *pressure, error);
    if (status) return status;
    ratio = pressure + 2 * count;
    for (size_t p = 0; p < SCREE_CIRCLES && !status; p++) {
        for (int i = 0; i < 3; i++) centre[i] = (low[i] + high[i]) / 2;
        centre[axis] = low[axis] + height[p] * (high[axis] - low[axis]);
        scree_cells_circles(&snapshot->cells, assembly->position, centre, step, count, pressure, pressure + count);
        for (size_t c = 0; c < count && !status; c++) {
            ratio[p * count + c] = pressure[c] / mean;
            const double row[CIRCLE_COLUMNS] = {
                (double)snapshot->index, snapshot->time,  snapshot->axial_strain, (double)p,
                (double)(c + 1) * step,  (double)(c + 1), pressure[count + c],    pressure[c],
                pressure[c] / mean};
            status = scree_series_append(&w->circles, row, error);
        }
    }
    if (!status) status = scree_cell_averages_add(&w->averages, snapshot, ratio, count, error);
    scree_release(&pressure);
    return status;
}

// ---- bands -------------------------------------------------------------------------------------------------------

static scree_status append_band(walk *w, const scree_cell_snapshot *second, scree_error *error)
{
    const scree_band_window *window = &w->window[w->window_count - 1];
    const scree_localisation *l = &window->localisation;
    const scree_band *b = &l->band;
    const double row[BAND_COLUMNS] = {(double)(w->window_count - 1),
                                      (double)w->first.index,
                                      (double)second->index,
                                      w->first.axial_strain,
                                      second->axial_strain,
                                      l->mean_distortion,
                                      l->index,
                                      l->index_random,
                                      l->significance,
                                      l->localised,
                                      b->found,
                                      b->angle,
                                      b->normal[0],
                                      b->normal[1],
                                      b->normal[2],
                                      b->offset,
                                      b->thickness / w->diameter,
                                      b->volume_fraction,
                                      b->share,
                                      b->contrast,
                                      b->explained,
                                      b->percolation,
                                      window->correlation,
                                      window->overlap};
    return scree_series_append(&w->bands, row, error);
}

static scree_status reserve_window(walk *w, scree_error *error)
{
    if (w->window_count < w->window_capacity) return SCREE_OK;
    size_t capacity = 2 * w->window_capacity + 16;
    scree_status status = scree_reallocate(&w->window, w->window_count, capacity, sizeof *w->window, error);
    if (!status) w->window_capacity = capacity;
    return status;
}

/// The window from w->first to `second`.
static scree_status close_window(walk *w, const scree_cell_snapshot *second, scree_error *error)
{
    size_t bodies = w->first.assembly.count, now = w->window_count % 2;
    double *distortion = NULL;
    scree_status status = reserve_window(w, error);
    for (int k = 0; k < 2 && !status; k++) {
        if (!w->field[k]) status = scree_allocate(&w->field[k], bodies, sizeof *w->field[k], error);
        if (!status && !w->inside[k]) status = scree_allocate(&w->inside[k], bodies, 1, error);
    }
    if (!status)
        status = scree_cells_window_distortion(&w->first.cells, w->first.assembly.position, second->assembly.position,
                                               &distortion, error);
    if (!status) {
        scree_band_window *window = &w->window[w->window_count++];
        w->diameter = mean_diameter(&w->first.assembly);
        status = scree_localisation_measure(&w->first.cells, w->first.assembly.position, distortion, w->diameter,
                                            &window->localisation, w->field[now], w->inside[now], error);
        bool any = w->window_count > 1;
        window->correlation = any ? scree_field_correlation(w->field[0], w->field[1], bodies) : NAN;
        window->overlap = any ? scree_band_overlap(w->inside[0], w->inside[1], bodies) : NAN;
    }
    if (!status) status = append_band(w, second, error);
    scree_release(&distortion);
    return status;
}

/// Hands `snapshot` over to `place`.
static void keep(scree_cell_snapshot *place, scree_cell_snapshot *snapshot)
{
    scree_cell_snapshot_destroy(place);
    *place = *snapshot;
    *snapshot = (scree_cell_snapshot){0};
}

/// `snapshot` is the begin of the next window.
static void begin_window(walk *w, scree_cell_snapshot *snapshot)
{
    keep(&w->first, snapshot);
    scree_cell_snapshot_destroy(&w->last);
}

static scree_status follow(walk *w, scree_cell_snapshot *snapshot, scree_error *error)
{
    bool same = scree_cell_snapshots_agree(&w->first, snapshot) &&
                !scree_snapshot_begins_stage(w->first.stage, snapshot->stage, snapshot->axial_strain);
    if (!same) scree_cell_averages_begin(&w->averages, w->measure, w->series);
    w->dimension = snapshot->assembly.dimension;
    scree_status status = write_circles(w, snapshot, error);
    if (status) return status;
    if (!same) {
        w->window_count = 0;
        begin_window(w, snapshot);
        return SCREE_OK;
    }
    const scree_cell_snapshot *previous = w->last.assembly.count > 0 ? &w->last : &w->first;
    status = scree_cell_averages_strain(&w->averages, previous, snapshot, error);
    // Snapshots lie on samples: a window may miss its length by a little.
    if (snapshot->axial_strain - w->first.axial_strain < 0.99 * w->band_window) {
        if (!status) keep(&w->last, snapshot);
        return status;
    }
    if (!status) status = close_window(w, snapshot, error);
    if (!status) begin_window(w, snapshot);
    return status;
}

// ---- the run -----------------------------------------------------------------------------------------------------

static scree_status open_files(walk *w, const char *directory, scree_error *error)
{
    char path[4096];
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CELLS, error);
    if (!status) status = scree_series_open(&w->circles, path, circle_columns, CIRCLE_COLUMNS, -1, error);
    if (!status) status = scree_path_join(path, sizeof path, directory, SCREE_FILE_BANDS, error);
    if (!status) status = scree_series_open(&w->bands, path, band_columns, BAND_COLUMNS, -1, error);
    return status;
}

static scree_status follow_all(walk *w, const char *directory, scree_error *error)
{
    char path[4096];
    size_t count = 0;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_RUN, error);
    if (!status && access(path, F_OK) == 0) status = scree_snapshot_count(directory, &count, error);
    for (size_t k = 0; k < count && !status; k++) {
        scree_cell_snapshot snapshot;
        status = scree_cell_snapshot_read(directory, k, &snapshot, error);
        if (status == SCREE_ERROR_INPUT) { // without cells
            status = SCREE_OK;
            continue;
        }
        if (!status && isfinite(snapshot.axial_strain)) status = follow(w, &snapshot, error);
        scree_cell_snapshot_destroy(&snapshot);
    }
    return status;
}

static void summarise(const walk *w, scree_summary *summary)
{
    static const char *const kinds[] = {[SCREE_BANDS_NONE] = "none",
                                        [SCREE_BANDS_INTERMITTENT] = "intermittent",
                                        [SCREE_BANDS_PERSISTENT] = "persistent"};
    scree_cell_averages_summarise(&w->averages, w->dimension, summary);
    if (w->window_count == 0) return;
    double persistence;
    scree_band_kind kind = scree_bands_classify(w->window, w->window_count, &persistence);
    const scree_localisation *last = &w->window[w->window_count - 1].localisation;
    bool found = last->band.found;
    scree_summary_set_text(summary, "bands", kinds[kind]);
    scree_summary_set_number(summary, "band_persistence", persistence);
    scree_summary_set_number(summary, "localisation_index_last", last->index);
    scree_summary_set_number(summary, "band_angle", found ? last->band.angle : NAN);
    scree_summary_set_number(summary, "band_thickness_diameters", found ? last->band.thickness / w->diameter : NAN);
    scree_summary_set_number(summary, "band_share", found ? last->band.share : NAN);
    scree_summary_set_number(summary, "band_contrast", found ? last->band.contrast : NAN);
    scree_summary_set_number(summary, "band_percolation", found ? last->band.percolation : NAN);
}

scree_status scree_cell_results_write(const char *directory, const scree_config_measure *measure, double band_window,
                                      const scree_series *series, scree_summary *summary, scree_error *error)
{
    walk w = {.measure = measure, .band_window = band_window, .series = series};
    scree_status status = open_files(&w, directory, error);
    if (!status) status = follow_all(&w, directory, error);
    if (!status) summarise(&w, summary);
    scree_error second;
    scree_status closed = scree_series_close(&w.circles, status ? &second : error);
    if (!status) status = closed;
    closed = scree_series_close(&w.bands, status ? &second : error);
    if (!status) status = closed;
    scree_cell_snapshot_destroy(&w.first);
    scree_cell_snapshot_destroy(&w.last);
    scree_release(&w.window);
    for (int k = 0; k < 2; k++) {
        scree_release(&w.field[k]);
        scree_release(&w.inside[k]);
    }
    return status;
}

// ---- the module --------------------------------------------------------------------------------------------------

/// Its keys, and its numbers.
typedef struct config {
    double band_window; ///< 1
} config;

static const scree_key keys[] = {
    NUMBER(config, band_window, "1", .standard = "1 %", ABOVE("0 %"), TO("90 %"), .when = "cells=yes",
           .meaning = "Shear bands are looked for between snapshots at least this far apart in axial strain."),
};

static scree_status resolve(scree_model *model, scree_error *error)
{
    (void)error;
    return scree_model_keep_measure_keys(model, SCREE_SLOT_cells);
}

static const scree_result results[] = {
    {"cell_stress_disagreement", "1", "stress of the cells against that of the contacts"},
    {"cell_strain_disagreement", "1", "strain of the cells against that of the boundary"},
    {"cell_volumetric_strain", "1", "sum of the volumetric strains of the cells from snapshot to snapshot"},
    {"cell_volumetric_strain_renewed", "1", "what new cells at each snapshot change in the volume"},
    {"cell_volumetric_strain_enclosed", "1", "volume of the cells of the last snapshot against the first"},
    {"circle_pressure_spread", "1", "spread of the pressure over circles"},
    {"circle_pressure_spread_wide", "1", "the same over circles from 4 mean diameters on"},
    {"circle_pressure_diameter", "1", "diameter from which on circles have the mean pressure, in mean diameters"},
    {"plate_distortion_ratio", "1", "distortion rate near the plates over that of the core"},
    {"plate_pressure_ratio", "1", "pressure near the plates over that of the core"},
    {"side_pressure_ratio", "1", "pressure near the sides over that of the core"},
    {"plate_strong_share", "1", "share of the volume near the plates above 1.75 times the mean pressure"},
    {"side_strong_share", "1", "share of the volume near the sides above it"},
    {"core_strong_share", "1", "share of the core above it"},
    {"plate_deformed_share", "1", "share of the volume near the plates above twice the mean rate of distortion"},
    {"core_deformed_share", "1", "share of the core above it"},
    {"bands", NULL, "kind of localisation"},
    {"band_persistence", "1", "persistence of the bands"},
    {"localisation_index_last", "1", "localisation index of the last window"},
    {"band_angle", "degree", "angle of the band"},
    {"band_thickness_diameters", "1", "thickness of the band in mean diameters"},
    {"band_share", "1", "share of the band in the distortion"},
    {"band_contrast", "1", "distortion within the band over that outside"},
    {"band_percolation", "1", "how far the band goes through the sample"},
};

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_model *model = &run->s->model;
    if (!model->measure.cells || model->periodic) return SCREE_OK;
    const config *own = scree_model_numbers(model, SCREE_SLOT_cells);
    return scree_cell_results_write(run->directory, &model->measure, own->band_window, run->series, run->summary,
                                    error);
}

const scree_module scree_module_cells = {
    .name = "cells",
    .meaning = "Delaunay cells of the snapshots: their averages, and shear bands",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .numbers_size = sizeof(config),
    .resolve = resolve,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
