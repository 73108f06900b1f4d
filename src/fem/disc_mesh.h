/// The mesh of a quarter of a disc, finest where it touches. Private to src/fem/.
#ifndef SCREE_FEM_DISC_MESH_H
#define SCREE_FEM_DISC_MESH_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

enum { SCREE_FEM_NODES = 8 };

/// Side `side` (1 to 4: between corners side and side + 1) of an element, numbered from 1.
typedef struct scree_fem_side {
    int64_t element;
    int side;
} scree_fem_side;

/// Quadrilaterals of eight nodes, corners counter-clockwise, then the middles of their sides. The contact is at the
/// origin, the axis along y, the centre at (0, radius); x >= 0. Numbers begin with 1.
typedef struct scree_fem_disc_mesh {
    size_t node_count;
    double (*place)[2]; ///< m; NAN: there is no such node
    size_t element_count;
    int64_t (*element)[SCREE_FEM_NODES];
    size_t axis_count, flat_count, rim_count;
    int64_t *axis, *flat; ///< nodes with x = 0 and with y = radius, in order from the contact, from the centre
    scree_fem_side *rim;  ///< sides on the circle, from the contact up to some ten times the width of the fine part
} scree_fem_disc_mesh;

/// fine: side [m] of the square at the contact that has elements of equal size; elements: over this side.
scree_status scree_fem_disc_mesh_make(double radius, double fine, int64_t elements, scree_fem_disc_mesh *mesh,
                                      scree_error *error) SCREE_MUST_USE;
void scree_fem_disc_mesh_destroy(scree_fem_disc_mesh *mesh);

#endif
