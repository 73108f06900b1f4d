/// Delaunay simplices through Qhull (Barber, Dobkin, Huhdanpaa 1996, ACM Trans. Math. Software 22, 469): the lower
/// convex hull of the points lifted to a paraboloid.
///
/// Qhull runs on coordinates centred and scaled to the unit box, so its tolerances (about 1e-15 of the extent) do not
/// depend on the units. Its errors come back through its own longjmp inside qh_new_qhull; what it wants to print goes
/// to a fixed buffer in memory. Cocircular (cospherical) sets, as lattices have them, are divided in the way that Qhull
/// chooses for the given order of the points: give them in the order of ids. Simplices are oriented by Qhull's
/// topology, not by the sign of their volume, which round-off decides for a flat one on a straight side. Who lies
/// beside whom comes from Qhull too, and is checked face by face, since Qhull divides facets after it has built them;
/// of points that are cospherical but for round-off it can make flat simplices of which four have a face in common,
/// joined in pairs.
/// Simplices are ordered by insertion in buckets of their lowest corner.
/// In space facets are merged for the time being only where they are not convex (Qx): 8 % less work, and a twentieth of
/// it for points that lie on one sphere but for round-off. Of points on one circle it would lose some.
/// Partition is depth-first (Q7) where there are more than MANY points: it stays in the cache, but takes more work.
/// Weighted: points stand at |x|^2 - radius^2 instead of on the paraboloid, so it is the convex hull of points in one
/// more dimension that Qhull is asked for; a point above the hull of the others is in no simplex.
/// Cost: O(n log n); in 2D 4 microseconds a point for thousands, 15 for a million; in 3D 20 microseconds a point.
#include "search/simplices.h"

#include <libqhull_r/libqhull_r.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/// First lines of what Qhull had to say.
#define MESSAGE_SIZE 512
#define MANY         20000

/// The lower facets in Qhull's order.
typedef struct raw_simplices {
    size_t count;
    uint32_t *corner; ///< count x (dimension + 1) points
    uint32_t *across; ///< number, from 1, of the simplex opposite to each corner; 0 outside
} raw_simplices;

/// radius: of weighted points, whose height stands behind their coordinates; NULL: none.
static scree_status scale_points(const double *points, const double *radius, size_t count, size_t dimension,
                                 double **scaled, scree_error *error)
{
    const size_t width = dimension + (radius ? 1 : 0);
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
    scree_status status = scree_allocate(scaled, width * count, sizeof **scaled, error);
    if (status) return status;
    for (size_t i = 0; i < count; i++) {
        double *point = *scaled + width * i;
        double height = radius ? -(radius[i] / extent) * (radius[i] / extent) : 0;
        for (size_t k = 0; k < dimension; k++) {
            point[k] = (points[dimension * i + k] - (low[k] + high[k]) / 2) / extent;
            height += point[k] * point[k];
        }
        if (radius) point[dimension] = height;
    }
    return SCREE_OK;
}

static void exchange(uint32_t *a, uint32_t *b)
{
    uint32_t kept = *a;
    *a = *b;
    *b = kept;
}

/// Ascending, with the last two exchanged when that takes an odd number of exchanges; what lies across follows.
static void order_corners(uint32_t *corner, uint32_t *across, size_t corners, bool positive)
{
    bool odd = !positive;
    for (size_t i = 1; i < corners; i++)
        for (size_t k = i; k > 0 && corner[k - 1] > corner[k]; k--) {
            exchange(&corner[k - 1], &corner[k]);
            exchange(&across[k - 1], &across[k]);
            odd = !odd;
        }
    if (!odd) return;
    exchange(&corner[corners - 2], &corner[corners - 1]);
    exchange(&across[corners - 2], &across[corners - 1]);
}

/// Copies the corners of a facet and the numbers of the facets across.
static scree_status copy_facet(qhT *qh, facetT *facet, size_t count, size_t corners, uint32_t *corner, uint32_t *across,
                               scree_error *error)
{
    vertexT *vertex, **vertexp;
    facetT *neighbor, **neighborp;
    size_t found = 0, beside = 0;
    if (!facet->simplicial)
        return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull left a facet that is not a simplex");
    FOREACHvertex_(facet->vertices)
    {
        int point = qh_pointid(qh, vertex->point);
        if (point < 0 || (size_t)point >= count || found == corners)
            return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull returned a simplex of unknown points");
        corner[found++] = (uint32_t)point;
    }
    FOREACHneighbor_(facet)
    {
        if (beside == corners) break;
        across[beside++] = neighbor->visitid;
    }
    if (found < corners || beside < corners || neighbor)
        return scree_error_set(error, SCREE_ERROR_GUARD, "Qhull left a facet that is not a simplex");
    order_corners(corner, across, corners, facet->toporient);
    return SCREE_OK;
}

