/// Delaunay triangulation through Qhull (Barber, Dobkin, Huhdanpaa 1996, ACM Trans. Math. Software 22, 469): the lower
/// convex hull of the points lifted to a paraboloid.
///
/// Qhull runs on coordinates centred and scaled to the unit box, so its tolerances (about 1e-15 of the extent) do not
/// depend on the units. Its errors come back through its own longjmp inside qh_new_qhull; what it wants to print goes
/// to a fixed buffer in memory. Cocircular sets (lattices) are triangulated in the way that Qhull chooses for the given
/// order of the points: give them in the order of ids. Triangles are oriented by Qhull's topology, not by the sign of
/// their area, which round-off decides for a flat triangle on a straight side; neighbours are found from the directed
/// edges, and a triangulation in which one edge occurs twice is refused.
/// Cost: O(n log n); 4 microseconds a point for thousands, 15 for a million.
#include "search/delaunay.h"

#include <libqhull_r/libqhull_r.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// First lines of what Qhull had to say.
#define MESSAGE_SIZE 512

static scree_status scale_points(const double *points, size_t count, double **scaled, scree_error *error)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < 2 * count; i++) {
        if (!isfinite(points[i]))
            return scree_error_set(error, SCREE_ERROR_GUARD, "the position of body %zu is not finite", i / 2);
        low[i % 2] = fmin(low[i % 2], points[i]);
        high[i % 2] = fmax(high[i % 2], points[i]);
    }
    double extent = fmax(high[0] - low[0], high[1] - low[1]);
    if (!(extent > 0))
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs points that do not all coincide");
    scree_status status = scree_allocate(scaled, 2 * count, sizeof **scaled, error);
    if (status) return status;
    for (size_t i = 0; i < 2 * count; i++) (*scaled)[i] = (points[i] - (low[i % 2] + high[i % 2]) / 2) / extent;
    return SCREE_OK;
}

/// Copies the lower facets, oriented counter-clockwise.
static scree_status copy_triangles(qhT *qh, size_t count, scree_triangulation *out, scree_error *error)
{
    facetT *facet;
    vertexT *vertex, **vertexp;
    size_t lower = 0;
    FORALLfacets lower += !facet->upperdelaunay;
    scree_status status = scree_allocate(&out->vertex, lower, sizeof *out->vertex, error);
    if (status) return status;
    FORALLfacets
    {
        if (facet->upperdelaunay) continue;
        if (!facet->simplicial)
            return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull left a facet that is not a triangle");
        uint32_t corner[3] = {0};
        int corners = 0;
        FOREACHvertex_(facet->vertices)
        {
            int point = qh_pointid(qh, vertex->point);
            if (point < 0 || (size_t)point >= count || corners == 3)
                return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull returned a triangle of unknown points");
            corner[corners++] = (uint32_t)point;
        }
        int flip = facet->toporient ? 0 : 1;
        uint32_t *triangle = out->vertex[out->count++];
        triangle[0] = corner[0];
        triangle[1] = corner[1 + flip];
        triangle[2] = corner[2 - flip];
    }
    return SCREE_OK;
}

static int compare_triangles(const void *first, const void *second)
{
    const uint32_t *a = first, *b = second;
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// Lowest index first and triangles in ascending order, so that the result does not show the order of Qhull's facets.
static void sort_triangles(scree_triangulation *triangulation)
{
    for (size_t t = 0; t < triangulation->count; t++) {
        uint32_t *v = triangulation->vertex[t];
        while (v[0] > v[1] || v[0] > v[2]) {
            uint32_t first = v[0];
            v[0] = v[1];
            v[1] = v[2];
            v[2] = first;
        }
    }
    qsort(triangulation->vertex, triangulation->count, sizeof *triangulation->vertex, compare_triangles);
}

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

static scree_status qhull_error(int code, char message[MESSAGE_SIZE], scree_error *error)
{
    if (code == qh_ERRmem) return scree_error_set(error, SCREE_ERROR_IO, "out of memory in Qhull");
    if (code == qh_ERRsingular || code == qh_ERRprec)
        return scree_error_set(error, SCREE_ERROR_GUARD, "all points lie on a line: they have no triangulation");
    message[MESSAGE_SIZE - 1] = '\0';
    message[strcspn(message, "\n")] = '\0';
    return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull failed (code %d): %s", code, message);
}

/// The triangles of the scaled points, without neighbours.
static scree_status run_qhull(double *scaled, size_t count, scree_triangulation *triangulation, scree_error *error)
{
    char message[MESSAGE_SIZE] = "", options[] = "qhull d Qbb Qc Qz Q12 Qt";
    FILE *stream = fmemopen(message, MESSAGE_SIZE, "w");
    if (!stream) return scree_error_set_memory(error, MESSAGE_SIZE);
    qhT qh;
    qh_zero(&qh, stream);
    int code = qh_new_qhull(&qh, 2, (int)count, scaled, False, options, NULL, stream);
    scree_status status = code ? SCREE_ERROR_GUARD : copy_triangles(&qh, count, triangulation, error);
    int kept, total;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &kept, &total);
    (void)fclose(stream);
    return code ? qhull_error(code, message, error) : status;
}

scree_status scree_triangulation_build(const double *points, size_t count, scree_triangulation *triangulation,
                                       scree_error *error)
{
    *triangulation = (scree_triangulation){0};
    if (count < 3)
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs at least three points, not %zu", count);
    if (count > INT32_MAX / 8)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu points are too many for a triangulation", count);
    double *scaled = NULL;
    scree_status status = scale_points(points, count, &scaled, error);
    if (!status) status = run_qhull(scaled, count, triangulation, error);
    scree_release(&scaled);
    if (!status) {
        sort_triangles(triangulation);
        status = connect_triangles(triangulation, count, error);
    }
    if (status) scree_triangulation_destroy(triangulation);
    return status;
}

void scree_triangulation_destroy(scree_triangulation *triangulation)
{
    scree_release(&triangulation->vertex);
    scree_release(&triangulation->neighbour);
    triangulation->count = 0;
}
