/// What the charts and the scenes of a run share. Private to src/view/.
#ifndef SCREE_VIEW_PLOT_PARTS_H
#define SCREE_VIEW_PLOT_PARTS_H

#include "case/config.h"
#include "io/loading_stage.h"
#include "io/snapshot.h"

#include <limits.h>
#include <stdbool.h>

typedef struct scree_plot_run {
    const char *directory;
    char figures[PATH_MAX]; ///< folder that the figures go to
    void (*message)(void *user, const char *line);
    void *user;
    scree_series series;     ///< no column when it could not be read
    size_t first_row, row_count; ///< rows of the loading stage
    double *strain;          ///< axial strain of each snapshot of the loading stage, NAN of the others
    bool of_cell;            ///< the sample was loaded as a cell that is periodic in all directions
    size_t snapshot_count;
    scree_config_window *window; ///< axial strains of the displacement fluctuations
    size_t window_count;
    scree_status status; ///< of the first figure that failed; the others are drawn all the same
    scree_error error;
} scree_plot_run;

/// Tells that the figure `name` was drawn, was left out (SCREE_ERROR_INPUT: the run does not have what it shows), or
/// failed.
void scree_plot_report(scree_plot_run *run, const char *name, scree_status status, const scree_error *error);

/// Draws all charts from run->series, and all scenes from the snapshots.
void scree_plot_charts(scree_plot_run *run);
void scree_plot_scenes(scree_plot_run *run);
/// Draws the figures of a stage rotate_particle, when the run has had one.
void scree_plot_rotation(scree_plot_run *run);

typedef enum scree_cell_field { SCREE_CELL_NONE, SCREE_CELL_DISTORTION_RATE, SCREE_CELL_PRESSURE } scree_cell_field;

/// A map of the cells of a snapshot.
typedef struct scree_cell_map {
    const char *name, *title;
    scree_cell_field field;
    double threshold; ///< shaded above so many times the mean; 0: coloured
} scree_cell_map;

/// Draws one figure of the cells (plot_cells.c). `which`, `first`, `second` number the snapshots of the run; the discs
/// of `snapshot` and `from` are those. Errors: SCREE_ERROR_INPUT: the snapshots have no cells.
scree_status scree_plot_cell_map(const scree_plot_run *run, const scree_snapshot *snapshot, size_t which,
                                 const scree_cell_map *map, scree_error *error) SCREE_MUST_USE;
scree_status scree_plot_distortion(const scree_plot_run *run, const scree_snapshot *from, size_t first, size_t second,
                                   const char *name, const char *title, scree_error *error) SCREE_MUST_USE;
scree_status scree_plot_circles(const scree_plot_run *run, size_t which, const char *name,
                                scree_error *error) SCREE_MUST_USE;

#endif
