/// The font of all figures.
#ifndef SCREE_VIEW_FONT_H
#define SCREE_VIEW_FONT_H

#include <stdbool.h>
#include <stddef.h>

#define SCREE_FONT "DejaVu Sans"

/// Whether the font is missing; `said` is then one line that tells what figures look like without it. They are drawn all
/// the same: with the nearest font that there is, or without any text.
bool scree_font_missing(char *said, size_t size);

#endif
