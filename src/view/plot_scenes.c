/// The scenes of a run: single snapshots, and displacements between two of them.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "measure/measure.h"
#include "view/projection.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Axial strain, as in run/results.c.

enum { WHEN_START, WHEN_PEAK, WHEN_WINDOW, WHEN_END }; // WHEN_WINDOW: in the middle of the first strain window
enum { FIELD_NONE, FIELD_ROTATION, FIELD_SPIN, FIELD_SPIN_MAGNITUDE, FIELD_SPEED, FIELD_DISPLACEMENT };
enum { VIEW_PLANE, VIEW_SPACE, VIEW_SECTION }; // VIEW_PLANE is for discs and for cells, the others for spheres

static const struct field_entry {
    const char *label;
    scree_colour_map map;
} fields[] = {
    [FIELD_ROTATION] = {"rotation since the start of loading (degrees), counter-clockwise positive",
                        SCREE_COLOUR_DIVERGING},
    [FIELD_SPIN] = {"spin (rad/s), counter-clockwise positive", SCREE_COLOUR_DIVERGING},
    [FIELD_SPIN_MAGNITUDE] = {"spin, magnitude (rad/s)", SCREE_COLOUR_SEQUENTIAL},
    [FIELD_SPEED] = {"speed (mm/s)", SCREE_COLOUR_SEQUENTIAL},
    [FIELD_DISPLACEMENT] = {"displacement since the start of loading (mm)", SCREE_COLOUR_SEQUENTIAL},
};

static const struct scene_entry {
    const char *name, *title;
    int when, field;
    bool force_network, boundary;
    int view;
    scree_cell_field cells;
    double threshold; ///< cells are shaded above so many times the mean; 0: coloured
} scenes[] = {
    {"packing-start", "Packing at the start of loading", WHEN_START, .boundary = true},
    {"packing-end", "Packing at the end: rotations", WHEN_END, .field = FIELD_ROTATION, .boundary = true},
    {"forces-peak", "Force network at the peak of the stress ratio", WHEN_PEAK, .force_network = true},
    {"forces-end", "Force network at the end", WHEN_END, .force_network = true},
    {"speed-end", "Speed at the end", WHEN_END, .field = FIELD_SPEED},
    {"spin-end", "Spin at the end", WHEN_END, .field = FIELD_SPIN},
    {"distortion-rate-peak", "Rate of distortion at the peak of the stress ratio", WHEN_PEAK,
     .cells = SCREE_CELL_DISTORTION_RATE, .threshold = 2},
    {"distortion-rate-window", "Rate of distortion in the first strain window", WHEN_WINDOW,
     .cells = SCREE_CELL_DISTORTION_RATE, .threshold = 2},
    {"distortion-rate-end", "Rate of distortion at the end", WHEN_END, .cells = SCREE_CELL_DISTORTION_RATE,
     .threshold = 2},
    {"distortion-rate-colour-end", "Rate of distortion at the end", WHEN_END, .cells = SCREE_CELL_DISTORTION_RATE},
    {"pressure-peak", "Pressure at the peak of the stress ratio", WHEN_PEAK, .cells = SCREE_CELL_PRESSURE,
     .threshold = 1.75},
    {"pressure-window", "Pressure in the first strain window", WHEN_WINDOW, .cells = SCREE_CELL_PRESSURE,
     .threshold = 1.75},
    {"pressure-end", "Pressure at the end", WHEN_END, .cells = SCREE_CELL_PRESSURE, .threshold = 1.75},
    {"pressure-colour-end", "Pressure at the end", WHEN_END, .cells = SCREE_CELL_PRESSURE},
    {"packing-start", "Packing at the start of loading", WHEN_START, .view = VIEW_SPACE},
    {"packing-end", "Packing at the end: displacements", WHEN_END, .field = FIELD_DISPLACEMENT, .view = VIEW_SPACE},
    {"section-end", "Section at the end: displacements", WHEN_END, .field = FIELD_DISPLACEMENT, .view = VIEW_SECTION},
    {"spin-section-end", "Section at the end: spin", WHEN_END, .field = FIELD_SPIN_MAGNITUDE, .view = VIEW_SECTION},
    {"forces-end", "Force network at the end", WHEN_END, .force_network = true, .view = VIEW_SPACE},
};

