/// Module of geometry outlines (outlines.h): contacts of polygons, and of discs among them.
#include "contact/outlines.h"

static bool serves(const scree_shape *one, const scree_shape *other)
{
    return one->dimension == 2 && other->dimension == 2;
}

static const scree_geometry geometry = {.traits = &outlines_traits, .serves = serves};

const scree_module scree_module_outlines = {
    .name = "outlines",
    .meaning = "contacts of convex polygons and discs, by the area that they share",
    .geometry = &geometry,
};
