/// Module of geometry rounded (rounded.h): contacts of polygons with rounded corners, and of discs among them.
#include "contact/rounded.h"

/// Polygons have corners, sharp or rounded; of all other shapes in the plane it knows discs.
static bool is_known(const scree_shape *shape)
{
    return shape->dimension == 2 && (shape->round || shape->rounding);
}

static bool serves(const scree_shape *one, const scree_shape *other)
{
    return is_known(one) && is_known(other);
}

static const scree_geometry geometry = {.traits = &rounded_traits, .serves = serves};

const scree_module scree_module_rounded = {
    .name = "rounded",
    .meaning = "contacts of convex polygons with rounded corners and discs, by the closest features of their cores",
    .geometry = &geometry,
};
