/// A picture of Cairo as a PNG file, through libpng. Cairo's own writer lets libpng choose a filter for each row, which
/// photographs gain by; flat areas and lines are packed as well without, in a third of the time.
#ifndef SCREE_VIEW_PNG_FILE_H
#define SCREE_VIEW_PNG_FILE_H

#include <cairo.h>
#include <stdio.h>

/// surface: an image of the format CAIRO_FORMAT_RGB24 that is drawn. Errors: writing, memory, as statuses of Cairo.
cairo_status_t scree_png_write(FILE *file, cairo_surface_t *surface);

#endif
