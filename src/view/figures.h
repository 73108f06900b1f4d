/// What a figure of a run is: one row of its family's table, and a family one row of the table in figures.c. The driver
/// (plot.c) knows no figure by name. Private to src/view/.
#ifndef SCREE_VIEW_FIGURES_H
#define SCREE_VIEW_FIGURES_H

#include "base/error.h"
#include "case/config.h"

#include <limits.h>
#include <stdbool.h>

struct scree_plot_run;

/// Of which runs a figure is drawn that nobody has asked for by its name: few figures are read.
typedef enum scree_figure_use {
    SCREE_USUAL,           ///< of all that have it; of a figure of strain windows that of the last one
    SCREE_ON_REQUEST,      ///< of none
    SCREE_WITH_LOADING,    ///< of those with a loading stage
    SCREE_WITHOUT_LOADING, ///< of those without a loading stage
    SCREE_OF_PATHS         ///< of those with several loading stages, or whose loading turns back
} scree_figure_use;

typedef struct scree_figure {
    const char *name;    ///< stem of its files; of a figure of strain windows the beginning of it
    const char *meaning; ///< one line for `scree plot --list`
    scree_figure_use use;
} scree_figure;

enum { SCREE_FIGURE_NAME = 64 };

struct scree_figure_family;

/// One figure of one run.
typedef struct scree_figure_job {
    const struct scree_figure_family *family;
    const scree_figure *figure;        ///< first member of the row of the family's table
    const scree_config_window *window; ///< NULL: the figure is not of a strain window
    char name[SCREE_FIGURE_NAME];      ///< stem of its files
    char path[PATH_MAX];               ///< the same with its folder, without an ending
} scree_figure_job;

/// Figures that are made in the same way, and differ in a row of their table.
typedef struct scree_figure_family {
    const void *row; ///< structs that begin with a scree_figure
    size_t count, size;
    bool of_windows; ///< each figure is drawn once a strain window, as NAME-FROM-TO
    /// Whether runs of this kind have the figure at all; of others nothing is told. NULL: all have.
    bool (*meant)(const struct scree_plot_run *run, const scree_figure *figure);
    /// SCREE_ERROR_INPUT: the run lacks a column, snapshot, table or result that the figure needs; the message says
    /// which. Cheap: nothing that is large is read.
    scree_status (*applies)(const struct scree_plot_run *run, const scree_figure_job *job, scree_error *error);
    /// Writes the files of the figure. SCREE_ERROR_INPUT as above, for what only shows in reading.
    scree_status (*draw)(const struct scree_plot_run *run, const scree_figure_job *job, scree_error *error);
} scree_figure_family;

/// The members row, count and size of a family from its table.
#define SCREE_FIGURE_ROWS(table) .row = (table), .count = sizeof(table) / sizeof *(table), .size = sizeof *(table)

/// The table, ended by NULL; figures are drawn and listed in its order.
extern const scree_figure_family *const scree_figure_families[];

#endif
