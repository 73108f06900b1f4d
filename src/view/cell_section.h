/// The cut of a plane through Delaunay tetrahedra, as flat cells that a scene can draw.
#ifndef SCREE_VIEW_CELL_SECTION_H
#define SCREE_VIEW_CELL_SECTION_H

#include "measure/cells.h"

/// Cells are the triangles of the cut, in no orientation; `volume` is their area [m2], `neighbour` is -1 across an edge
/// on the outside of the sample, and nothing else is filled.
typedef struct scree_cell_section {
    scree_cells cells;
    double *place; ///< m, corners x 3: x, z of the sample, 0
    double *field; ///< per cell, that of its tetrahedron
} scree_cell_section;

/// The plane y = cut. place: m, bodies x 3; field: per tetrahedron. Errors: memory. Cost: O(tetrahedra).
scree_status scree_cell_section_create(const scree_cells *solid, const double *place, const double *field, double cut,
                                       scree_cell_section *section, scree_error *error) SCREE_MUST_USE;
void scree_cell_section_destroy(scree_cell_section *section);

#endif
