/// Scenes through Cairo, drawn for paper: discs coloured by a field with a colour bar, force network with line widths,
/// displacement fluctuations as arrows, fields of the Delaunay cells, shear bands, Delaunay boundary, plates. Each
/// writes NAME.svg and NAME.png.
#ifndef SCREE_VIEW_SCENE_H
#define SCREE_VIEW_SCENE_H

#include "io/snapshot.h"
#include "view/scene_content.h"

/// What `axial_strain` of a snapshot is called: the largest shear of a periodic cell may be meant.
const char *scree_strain_name(bool of_cell);

/// A frame that no scene has widened yet.
scree_scene_frame scree_scene_frame_begin(void);

/// path without extension; a scene in a frame is written as PNG alone. Discs without a finite position or a positive
/// radius are left out, and counted in the caption. Errors: no disc to draw (SCREE_ERROR_INPUT), disk, memory.
scree_status scree_scene_draw(const char *path, const scree_snapshot *snapshot, const scree_scene *scene,
                              scree_error *error) SCREE_MUST_USE;

#endif
