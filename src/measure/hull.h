/// The sample inside a triangulated hull (3D): what outline.h is for the loop in 2D.
///
/// A triangle of the hull carries the lateral pressure, or it faces the bottom or top plate (scree_hull_load). Below
/// (above) each triangle that faces a plate stands a prism: the triangle, its foot on the plate, and three upright
/// walls. The sample is the hull and these prisms. Walls of two neighbouring prisms coincide with opposite sense, so
/// what is left of them hangs from the rim of the plate's region of the hull: the gap between rim and plate, which
/// carries the lateral pressure too. Between the active plates nothing is left out and nothing is counted twice.
#ifndef SCREE_MEASURE_HULL_H
#define SCREE_MEASURE_HULL_H

#include "measure/delaunay_boundary.h"
#include "state/state.h"

/// Present position [m] of the body at a node of the hull.
void scree_hull_position(const scree_state *state, size_t node, scree_vector position);

/// Present corners [m] of a triangle, relative to `origin`.
void scree_hull_corners(const scree_state *state, size_t triangle, const scree_vector origin, scree_vector corner[3]);

/// Index of the wall that a triangle faces; -1: none.
static inline int scree_hull_wall(const scree_hull *hull, size_t triangle)
{
    return hull->loaded[triangle] >= SCREE_HULL_ON_WALL ? hull->loaded[triangle] - SCREE_HULL_ON_WALL : -1;
}

/// Volume [m3] of the polyhedron through the centres.
double scree_hull_volume(const scree_state *state);

/// Volume [m3] of the sample, prisms included, and a point in its middle (centre of the polyhedron) [m].
double scree_hull_sample_volume(const scree_state *state, scree_vector centre);

/// moment: 3 x 3 out [J/Pa = m3], sum f_i x_j over the bodies of the hull of a lateral pressure of 1 Pa, the walls
/// between the rims and the plates included; x from `centre`.
void scree_hull_pressure_moment(const scree_state *state, const scree_vector centre, double moment[9]);

/// Area [m2] of the bottom or top plate that the sample covers: what the plate has to carry under an all-round pressure
/// p is p x this area, and with that the sample is in equilibrium.
double scree_hull_plate_area(const scree_state *state, int wall);

/// neighbour: triangle_count x 3 out, the triangle across the edge from corner k to the next. Errors: memory;
/// SCREE_ERROR_GUARD when an edge has no partner.
scree_status scree_hull_neighbours(const scree_hull *hull, uint32_t (*neighbour)[3], scree_error *error) SCREE_MUST_USE;

#endif
