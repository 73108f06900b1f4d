/// A scene that the user asks for, alone (plot_field.c) or in a row (plot_movie.c). Private to src/view/.
#ifndef SCREE_VIEW_PLOT_FIELD_H
#define SCREE_VIEW_PLOT_FIELD_H

#include "io/sample_file.h"
#include "view/plot_parts.h"

#include <scree/scree.h>

/// What a field is made of: `now` and, of fields that compare, `start`.
typedef void scree_field_values(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value);

typedef struct scree_field_row {
    const char *name, *meaning, *unit; ///< "@" stands for the SI prefix that suits the values
    scree_colour_map map;
    scree_field_values *values; ///< NULL: the force network
    int axis, dimension;        ///< of the run that has it; 0: any
    bool compares;
} scree_field_row;

typedef struct scree_asked_scene {
    const scree_plot_scene *scene;
    scree_plot_run run; ///< folder and strains of the snapshots are there
    scree_snapshot_mark *mark;
    size_t which, start_at; ///< places of the snapshots
    const scree_field_row *row;
    scree_snapshot start, now;
    double *value;
    char label[200];
    scree_scene_frame *frame; ///< NULL: the scene stands alone
} scree_asked_scene;

/// Finds the snapshots of the run, and the one that is asked for. Close *asked in any case.
scree_status scree_asked_open(scree_asked_scene *asked, const char *directory, scree_error *error);
void scree_asked_close(scree_asked_scene *asked);

/// Reads snapshot `asked->which` and the values of the field, in SI units. What was read before is given back.
scree_status scree_asked_read(scree_asked_scene *asked, scree_error *error);

/// Names the field with the unit that suits values up to `largest`; the factor that goes with it.
double scree_asked_name(scree_asked_scene *asked, double largest);

/// Draws it, values times `factor`; path without extension.
scree_status scree_asked_draw(scree_asked_scene *asked, double factor, const char *path, scree_error *error);

#endif
