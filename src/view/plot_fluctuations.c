/// Displacements of the strain windows of a run relative to the affine field.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "measure/measure.h"
#include "view/projection.h"
#include "view/scene.h"

#include <stdio.h>

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

/// Files are named after the window that was asked for; titles tell the strains of the snapshots next to it.
static scree_status draw_between(const scree_plot_run *run, const scree_snapshot *from, const scree_snapshot *to,
                                 const char *path, scree_error *error)
{
    char first[16], second[16], title[160];
    double *arrow = NULL;
    const size_t count = from->count;
    const bool in_3d = from->dimension == 3;
    scree_plot_percent(first, sizeof first, from->axial_strain, false);
    scree_plot_percent(second, sizeof second, to->axial_strain, false);
    (void)snprintf(title, sizeof title, "Displacements relative to the affine field, %s %s to %s %%",
                   scree_strain_name(run->of_cell), first, second);
    scree_status status = scree_allocate(&arrow, (size_t)from->dimension * count, sizeof *arrow, error);
    if (!status) {
        status = find_fluctuations(from, to, arrow, error);
        scree_scene scene = {.title = title,
                             .arrow_x = arrow,
                             .arrow_y = arrow + (in_3d ? 2 : 1) * count,
                             .of_cell = run->of_cell,
                             .plates = true};
        if (!status)
            status =
                in_3d ? scree_plot_section(path, from, &scene, error) : scree_scene_draw(path, from, &scene, error);
    }
    scree_release(&arrow);
    return status;
}

static scree_status has_window(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t first, second;
    return scree_plot_find_window(run, job->window, &first, &second, error);
}

static scree_status draw_fluctuations(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_snapshot a, b;
    size_t first, second;
    scree_status status = scree_plot_find_window(run, job->window, &first, &second, error);
    if (!status) status = scree_plot_read_two(run, first, second, &a, &b, error);
    if (status) return status;
    status = draw_between(run, &a, &b, job->path, error);
    scree_snapshot_destroy(&a);
    scree_snapshot_destroy(&b);
    return status;
}

static const scree_figure rows[] = {
    {"fluctuations", "displacements in a strain window, relative to the affine field", SCREE_USUAL},
};

const scree_figure_family scree_figures_fluctuations = {
    SCREE_FIGURE_ROWS(rows), .of_windows = true,        .meant = scree_plot_has_snapshot,
    .applies = has_window,   .draw = draw_fluctuations,
};
