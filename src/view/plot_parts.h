/// What the figures of a run share: the run as they see it, and its snapshots. Private to src/view/.
#ifndef SCREE_VIEW_PLOT_PARTS_H
#define SCREE_VIEW_PLOT_PARTS_H

#include "case/config.h"
#include "io/folder_lock.h"
#include "io/loading_stage.h"
#include "io/snapshot.h"
#include "view/figures.h"
#include "view/scene.h"

#include <limits.h>
#include <stdbool.h>

typedef struct scree_plot_run {
    const char *directory;
    char figures[PATH_MAX];                      ///< folder that the figures go to
    scree_series series;                         ///< no column when it could not be read
    scree_status series_status, snapshot_status; ///< of reading series.csv, and the snapshots of run.h5
    scree_error series_error, snapshot_error;
    size_t first_row, row_count; ///< rows of the loading stage
    scree_loading_path path;     ///< of all loading stages
    bool winding;                ///< others were loaded before it, or its axial strain turns back
    double *strain;              ///< axial strain of each snapshot of the loading stage, NAN of the others
    bool of_cell;                ///< the sample was loaded as a cell that is periodic in all directions
    int dimension;               ///< of the last snapshot
    bool sizes_vary;             ///< not all particles of the case have one radius
    size_t snapshot_count;
    scree_config_window *window; ///< axial strains of the displacement fluctuations
    size_t window_count;
} scree_plot_run;

/// Reads what there is of the run. SCREE_ERROR_IO: there is none; memory. Close *run in any case.
scree_status scree_plot_run_open(scree_plot_run *run, const char *directory, scree_error *error) SCREE_MUST_USE;
void scree_plot_run_close(scree_plot_run *run);

/// Tells `message`, which may be NULL, a warning of a missing font.
void scree_plot_warn(void (*message)(void *user, const char *line), void *user);

/// Makes the folder of the figures; run->figures leaves room for the name of one behind it.
scree_status scree_plot_make_folder(scree_plot_run *run, scree_error *error) SCREE_MUST_USE;
/// Keeps others from writing into the run. Without a folder there is no run, and reading says so.
scree_status scree_plot_lock(scree_folder_lock *taken, const char *directory, scree_error *error) SCREE_MUST_USE;

/// Which snapshot a figure shows. WINDOW: in the middle of the first strain window.
typedef enum scree_plot_when { SCREE_AT_START, SCREE_AT_PEAK, SCREE_AT_WINDOW, SCREE_AT_END } scree_plot_when;

/// First, or last, snapshot of the loading stage; of all when nothing was loaded. There has to be one.
size_t scree_plot_end_snapshot(const scree_plot_run *run, bool last);
/// SCREE_ERROR_INPUT: there is no stress ratio to find the peak of.
scree_status scree_plot_find_snapshot(const scree_plot_run *run, scree_plot_when when, size_t *which,
                                      scree_error *error) SCREE_MUST_USE;
/// The snapshots next to both ends of a strain window. SCREE_ERROR_INPUT: they are not two of the loading.
scree_status scree_plot_find_window(const scree_plot_run *run, const scree_config_window *window, size_t *first,
                                    size_t *second, scree_error *error) SCREE_MUST_USE;
/// Reads two snapshots of the same bodies. Neither is left behind on failure.
scree_status scree_plot_read_two(const scree_plot_run *run, size_t first, size_t second, scree_snapshot *a,
                                 scree_snapshot *b, scree_error *error) SCREE_MUST_USE;

/// Draws spheres where a plane cuts them.
scree_status scree_plot_section(const char *path, const scree_snapshot *now, scree_scene *scene,
                                scree_error *error) SCREE_MUST_USE;

/// Draws spheres from outside.
scree_status scree_plot_space(const char *path, const scree_snapshot *now, scree_scene *scene,
                              scree_error *error) SCREE_MUST_USE;
/// Without a loading stage the start is the end of the preparation, whose plates need not stay: only those that stand
/// in the next snapshot, too, are left.
scree_status scree_plot_keep_standing(const scree_plot_run *run, size_t which, scree_snapshot *now,
                                      scree_error *error) SCREE_MUST_USE;

/// Writes the label of an axis, "stress (@Pa)", with the SI prefix for values up to `largest` in place of the "@".
/// Returns the factor that goes with it.
double scree_plot_label(char *label, size_t size, const char *pattern, double largest);
/// Largest finite magnitude; 1 when all are nothing.
double scree_plot_largest(const double *value, size_t count);

/// A number of summary.json; NAN: it is not there.
double scree_plot_result(const scree_plot_run *run, const char *name);

/// The part of the pile at the end of the run that its figures show [m]: its heap and a tenth of that at both sides.
/// False: there is no pile.
bool scree_plot_heap(const scree_plot_run *run, double ends[2]);

/// Strain as text of a file name or a title: whole percents where it is one.
void scree_plot_percent(char *text, size_t size, double strain, bool name);

/// For scree_figure_family.meant: the run has a snapshot.
bool scree_plot_has_snapshot(const scree_plot_run *run, const scree_figure *figure);

#endif
