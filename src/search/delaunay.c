/// Delaunay triangulation in the plane: the simplices of simplices.c in the plane.
#include "search/delaunay.h"

#include "search/simplices.h"

scree_status scree_triangulation_build(const double *points, size_t count, scree_triangulation *triangulation,
                                       scree_error *error)
{
    scree_simplices simplices;
    scree_status status = scree_simplices_build(points, count, 2, &simplices, error);
    *triangulation = (scree_triangulation){.count = simplices.count,
                                           .vertex = (uint32_t(*)[3])simplices.vertex,
                                           .neighbour = (int32_t(*)[3])simplices.neighbour};
    return status;
}

void scree_triangulation_destroy(scree_triangulation *triangulation)
{
    scree_release(&triangulation->vertex);
    scree_release(&triangulation->neighbour);
    triangulation->count = 0;
}
