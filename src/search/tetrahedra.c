/// Delaunay triangulation in space through Qhull (Barber, Dobkin, Huhdanpaa 1996): the lower convex hull of the points
/// lifted to a paraboloid, as in delaunay.c, with coordinates centred and scaled to the unit box. Neighbours are found
/// from the faces, bucketed by their lowest point. Cost: O(n log n) for packings; 30 microseconds a sphere.
#include "search/tetrahedra.h"

#include <libqhull_r/libqhull_r.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MESSAGE_SIZE 512
/// Six times the volume over the cube of the longest edge: a regular tetrahedron has 0.71. Below the first it is flat,
/// and round-off decides the sign of its volume; below the second it is a sliver when it lies on the hull.
#define FLAT   1e-9
#define SLIVER 0.05

static scree_status scale_points(const double *points, size_t count, double **scaled, scree_error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0;
    for (size_t i = 0; i < 3 * count; i++) {
        if (!isfinite(points[i]))
            return scree_error_set(error, SCREE_ERROR_GUARD, "the position of body %zu is not finite", i / 3);
        low[i % 3] = fmin(low[i % 3], points[i]);
        high[i % 3] = fmax(high[i % 3], points[i]);
    }
    for (int k = 0; k < 3; k++) extent = fmax(extent, high[k] - low[k]);
    if (!(extent > 0))
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs points that do not all coincide");
    scree_status status = scree_allocate(scaled, 3 * count, sizeof **scaled, error);
    if (status) return status;
    for (size_t i = 0; i < 3 * count; i++) (*scaled)[i] = (points[i] - (low[i % 3] + high[i % 3]) / 2) / extent;
    return SCREE_OK;
}

/// Six times the volume of a tetrahedron over the cube of its longest edge.
static double shape_of(const double *points, const uint32_t vertex[4])
{
    double edge[3][3], longest = 0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            edge[k][i] = points[3 * (size_t)vertex[k + 1] + (size_t)i] - points[3 * (size_t)vertex[0] + (size_t)i];
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < a; b++) {
            const double *p = points + 3 * (size_t)vertex[a], *q = points + 3 * (size_t)vertex[b];
            double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
            longest = fmax(longest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
    double volume = edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
                    edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
                    edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
    return volume / (longest * sqrt(longest));
}

/// Lowest index first; the others ascending but for the last two, whose order makes the volume positive.
static void orient(const double *points, uint32_t vertex[4])
{
    for (int a = 1; a < 4; a++)
        for (int b = a; b > 0 && vertex[b] < vertex[b - 1]; b--) {
            uint32_t lower = vertex[b];
            vertex[b] = vertex[b - 1];
            vertex[b - 1] = lower;
        }
    if (shape_of(points, vertex) >= 0) return;
    uint32_t last = vertex[3];
    vertex[3] = vertex[2];
    vertex[2] = last;
}

/// Copies the lower facets that are not flat.
static scree_status copy_tetrahedra(qhT *qh, const double *points, size_t count, scree_tetrahedra *out,
                                    scree_error *error)
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
        uint32_t *corner = out->vertex[out->count];
        int corners = 0;
        FOREACHvertex_(facet->vertices)
        {
            int point = qh_pointid(qh, vertex->point);
            if (point < 0 || (size_t)point >= count || corners == 4)
                return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull returned a tetrahedron of unknown points");
            corner[corners++] = (uint32_t)point;
        }
        if (corners != 4) return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull left a facet of %d points", corners);
        orient(points, corner);
        out->count += shape_of(points, corner) > FLAT;
    }
    return SCREE_OK;
}

