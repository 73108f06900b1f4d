/// Maps: a field on a grid as coloured rectangles, with axes, a colour bar, and where there are some lines on top.
/// NAME.svg and NAME.png. (Arrows are drawn on grains: view/displacements.h.)
#ifndef SCREE_VIEW_MAP_H
#define SCREE_VIEW_MAP_H

#include "view/colour.h"
#include "view/scale.h"

typedef struct scree_map {
    const char *title, *name; ///< above; of the field, with its unit
    size_t columns, rows;
    double low[2], high[2];   ///< m, corners of what the rectangles fill
    const double *value;      ///< columns x rows, along a row first, the lowest row first; NAN: left white
    scree_colour_map colours; ///< diverging: of values of one sign a sequential one all the same, strong far from zero
    const double *axis;   ///< NULL, or an angle [rad] a rectangle, drawn as a short line; NAN: none. of large maps one
                          ///< for several rectangles, longer by as much
    const double *length; ///< NULL, or of this line, 0 to 1
} scree_map;

/// path without extension. Errors: no value to draw (SCREE_ERROR_INPUT); disk, memory.
scree_status scree_map_draw(const char *path, const scree_map *map, scree_error *error) SCREE_MUST_USE;

/// A rose: petals by direction, the length of each its value over the largest; a second one as a line on top.
typedef struct scree_rose {
    const char *title, *name, *line_name; ///< of petals; of the line, NULL: there is none
    size_t sectors;
    const double *angle; ///< rad, middle of each
    const double *petal, *line;
    const double *width; ///< NULL, or rad, of each: angles are elevations then, and both sides are the same
} scree_rose;

/// path without extension. Errors: as scree_map_draw.
scree_status scree_rose_draw(const char *path, const scree_rose *rose, scree_error *error) SCREE_MUST_USE;

#endif