/// A facet that looks up is no simplex.
static bool is_upper(const facetT *facet, size_t corners, bool weighted)
{
    return weighted ? facet->normal[corners - 1] >= 0 : facet->upperdelaunay;
}

/// Copies the lower facets.
static scree_status copy_simplices(qhT *qh, size_t count, size_t corners, bool weighted, raw_simplices *raw,
                                   scree_error *error)
{
    facetT *facet;
    FORALLfacets facet->visitid = is_upper(facet, corners, weighted) ? 0 : (unsigned)++raw->count;
    scree_status status = scree_allocate(&raw->corner, raw->count * corners, sizeof *raw->corner, error);
    if (!status) status = scree_allocate(&raw->across, raw->count * corners, sizeof *raw->across, error);
    FORALLfacets
    {
        if (status || facet->visitid == 0) continue;
        size_t first = corners * (facet->visitid - 1);
        status = copy_facet(qh, facet, count, corners, raw->corner + first, raw->across + first, error);
    }
    return status;
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

static scree_status run_qhull(double *scaled, size_t count, int dimension, bool weighted, raw_simplices *raw,
                              scree_error *error)
{
    char message[MESSAGE_SIZE] = "", options[32];
    (void)snprintf(options, sizeof options, "qhull %sQbb Qc %sQ12 Qt%s%s", weighted ? "" : "d ", weighted ? "" : "Qz ",
                   dimension == 3 ? " Qx" : "", count > MANY ? " Q7" : "");
    FILE *stream = fmemopen(message, MESSAGE_SIZE, "w");
    if (!stream) return scree_error_set_memory(error, MESSAGE_SIZE);
    qhT qh;
    qh_zero(&qh, stream);
    int code = qh_new_qhull(&qh, dimension + (weighted ? 1 : 0), (int)count, scaled, False, options, NULL, stream);
    scree_status status =
        code ? SCREE_ERROR_GUARD : copy_simplices(&qh, count, (size_t)dimension + 1, weighted, raw, error);
    int kept, total;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &kept, &total);
    (void)fclose(stream);
    return code ? qhull_error(code, message, dimension, error) : status;
}

/// Of two simplices with the same lowest corner.
static bool is_before(const uint32_t *a, const uint32_t *b, size_t corners)
{
    size_t k = 1;
    while (k < corners - 1 && a[k] == b[k]) k++;
    return a[k] < b[k];
}

/// Numbers of the simplices in ascending order, bucketed by their lowest corner. end: ends of the buckets, which begin
/// at zero.
static void order_simplices(const raw_simplices *raw, size_t count, size_t corners, uint32_t *end, uint32_t *order)
{
    for (size_t t = 0; t < raw->count; t++) end[raw->corner[corners * t] + 1]++;
    for (size_t i = 0; i < count; i++) end[i + 1] += end[i];
    // Filling advances the start of each bucket to its end, which is the start of the next one.
    for (size_t t = 0; t < raw->count; t++) order[end[raw->corner[corners * t]]++] = (uint32_t)t;
    for (size_t i = 0, begin = 0; i < count; begin = end[i++])
        for (size_t k = begin + 1; k < end[i]; k++) {
            uint32_t moved = order[k];
            size_t position = k;
            for (; position > begin; position--) {
                uint32_t other = order[position - 1];
                if (!is_before(raw->corner + corners * moved, raw->corner + corners * other, corners)) break;
                order[position] = other;
            }
            order[position] = moved;
        }
}

/// Whether `other` lies across the face opposite to corner k: it has the other corners, and me across the corner that
/// is not mine.
static bool lies_across(const raw_simplices *raw, size_t corners, size_t simplex, size_t k, size_t other)
{
    const uint32_t *mine = raw->corner + corners * simplex, *its = raw->corner + corners * other;
    size_t shared = 0, tip = 0;
    for (size_t i = 0; i < corners; i++) {
        bool is_mine = false;
        for (size_t m = 0; m < corners; m++) is_mine = is_mine || (m != k && mine[m] == its[i]);
        shared += is_mine;
        if (!is_mine) tip = i;
    }
    return shared == corners - 1 && raw->across[corners * other + tip] == simplex + 1;
}