static scree_status run_qhull(double *scaled, size_t count, scree_tetrahedra *tetrahedra, scree_error *error)
{
    char message[MESSAGE_SIZE] = "", options[] = "qhull d Qbb Qc Qz Q12 Qt";
    FILE *stream = fmemopen(message, MESSAGE_SIZE, "w");
    if (!stream) return scree_error_set_memory(error, MESSAGE_SIZE);
    qhT qh;
    qh_zero(&qh, stream);
    int code = qh_new_qhull(&qh, 3, (int)count, scaled, False, options, NULL, stream);
    scree_status status = code ? SCREE_ERROR_GUARD : copy_tetrahedra(&qh, scaled, count, tetrahedra, error);
    int kept, total;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &kept, &total);
    (void)fclose(stream);
    if (!code) return status;
    message[MESSAGE_SIZE - 1] = '\0';
    message[strcspn(message, "\n")] = '\0';
    if (code == qh_ERRmem) return scree_error_set(error, SCREE_ERROR_IO, "out of memory in Qhull");
    if (code == qh_ERRsingular || code == qh_ERRprec)
        return scree_error_set(error, SCREE_ERROR_GUARD, "all points lie in a plane: they have no tetrahedra");
    return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull failed (code %d): %s", code, message);
}

static int compare_tetrahedra(const void *first, const void *second)
{
    const uint32_t *a = first, *b = second;
    for (int i = 0; i < 4; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// Points of face `face` (4 x tetrahedron + corner opposite), ascending.
static void face_points(const scree_tetrahedra *tetrahedra, size_t face, uint32_t points[3])
{
    const uint32_t *vertex = tetrahedra->vertex[face / 4];
    int count = 0;
    for (size_t k = 0; k < 4; k++)
        if (k != face % 4) points[count++] = vertex[k];
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < 2 - pass; k++)
            if (points[k] > points[k + 1]) {
                uint32_t larger = points[k];
                points[k] = points[k + 1];
                points[k + 1] = larger;
            }
}

/// Pairs the faces of one bucket: all have the same lowest point.
static scree_status pair_faces(scree_tetrahedra *tetrahedra, const uint32_t *face, size_t count, scree_error *error)
{
    uint32_t a[3], b[3];
    for (size_t i = 0; i < count; i++) {
        face_points(tetrahedra, face[i], a);
        for (size_t j = i + 1; j < count; j++) {
            face_points(tetrahedra, face[j], b);
            if (a[1] != b[1] || a[2] != b[2]) continue;
            int32_t *one = &tetrahedra->neighbour[face[i] / 4][face[i] % 4];
            int32_t *other = &tetrahedra->neighbour[face[j] / 4][face[j] % 4];
            if (*one >= 0 || *other >= 0)
                return scree_error_set(error, SCREE_ERROR_GUARD, "tetrahedra overlap at bodies %u, %u and %u", a[0],
                                       a[1], a[2]);
            *one = (int32_t)(face[j] / 4);
            *other = (int32_t)(face[i] / 4);
        }
    }
    return SCREE_OK;
}

static scree_status connect(scree_tetrahedra *tetrahedra, size_t count, scree_error *error)
{
    uint32_t *begin = NULL, *faces = NULL, points[3];
    size_t face_count = 4 * tetrahedra->count;
    scree_status status = scree_allocate(&begin, count + 2, sizeof *begin, error);
    if (!status) status = scree_allocate(&faces, face_count, sizeof *faces, error);
    if (!status)
        status = scree_allocate(&tetrahedra->neighbour, tetrahedra->count, sizeof *tetrahedra->neighbour, error);
    // Counting sort by lowest point: begin[i + 1] advances to the end of bucket i while it is filled.
    for (size_t f = 0; f < face_count && !status; f++) {
        tetrahedra->neighbour[f / 4][f % 4] = -1;
        face_points(tetrahedra, f, points);
        begin[points[0] + 2]++;
    }
    for (size_t i = 0; i < count && !status; i++) begin[i + 2] += begin[i + 1];
    for (size_t f = 0; f < face_count && !status; f++) {
        face_points(tetrahedra, f, points);
        faces[begin[points[0] + 1]++] = (uint32_t)f;
    }
    for (size_t i = 0; i < count && !status; i++)
        status = pair_faces(tetrahedra, faces + begin[i], begin[i + 1] - begin[i], error);
    scree_release(&begin);
    scree_release(&faces);
    return status;
}

scree_status scree_tetrahedra_build(const double *points, size_t count, scree_tetrahedra *tetrahedra,
                                    scree_error *error)
{
    *tetrahedra = (scree_tetrahedra){0};
    if (count < 4)
        return scree_error_set(error, SCREE_ERROR_GUARD, "tetrahedra need at least four points, not %zu", count);
    if (count > INT32_MAX / 64)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu points are too many for a triangulation", count);
    double *scaled = NULL;
    scree_status status = scale_points(points, count, &scaled, error);
    if (!status) status = run_qhull(scaled, count, tetrahedra, error);
    scree_release(&scaled);
    if (!status && tetrahedra->count > 0)
        qsort(tetrahedra->vertex, tetrahedra->count, sizeof *tetrahedra->vertex, compare_tetrahedra);
    if (!status) status = connect(tetrahedra, count, error);
    if (status) scree_tetrahedra_destroy(tetrahedra);
    return status;
}

void scree_tetrahedra_destroy(scree_tetrahedra *tetrahedra)
{
    scree_release(&tetrahedra->vertex);
    scree_release(&tetrahedra->neighbour);
    tetrahedra->count = 0;
}

// ---- peeling -----------------------------------------------------------------------------------------------------

typedef struct peeling {
    const scree_tetrahedra *tetrahedra;
    const double *points, *radius;
    double gap_limit;
    uint32_t *cells_of; ///< by point: tetrahedra that are left
    uint8_t *outside;
    uint32_t *queue; ///< tetrahedra to be looked at, each at most once for each of its faces
    size_t queued;
} peeling;

/// Widest free gap along the edges of the face opposite to `corner`.
static double face_gap(const peeling *peel, const uint32_t vertex[4], int corner)
{
    double widest = -INFINITY;
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < a; b++) {
            if (a == corner || b == corner) continue;
            const double *p = peel->points + 3 * (size_t)vertex[a], *q = peel->points + 3 * (size_t)vertex[b];
            double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
            double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            widest = fmax(widest, length - peel->radius[vertex[a]] - peel->radius[vertex[b]]);
        }
    return widest;
}

