/// Delaunay tetrahedra: the simplices of simplices.c in space.
#include "search/tetrahedra.h"

#include "search/simplices.h"

const uint8_t scree_tetrahedron_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

scree_status scree_tetrahedra_build(const double *points, size_t count, scree_tetrahedra *tetrahedra,
                                    scree_error *error)
{
    scree_simplices simplices;
    scree_status status = scree_simplices_build(points, count, 3, &simplices, error);
    *tetrahedra = (scree_tetrahedra){.count = simplices.count,
                                     .vertex = (uint32_t(*)[4])simplices.vertex,
                                     .neighbour = (int32_t(*)[4])simplices.neighbour};
    return status;
}

void scree_tetrahedra_destroy(scree_tetrahedra *tetrahedra)
{
    scree_release(&tetrahedra->vertex);
    scree_release(&tetrahedra->neighbour);
    tetrahedra->count = 0;
}
