/// Delaunay simplices through Qhull (Barber, Dobkin, Huhdanpaa 1996, ACM Trans. Math. Software 22, 469): the lower
/// convex hull of the points lifted to a paraboloid.
///
/// Qhull runs on coordinates centred and scaled to the unit box, so its tolerances (about 1e-15 of the extent) do not
/// depend on the units. Its errors come back through its own longjmp inside qh_new_qhull; what it wants to print goes
/// to a fixed buffer in memory. Cocircular (cospherical) sets, as lattices have them, are divided in the way that Qhull
/// chooses for the given order of the points: give them in the order of ids. Simplices are oriented by Qhull's
/// topology, not by the sign of their volume, which round-off decides for a flat one on a straight side.
/// Cost: O(n log n); in 2D 4 microseconds a point for thousands, 15 for a million; in 3D 30 microseconds a point.
#include "search/simplices.h"

#include <libqhull_r/libqhull_r.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// First lines of what Qhull had to say.
#define MESSAGE_SIZE 512

static scree_status scale_points(const double *points, size_t count, size_t dimension, double **scaled,
                                 scree_error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0;
    for (size_t i = 0; i < dimension * count; i++) {
        if (!isfinite(points[i]))
            return scree_error_set(error, SCREE_ERROR_GUARD, "the position of body %zu is not finite", i / dimension);
        low[i % dimension] = fmin(low[i % dimension], points[i]);
        high[i % dimension] = fmax(high[i % dimension], points[i]);
    }
    for (size_t k = 0; k < dimension; k++) extent = fmax(extent, high[k] - low[k]);
    if (!(extent > 0))
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs points that do not all coincide");
    scree_status status = scree_allocate(scaled, dimension * count, sizeof **scaled, error);
    if (status) return status;
    for (size_t i = 0; i < dimension * count; i++)
        (*scaled)[i] = (points[i] - (low[i % dimension] + high[i % dimension]) / 2) / extent;
    return SCREE_OK;
}

/// Ascending, with the last two exchanged when that takes an odd number of exchanges.
static void order_corners(uint32_t *corner, int corners, bool positive)
{
    bool odd = !positive;
    for (int i = 1; i < corners; i++)
        for (int k = i; k > 0 && corner[k - 1] > corner[k]; k--) {
            uint32_t larger = corner[k - 1];
            corner[k - 1] = corner[k];
            corner[k] = larger;
            odd = !odd;
        }
    if (!odd) return;
    uint32_t last = corner[corners - 1];
    corner[corners - 1] = corner[corners - 2];
    corner[corners - 2] = last;
}

/// Copies the lower facets.
static scree_status copy_simplices(qhT *qh, size_t count, int corners, uint32_t **out, size_t *simplex_count,
                                   scree_error *error)
{
    facetT *facet;
    vertexT *vertex, **vertexp;
    size_t lower = 0;
    FORALLfacets lower += !facet->upperdelaunay;
    scree_status status = scree_allocate(out, lower * (size_t)corners, sizeof **out, error);
    if (status) return status;
    FORALLfacets
    {
        if (facet->upperdelaunay) continue;
        if (!facet->simplicial)
            return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull left a facet that is not a simplex");
        uint32_t *corner = *out + (size_t)corners * *simplex_count;
        int found = 0;
        FOREACHvertex_(facet->vertices)
        {
            int point = qh_pointid(qh, vertex->point);
            if (point < 0 || (size_t)point >= count || found == corners)
                return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull returned a simplex of unknown points");
            corner[found++] = (uint32_t)point;
        }
        order_corners(corner, corners, facet->toporient);
        (*simplex_count)++;
    }
    return SCREE_OK;
}

static int compare_corners(const uint32_t *a, const uint32_t *b, int corners)
{
    for (int i = 0; i < corners; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

static int compare_triangles(const void *first, const void *second)
{
    return compare_corners(first, second, 3);
}

static int compare_tetrahedra(const void *first, const void *second)
{
    return compare_corners(first, second, 4);
}

static scree_status qhull_error(int code, char message[MESSAGE_SIZE], int dimension, scree_error *error)
{
    if (code == qh_ERRmem) return scree_error_set(error, SCREE_ERROR_IO, "out of memory in Qhull");
    if (code == qh_ERRsingular || code == qh_ERRprec)
        return scree_error_set(error, SCREE_ERROR_GUARD, "all points lie %s: they have no triangulation",
                               dimension == 2 ? "on a line" : "in a plane");
    message[MESSAGE_SIZE - 1] = '\0';
    message[strcspn(message, "\n")] = '\0';
    return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull failed (code %d): %s", code, message);
}

static scree_status run_qhull(double *scaled, size_t count, int dimension, uint32_t **vertex, size_t *simplex_count,
                              scree_error *error)
{
    char message[MESSAGE_SIZE] = "", options[] = "qhull d Qbb Qc Qz Q12 Qt";
    FILE *stream = fmemopen(message, MESSAGE_SIZE, "w");
    if (!stream) return scree_error_set_memory(error, MESSAGE_SIZE);
    qhT qh;
    qh_zero(&qh, stream);
    int code = qh_new_qhull(&qh, dimension, (int)count, scaled, False, options, NULL, stream);
    scree_status status =
        code ? SCREE_ERROR_GUARD : copy_simplices(&qh, count, dimension + 1, vertex, simplex_count, error);
    int kept, total;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &kept, &total);
    (void)fclose(stream);
    return code ? qhull_error(code, message, dimension, error) : status;
}

scree_status scree_simplices_build(const double *points, size_t count, int dimension, uint32_t **vertex,
                                   size_t *simplex_count, scree_error *error)
{
    *vertex = NULL;
    *simplex_count = 0;
    size_t least = (size_t)dimension + 1;
    if (count < least)
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs at least %zu points, not %zu", least,
                               count);
    if (count > INT32_MAX / 32)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu points are too many for a triangulation", count);
    double *scaled = NULL;
    scree_status status = scale_points(points, count, (size_t)dimension, &scaled, error);
    if (!status) status = run_qhull(scaled, count, dimension, vertex, simplex_count, error);
    scree_release(&scaled);
    if (!status)
        qsort(*vertex, *simplex_count, least * sizeof **vertex,
              dimension == 2 ? compare_triangles : compare_tetrahedra);
    else
        scree_release(vertex);
    return status;
}
