/// Module of geometry outlines (outlines.h): contacts of polygons, and of discs among them.
#include "contact/outlines.h"

/// Polygons have corners, sharp or rounded; of all other shapes in the plane it knows discs.
static bool is_known(const scree_shape *shape)
{
    return shape->dimension == 2 && (shape->round || shape->rounding);
}

static bool serves(const scree_shape *one, const scree_shape *other)
{
    return is_known(one) && is_known(other);
}

static const scree_geometry geometry = {.traits = &outlines_traits, .serves = serves};

const scree_module scree_module_outlines = {
    .name = "outlines",
    .meaning = "contacts of convex polygons and discs, by the area that they share",
    .geometry = &geometry,
};
