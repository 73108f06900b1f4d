/// Delaunay triangulation in the plane: the triangles of simplices.c and who lies beside whom.
///
/// Neighbours are found from the directed edges, and a triangulation in which one edge occurs twice is refused.
/// Cost: that of simplices.c, and O(n) for the neighbours.
#include "search/delaunay.h"

#include "search/simplices.h"

#include <string.h>

/// The directed edge k of triangle t runs from vertex k+1 to vertex k+2: opposite to vertex k.
static uint32_t edge_start(const scree_triangulation *triangulation, size_t edge)
{
    return triangulation->vertex[edge / 3][(edge + 1) % 3];
}

static uint32_t edge_end(const scree_triangulation *triangulation, size_t edge)
{
    return triangulation->vertex[edge / 3][(edge + 2) % 3];
}

/// Directed edge from a to b among those sorted by start; -1 when there is none, -2 when there is more than one.
static int64_t find_edge(const scree_triangulation *triangulation, const uint32_t *begin, const uint32_t *edges,
                         uint32_t a, uint32_t b)
{
    int64_t found = -1;
    for (uint32_t k = begin[a]; k < begin[a + 1]; k++)
        if (edge_end(triangulation, edges[k]) == b) found = found == -1 ? (int64_t)edges[k] : -2;
    return found;
}

/// Neighbours from the directed edges, bucketed by their first point. Every point must have an edge.
static scree_status find_neighbours(scree_triangulation *triangulation, size_t count, uint32_t *begin, uint32_t *edges,
                                    scree_error *error)
{
    size_t edge_count = 3 * triangulation->count;
    for (size_t e = 0; e < edge_count; e++) begin[edge_start(triangulation, e) + 1]++;
    for (size_t i = 0; i < count; i++) {
        if (begin[i + 1] == 0)
            return scree_error_set(error, SCREE_ERROR_GUARD, "body %zu coincides with another one: no triangulation",
                                   i);
        begin[i + 1] += begin[i];
    }
    // Filling advances the start of each bucket to its end, which is the start of the next one.
    for (size_t e = 0; e < edge_count; e++) edges[begin[edge_start(triangulation, e)]++] = (uint32_t)e;
    memmove(begin + 1, begin, count * sizeof *begin);
    begin[0] = 0;
    for (size_t e = 0; e < edge_count; e++) {
        uint32_t a = edge_start(triangulation, e), b = edge_end(triangulation, e);
        int64_t across = find_edge(triangulation, begin, edges, b, a);
        if (across == -2 || find_edge(triangulation, begin, edges, a, b) == -2)
            return scree_error_set(error, SCREE_ERROR_GUARD, "triangles overlap at bodies %u and %u", a, b);
        triangulation->neighbour[e / 3][e % 3] = across < 0 ? -1 : (int32_t)(across / 3);
    }
    return SCREE_OK;
}

static scree_status connect_triangles(scree_triangulation *triangulation, size_t count, scree_error *error)
{
    uint32_t *begin = NULL, *edges = NULL;
    scree_status status = scree_allocate(&begin, count + 1, sizeof *begin, error);
    if (!status) status = scree_allocate(&edges, 3 * triangulation->count, sizeof *edges, error);
    if (!status)
        status =
            scree_allocate(&triangulation->neighbour, triangulation->count, sizeof *triangulation->neighbour, error);
    if (!status) status = find_neighbours(triangulation, count, begin, edges, error);
    scree_release(&begin);
    scree_release(&edges);
    return status;
}

scree_status scree_triangulation_build(const double *points, size_t count, scree_triangulation *triangulation,
                                       scree_error *error)
{
    *triangulation = (scree_triangulation){0};
    uint32_t *vertex = NULL;
    scree_status status = scree_simplices_build(points, count, 2, &vertex, &triangulation->count, error);
    triangulation->vertex = (uint32_t(*)[3])vertex;
    if (!status) status = connect_triangles(triangulation, count, error);
    if (status) scree_triangulation_destroy(triangulation);
    return status;
}

void scree_triangulation_destroy(scree_triangulation *triangulation)
{
    scree_release(&triangulation->vertex);
    scree_release(&triangulation->neighbour);
    triangulation->count = 0;
}
