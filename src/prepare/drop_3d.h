/// A heap of spheres that grows sphere by sphere: each falls, rolls on one sphere, then on two, and comes to rest on
/// three, by exact geometry. See drop_3d.c; the two-dimensional counterpart is drop_2d.h.
#ifndef SCREE_PREPARE_DROP_3D_H
#define SCREE_PREPARE_DROP_3D_H

#include "base/memory.h"

#include <stdbool.h>

typedef struct scree_drop_3d {
    const double *radius; ///< m, of all spheres, owned by the caller
    double *x, *y, *z;    ///< m, centres of the spheres placed so far, owned by the caller
    double *level;        ///< m, highest centre among a sphere and all that it rests on, owned by the caller
    double width, depth;  ///< m, walls at x = 0 and width, y = 0 and depth; the floor is z = 0
    double largest;       ///< m, largest radius
    double cell;          ///< m, side of a grid cell
    size_t columns, rows; ///< of the grid, along x and y
    size_t layers;        ///< along z
    uint32_t *head;       ///< layers x rows x columns: 1 + the last sphere of a cell, 0 for none
    uint32_t *next;       ///< 1 + the next sphere of the same cell
    size_t *filled;       ///< rows x columns: layers up to the highest sphere there
} scree_drop_3d;

/// An empty box; the arrays have room for `count` spheres.
scree_status scree_drop_3d_create(scree_drop_3d *drop, const double *radius, size_t count, const double floor_sides[2],
                                  double *const place[3], double *level, scree_error *error) SCREE_MUST_USE;
void scree_drop_3d_destroy(scree_drop_3d *drop);

/// Would sphere `index`, let fall at (x, y), reach the floor without touching another sphere?
bool scree_drop_3d_sees_floor(const scree_drop_3d *drop, size_t index, double x, double y);

/// Lets sphere `index` fall from above at (x, y), at least its radius from all walls, and roll to its place of rest,
/// which it fills in. Errors: memory; the sphere finds no rest (does not happen unless radii or positions are not
/// numbers).
scree_status scree_drop_3d_add(scree_drop_3d *drop, size_t index, double x, double y,
                               scree_error *error) SCREE_MUST_USE;

#endif
