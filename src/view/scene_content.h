/// What a scene shows (scene.h draws it).
#ifndef SCREE_VIEW_SCENE_CONTENT_H
#define SCREE_VIEW_SCENE_CONTENT_H

#include "measure/localisation.h"
#include "view/colour.h"

#include <stdbool.h>

/// What the frames of a movie share. Begun with scree_scene_frame_begin; until it is `whole`, scenes that have it are
/// not drawn: they widen it.
typedef struct scree_scene_frame {
    double low[2], high[2]; ///< m, corners of what is drawn
    double limits[2];       ///< that the colours span
    double mean_force;      ///< N, the largest
    double width, height;   ///< pt, of the page, from the first scene that is drawn; 0: none was
    bool whole;
} scree_scene_frame;

typedef struct scree_scene {
    const char *title;
    const double *field;    ///< per disc, NULL: plain discs; discs where it is not finite are grey
    const char *field_name; ///< label of the colour bar with unit, e.g. "rotation (degrees)"
    scree_colour_map map;   ///< diverging: limits symmetric about zero
    bool force_network;     ///< contacts as lines, width by normal force
    bool boundary;          ///< Delaunay boundary loop
    bool plates;
    bool of_cell;                    ///< the strain in the caption is that of a periodic cell
    const double *arrow_x, *arrow_y; ///< per disc, m; NULL: none
    const double *shown;             ///< m, from x to x: what lies beyond is left out, and told; NULL: all is shown
    bool section;                    ///< discs are cuts of spheres; those that are not cut are not missed
    const double *depth;             ///< per disc, m towards the viewer: discs are spheres, far ones first; NULL: flat
    const struct scree_projection *projection; ///< where the plates of a view in space lie; NULL: flat
    double arrow_scale;                        ///< drawn length over true length; 0: chosen, and told in the figure
    bool arrows_have_no_size;                  ///< their lengths compare with one another only: nothing is told
    const scree_cells *cells;                  ///< Delaunay cells of a plane sample, in place of the discs; NULL: none
    const double *cell_place;                  ///< m, bodies x 3
    const double *cell_field;                  ///< per cell, >= 0; labelled with field_name
    const size_t *marked;                      ///< disc that is drawn black, whatever its field; NULL: none
    const char *marked_name;                   ///< what the legend calls it
    scree_scene_frame *frame;                  ///< NULL: the page is for this scene alone
    double cell_threshold;  ///< > 0: cells above so many times the mean are shaded; 0: coloured by `map`
    const scree_band *band; ///< its edges as lines; NULL: none
} scree_scene;

#endif