/// Corners and neighbours in ascending order of the simplices. number: from Qhull's numbers, from 1, to the new ones.
static scree_status copy_ordered(const raw_simplices *raw, size_t corners, const uint32_t *order, int32_t *number,
                                 scree_simplices *simplices, scree_error *error)
{
    number[0] = -1;
    for (size_t t = 0; t < raw->count; t++) number[order[t] + 1] = (int32_t)t;
    for (size_t t = 0; t < raw->count; t++)
        for (size_t k = 0; k < corners; k++) {
            size_t from = corners * order[t] + k, to = corners * t + k;
            uint32_t across = raw->across[from];
            simplices->vertex[to] = raw->corner[from];
            simplices->neighbour[to] = number[across];
            if (across > 0 && !lies_across(raw, corners, order[t], k, across - 1))
                return scree_error_set(error, SCREE_ERROR_GUARD, "simplices overlap at body %u", raw->corner[from]);
        }
    return SCREE_OK;
}

/// Every point must be a corner of something; `used` has a byte for each, zero.
static scree_status check_points(const raw_simplices *raw, size_t corners, size_t count, uint8_t *used,
                                 scree_error *error)
{
    for (size_t k = 0; k < corners * raw->count; k++) used[raw->corner[k]] = 1;
    for (size_t i = 0; i < count; i++)
        if (!used[i])
            return scree_error_set(error, SCREE_ERROR_GUARD, "body %zu coincides with another one: no triangulation",
                                   i);
    return SCREE_OK;
}

/// weighted: points may be in no simplex.
static scree_status sort_simplices(const raw_simplices *raw, size_t count, size_t corners, bool weighted,
                                   scree_simplices *simplices, scree_error *error)
{
    uint32_t *end = NULL, *order = NULL;
    int32_t *number = NULL;
    uint8_t *used = NULL;
    scree_status status = scree_allocate(&end, count + 1, sizeof *end, error);
    if (!status) status = scree_allocate(&order, raw->count, sizeof *order, error);
    if (!status) status = scree_allocate(&number, raw->count + 1, sizeof *number, error);
    if (!status) status = scree_allocate(&used, count, sizeof *used, error);
    if (!status) status = scree_allocate(&simplices->vertex, corners * raw->count, sizeof *simplices->vertex, error);
    if (!status)
        status = scree_allocate(&simplices->neighbour, corners * raw->count, sizeof *simplices->neighbour, error);
    if (!status && !weighted) status = check_points(raw, corners, count, used, error);
    if (!status) {
        order_simplices(raw, count, corners, end, order);
        status = copy_ordered(raw, corners, order, number, simplices, error);
    }
    simplices->count = raw->count;
    scree_release(&end);
    scree_release(&order);
    scree_release(&number);
    scree_release(&used);
    return status;
}

static scree_status build(const double *points, const double *radius, size_t count, int dimension,
                          scree_simplices *simplices, scree_error *error)
{
    *simplices = (scree_simplices){0};
    size_t corners = (size_t)dimension + 1;
    if (count < corners)
        return scree_error_set(error, SCREE_ERROR_GUARD, "a triangulation needs at least %zu points, not %zu", corners,
                               count);
    if (count > INT32_MAX / 32)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%zu points are too many for a triangulation", count);
    double *scaled = NULL;
    raw_simplices raw = {0};
    scree_status status = scale_points(points, radius, count, (size_t)dimension, &scaled, error);
    if (!status) status = run_qhull(scaled, count, dimension, radius != NULL, &raw, error);
    scree_release(&scaled);
    if (!status) status = sort_simplices(&raw, count, corners, radius != NULL, simplices, error);
    scree_release(&raw.corner);
    scree_release(&raw.across);
    if (!status) return SCREE_OK;
    scree_release(&simplices->vertex);
    scree_release(&simplices->neighbour);
    *simplices = (scree_simplices){0};
    return status;
}

scree_status scree_simplices_build(const double *points, size_t count, int dimension, scree_simplices *simplices,
                                   scree_error *error)
{
    return build(points, NULL, count, dimension, simplices, error);
}

scree_status scree_simplices_build_weighted(const double *points, const double *radius, size_t count, int dimension,
                                            scree_simplices *simplices, scree_error *error)
{
    return build(points, radius, count, dimension, simplices, error);
}