/// First, or last, snapshot of the loading stage; of all when nothing was loaded.
static size_t end_snapshot(const scree_plot_run *run, bool last)
{
    for (size_t k = 0; k < run->snapshot_count; k++) {
        size_t which = last ? run->snapshot_count - 1 - k : k;
        if (isfinite(run->strain[which])) return which;
    }
    return last ? run->snapshot_count - 1 : 0;
}

static size_t nearest_snapshot(const scree_plot_run *run, double strain)
{
    size_t best = end_snapshot(run, false);
    for (size_t k = 0; k < run->snapshot_count; k++)
        if (fabs(run->strain[k] - strain) < fabs(run->strain[best] - strain)) best = k;
    return best;
}

static scree_status find_snapshot(const scree_plot_run *run, int when, size_t *which, scree_error *error)
{
    *which = end_snapshot(run, when == WHEN_END);
    if (when == WHEN_WINDOW && run->window_count > 0)
        *which = nearest_snapshot(run, 0.5 * (run->window[0].from + run->window[0].to));
    if (when != WHEN_PEAK) return SCREE_OK;
    const double *strain = scree_series_get(&run->series, "axial_strain");
    const double *ratio = scree_series_get(&run->series, "stress_ratio");
    scree_peak peak = {NAN, NAN};
    const scree_loading_rows rows = {run->first_row, run->first_row + run->row_count};
    if (strain && ratio) peak = scree_peak_find(ratio, strain, rows);
    *which = nearest_snapshot(run, peak.strain);
    if (isfinite(peak.value)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no stress ratio to find the peak of", SCREE_FILE_SERIES);
}

static double displacement(const scree_snapshot *start, const scree_snapshot *now, size_t k)
{
    double z = now->z ? now->z[k] - start->z[k] : 0;
    return sqrt(pow(now->x[k] - start->x[k], 2) + pow(now->y[k] - start->y[k], 2) + z * z);
}

static double field_value(int field, const scree_snapshot *start, const scree_snapshot *now, size_t k)
{
    switch (field) {
    case FIELD_ROTATION:
        return (now->angle[k] - start->angle[k]) * 180 / M_PI;
    case FIELD_SPIN:
    case FIELD_SPIN_MAGNITUDE:
        return now->spin[k];
    case FIELD_DISPLACEMENT:
        return 1e3 * displacement(start, now, k);
    default:
        return 1e3 * sqrt(now->vx[k] * now->vx[k] + now->vy[k] * now->vy[k] + (now->vz ? now->vz[k] * now->vz[k] : 0));
    }
}

/// Draws what the entry says of spheres: from outside, or cut.
static scree_status draw_in_space(const char *path, const scree_snapshot *now, int view, scree_scene *scene,
                                  scree_error *error)
{
    if (view == VIEW_SECTION) {
        scree_snapshot plane;
        scree_status status = scree_section_create(now, &plane, error);
        if (status) return status;
        scene->section = true;
        status = scree_scene_draw(path, &plane, scene, error);
        scree_snapshot_destroy(&plane);
        return status;
    }
    scree_projection projection;
    scree_status status = scree_projection_create(now, &projection, error);
    if (status) return status;
    scene->depth = projection.depth;
    scene->projection = &projection;
    status = scree_scene_draw(path, &projection.plane, scene, error);
    scree_projection_destroy(&projection);
    return status;
}

static scree_status draw_scene(const scree_plot_run *run, const struct scene_entry *entry, const scree_snapshot *start,
                               const scree_snapshot *now, scree_error *error)
{
    char path[PATH_MAX];
    double *field = NULL;
    scree_status status = scree_path_join(path, sizeof path, run->figures, entry->name, error);
    if (!status && entry->field != FIELD_NONE) status = scree_allocate(&field, now->count, sizeof *field, error);
    for (size_t k = 0; field && k < now->count; k++) field[k] = field_value(entry->field, start, now, k);
    scree_scene scene = {.title = entry->title,
                         .field = field,
                         .field_name = fields[entry->field].label,
                         .map = fields[entry->field].map,
                         .force_network = entry->force_network,
                         .boundary = entry->boundary,
                         .of_cell = run->of_cell,
                         .plates = true};
    if (!status)
        status = entry->view == VIEW_PLANE ? scree_scene_draw(path, now, &scene, error)
                                           : draw_in_space(path, now, entry->view, &scene, error);
    scree_release(&field);
    return status;
}

/// Reads two snapshots of the same bodies. Neither is left behind on failure.
static scree_status read_two(const scree_plot_run *run, size_t first, size_t second, scree_snapshot *a,
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

/// Strain as text of a file name or a title: whole percents where it is one.
static void percent_text(char *text, size_t size, double strain, bool name)
{
    double percent = 100 * strain;
    bool whole = fabs(percent - round(percent)) < 0.05;
    if (whole) percent = round(percent) + 0.0; // no minus zero
    (void)snprintf(text, size, "%0*.*f", !name ? 0 : whole ? 2 : 4, whole ? 0 : 1, percent);
}

/// Fluctuations of the grains, one component after the other.
static scree_status find_fluctuations(const scree_snapshot *from, const scree_snapshot *to, double *value,
                                      scree_error *error)
{
    const int n = from->dimension;
    const size_t count = from->count;
    const double *const begin[] = {from->x, from->y, from->z}, *const end[] = {to->x, to->y, to->z};
    double *const fluctuation[] = {value, value + count, value + 2 * count};
    if (from->periodic.directions == (1u << n) - 1) {
        (void)scree_periodic_fluctuations(&from->periodic, &to->periodic, n, begin, end, count, fluctuation);
        return SCREE_OK;
    }
    // The grains one behind the other, without the bodies of a membrane between them.
    double *room = NULL, *column[9], gradient[9];
    scree_status status = scree_allocate(&room, 9 * count, sizeof *room, error);
    if (status) return status;
    for (int c = 0; c < 9; c++) column[c] = room + (size_t)c * count;
    size_t grains = 0;
    for (size_t k = 0; k < count; k++) {
        if (!scree_snapshot_is_grain(from, k)) continue;
        for (int i = 0; i < n; i++) {
            column[i][grains] = begin[i][k];
            column[3 + i][grains] = end[i][k];
        }
        grains++;
    }
    (void)scree_fluctuations(n, (const double *const *)column, (const double *const *)(column + 3), grains, column + 6,
                             gradient);
    grains = 0;
    for (size_t k = 0; k < count; k++) {
        if (!scree_snapshot_is_grain(from, k)) continue;
        for (int i = 0; i < n; i++) fluctuation[i][k] = column[6 + i][grains];
        grains++;
    }
    scree_release(&room);
    return SCREE_OK;
}

static scree_status draw_fluctuations(const scree_plot_run *run, const scree_snapshot *from, const scree_snapshot *to,
                                      const char *name, scree_error *error)
{
    char path[PATH_MAX], first[16], second[16], title[160];
    double *arrow = NULL;
    const size_t count = from->count;
    const bool in_3d = from->dimension == 3;
    percent_text(first, sizeof first, from->axial_strain, false);
    percent_text(second, sizeof second, to->axial_strain, false);
    (void)snprintf(title, sizeof title, "Displacements relative to the affine field, %s %s to %s %%",
                   scree_strain_name(run->of_cell), first, second);
    scree_status status = scree_path_join(path, sizeof path, run->figures, name, error);
    if (!status) status = scree_allocate(&arrow, (size_t)from->dimension * count, sizeof *arrow, error);
    if (!status) {
        status = find_fluctuations(from, to, arrow, error);
        scree_scene scene = {.title = title,
                             .arrow_x = arrow,
                             .arrow_y = arrow + (in_3d ? 2 : 1) * count,
                             .of_cell = run->of_cell,
                             .plates = true};
        if (!status)
            status = in_3d ? draw_in_space(path, from, VIEW_SECTION, &scene, error)
                           : scree_scene_draw(path, from, &scene, error);
    }
    scree_release(&arrow);
    return status;
}

/// The same window seen by the cells: what fluctuations show as shear between blocks is distortion here.
static void plot_distortion(scree_plot_run *run, const scree_snapshot *from, const scree_snapshot *to, size_t first,
                            size_t second, const char *window)
{
    char name[64], begin[16], end[16], title[160];
    scree_error error = {0};
    percent_text(begin, sizeof begin, from->axial_strain, false);
    percent_text(end, sizeof end, to->axial_strain, false);
    (void)snprintf(name, sizeof name, "distortion-%s", window);
    (void)snprintf(title, sizeof title, "Distortion, %s %s to %s %%", scree_strain_name(run->of_cell), begin, end);
    scree_plot_report(run, name, scree_plot_distortion(run, from, first, second, name, title, &error), &error);
}

/// Files are named after the window that was asked for; titles tell the strains of the snapshots next to it.
static void plot_window(scree_plot_run *run, double from, double to)
{
    scree_snapshot a, b;
    scree_error error = {0};
    char name[64], window[40], begin[16], end[16];
    percent_text(begin, sizeof begin, from, true);
    percent_text(end, sizeof end, to, true);
    (void)snprintf(window, sizeof window, "%s-%s", begin, end);
    (void)snprintf(name, sizeof name, "fluctuations-%s", window);
    size_t first = nearest_snapshot(run, from), second = nearest_snapshot(run, to);
    scree_status status;
    if (first == second || !isfinite(run->strain[first]) || !isfinite(run->strain[second])) {
        status = scree_error_set(&error, SCREE_ERROR_INPUT, "too few snapshots of loading for this strain window");
    } else {
        status = read_two(run, first, second, &a, &b, &error);
        if (!status) {
            status = draw_fluctuations(run, &a, &b, name, &error);
            plot_distortion(run, &a, &b, first, second, window);
            scree_snapshot_destroy(&a);
            scree_snapshot_destroy(&b);
        }
    }
    scree_plot_report(run, name, status, &error);
}

void scree_plot_scenes(scree_plot_run *run)
{
    if (run->snapshot_count == 0) return;
    size_t start = end_snapshot(run, false);
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        scree_snapshot first, now;
        scree_error error = {0};
        size_t which;
        scree_status status = find_snapshot(run, scenes[k].when, &which, &error);
        if (!status) status = read_two(run, start, which, &first, &now, &error);
        if (!status) {
            const scree_cell_map map = {scenes[k].name, scenes[k].title, scenes[k].cells, scenes[k].threshold};
            bool meant = map.field || (scenes[k].view == VIEW_PLANE) == (now.dimension == 2);
            if (meant)
                status = map.field ? scree_plot_cell_map(run, &now, which, &map, &error)
                                   : draw_scene(run, &scenes[k], &first, &now, &error);
            scree_snapshot_destroy(&first);
            scree_snapshot_destroy(&now);
            if (!meant) continue;
        }
        scree_plot_report(run, scenes[k].name, status, &error);
    }
    for (size_t k = 0; k < run->window_count; k++) plot_window(run, run->window[k].from, run->window[k].to);
    scree_error error = {0};
    size_t which;
    scree_status status = find_snapshot(run, WHEN_WINDOW, &which, &error);
    if (!status) status = scree_plot_circles(run, which, "pressure-circles", &error);
    scree_plot_report(run, "pressure-circles", status, &error);
}
