/// The walls of a case as lines on the page.
#ifndef SCREE_VIEW_WALL_LINES_H
#define SCREE_VIEW_WALL_LINES_H

#include "io/snapshot.h"

/// Edges at which the walls of `solid` bend or end, and the outlines of round ones, projected on the directions `right`
/// and `up`, as wall lines of `plane`. Errors: memory.
scree_status scree_wall_edges(const scree_snapshot *solid, const double right[3], const double up[3],
                              scree_snapshot *plane, scree_error *error) SCREE_MUST_USE;

/// Where they cross the plane y = cut; x to the right, z upwards. Errors: memory.
scree_status scree_wall_cuts(const scree_snapshot *solid, double cut, scree_snapshot *plane,
                             scree_error *error) SCREE_MUST_USE;

#endif
