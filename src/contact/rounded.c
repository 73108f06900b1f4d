/// Module of geometry rounded (rounded.h): contacts of polygons with rounded corners, and of discs among them.
#include "contact/rounded.h"

static bool serves(const scree_shape *one, const scree_shape *other)
{
    return one->dimension == 2 && other->dimension == 2;
}

static const scree_geometry geometry = {.traits = &rounded_traits, .serves = serves};

const scree_module scree_module_rounded = {
    .name = "rounded",
    .meaning = "contacts of convex polygons with rounded corners and discs, by the closest features of their cores",
    .geometry = &geometry,
};
