/// Networks: contacts as lines between two places, as wide as their forces, some of them marked. NAME.svg and NAME.png.
#ifndef SCREE_VIEW_LINKS_H
#define SCREE_VIEW_LINKS_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct scree_link {
    double from[2], to[2]; ///< m
    double force;          ///< over the mean one
    bool marked;
} scree_link;

typedef struct scree_links {
    const char *title, *marked_name, *other_name;
    const scree_link *link;
    size_t count;
    double width; ///< m, of the line of the mean force
} scree_links;

/// path without extension. Lines grow no wider beyond six times the mean force. Errors: nothing to draw
/// (SCREE_ERROR_INPUT); disk, memory.
scree_status scree_links_draw(const char *path, const scree_links *links, scree_error *error) SCREE_MUST_USE;

#endif
