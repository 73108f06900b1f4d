/// The wall that what is poured comes to at last, if it meets no other grain.
#ifndef SCREE_SOURCE_LOWEST_WALL_H
#define SCREE_SOURCE_LOWEST_WALL_H

#include "model/model.h"
#include "shape/wall_set.h"

/// Sets the number of the wall that the plumb lines from the middles of all sources meet last, at the present poses of
/// walls, the sources where the case has them; -1: there is none, or sources do not agree. Errors: memory.
/// Cost: the corners of the walls for each source.
scree_status scree_source_lowest_wall(const scree_model *model, const scree_wall_set *wall_set, int *wall,
                                      scree_error *error) SCREE_MUST_USE;

#endif
