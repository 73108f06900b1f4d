/// Module of geometry round (round.h): contacts of bodies that are round.
#include "contact/round.h"

static bool serves(const scree_shape *one, const scree_shape *other)
{
    return one->round && other->round;
}

static const scree_geometry geometry = {.traits = &round_traits, .serves = serves};

const scree_module scree_module_round = {
    .name = "round",
    .meaning = "contacts of discs, or of spheres: the normal is the line of their centres",
    .geometry = &geometry,
};