static bool to_be_cut(const peeling *peel, size_t t)
{
    const uint32_t *vertex = peel->tetrahedra->vertex[t];
    for (int k = 0; k < 4; k++)
        if (peel->cells_of[vertex[k]] < 2) return false;
    if (shape_of(peel->points, vertex) < SLIVER) return true;
    for (int k = 0; k < 4; k++) {
        int32_t behind = peel->tetrahedra->neighbour[t][k];
        if ((behind < 0 || peel->outside[behind]) && face_gap(peel, vertex, k) > peel->gap_limit) return true;
    }
    return false;
}

static void peel_queue(peeling *peel)
{
    const scree_tetrahedra *all = peel->tetrahedra;
    for (size_t head = 0; head < peel->queued; head++) {
        uint32_t t = peel->queue[head];
        if (peel->outside[t] || !to_be_cut(peel, t)) continue;
        peel->outside[t] = 1;
        for (int k = 0; k < 4; k++) {
            int32_t behind = all->neighbour[t][k];
            peel->cells_of[all->vertex[t][k]]--;
            if (behind >= 0 && !peel->outside[behind]) peel->queue[peel->queued++] = (uint32_t)behind;
        }
    }
}

scree_status scree_tetrahedra_peel(const scree_tetrahedra *tetrahedra, const double *points, const double *radius,
                                   size_t count, double gap_limit, uint8_t *outside, scree_error *error)
{
    peeling peel = {
        .tetrahedra = tetrahedra, .points = points, .radius = radius, .gap_limit = gap_limit, .outside = outside};
    scree_status status = scree_allocate(&peel.cells_of, count, sizeof *peel.cells_of, error);
    if (!status) status = scree_allocate(&peel.queue, 5 * tetrahedra->count, sizeof *peel.queue, error);
    for (size_t t = 0; t < tetrahedra->count && !status; t++) {
        bool open = false;
        outside[t] = 0;
        for (int k = 0; k < 4; k++) {
            peel.cells_of[tetrahedra->vertex[t][k]]++;
            open = open || tetrahedra->neighbour[t][k] < 0;
        }
        if (open) peel.queue[peel.queued++] = (uint32_t)t;
    }
    if (!status) peel_queue(&peel);
    scree_release(&peel.cells_of);
    scree_release(&peel.queue);
    return status;
}
