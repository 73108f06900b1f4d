/// One page of vector graphics, written as NAME.svg and NAME.png through Cairo, and text on it.
#ifndef SCREE_VIEW_PAGE_H
#define SCREE_VIEW_PAGE_H

#include "base/error.h"
#include "view/colour.h"

#include <cairo.h>
#include <stdbool.h>

#define SCREE_PAGE_PIXELS 2000 ///< long side of the PNG, unless another one has been chosen

/// What scree_figure_pixels_choose has set; 0: nothing.
int scree_page_chosen_pixels(void);

typedef void scree_page_draw(cairo_t *cairo, void *user);

typedef struct scree_page {
    double width, height; ///< pt
    size_t marks;         ///< at most so many discs, or as many lines, are one shape of the drawing
    scree_page_draw *draw;
    void *user;
    int pixels; ///< long side of a PNG alone; 0: both files
} scree_page;

/// Draws a page twice: NAME.svg (text as glyphs, no fonts needed to look at it) and NAME.png, or the latter alone. A
/// page that could not have the memory that its marks may take is not begun. Errors: disk, memory.
scree_status scree_page_write(const char *path, const scree_page *page, scree_error *error) SCREE_MUST_USE;

typedef struct scree_text_style {
    double size; ///< pt
    bool bold;
    scree_colour colour;
} scree_text_style;

/// One line; `anchor` 0: begins at x, 0.5: centred, 1: ends at x. y is the base line.
void scree_text_show(cairo_t *cairo, double x, double y, double anchor, const char *text, scree_text_style style);
double scree_text_width(cairo_t *cairo, const char *text, scree_text_style style);

/// Text broken at spaces into lines of at most `width` pt; (x, y) is the top left corner. Returns the y below the last
/// line.
double scree_text_paragraph(cairo_t *cairo, double x, double y, double width, const char *text, scree_text_style style);

/// Copies `text` with every byte that is not valid UTF-8, and every control character, replaced by '?' (white space by
/// a space); truncated to whole characters.
void scree_text_clean(char *out, size_t size, const char *text);

void scree_page_colour(cairo_t *cairo, scree_colour colour);

#endif
