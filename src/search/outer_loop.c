/// The boundary loop from the points near the outside alone.
///
/// A cell grid is flooded from outside through empty cells; the points less than DEPTH cells behind the flood are the
/// band, and only they are triangulated. The loop needs nothing else, and that is checked, not assumed: the peeling
/// looks at the triangles along the loop only, and a triangle of the band belongs to the Delaunay triangulation of ALL
/// points when no left-out point lies in its circumcircle (Delaunay 1934). Circles that do not touch the ring of
/// left-out cells beside the band reach none; of the few others every left-out point is tested. If one lies inside, all
/// points are triangulated after all. Where points are cocircular the diagonals, which are not unique, may differ from
/// those of the whole. In a packing the band is three diameters deep: of 4000 bodies 800 are triangulated, of a million
/// 12,000. Cost: O(n) for the grid, O(b log b) for b bodies in the band, O(h f) for h circles and f ring cells, O(n)
/// for each circle that touches the ring.
#include "search/delaunay.h"

#include <math.h>
#include <stdbool.h>

/// Cells of this many spacings, and the depth of the band in cells.
#define CELL   1.5
#define DEPTH  2
#define INSIDE UINT8_MAX

typedef struct band {
    double origin[2], cell; ///< m, corner of the grid and edge of a cell
    size_t size[2];         ///< cells, with an empty ring around the points
    uint8_t *depth;         ///< by cell: 0 outside, 1 .. DEPTH, INSIDE
    uint32_t *queue;        ///< cells in the order in which the flood reaches them
    size_t queued;
    uint32_t *ring; ///< INSIDE cells beside the band
    size_t ring_count;
    uint32_t *index; ///< points of the band, ascending
    double *points, *radius;
    size_t count;
} band;

static void band_destroy(band *b)
{
    scree_release(&b->depth);
    scree_release(&b->queue);
    scree_release(&b->ring);
    scree_release(&b->index);
    scree_release(&b->points);
    scree_release(&b->radius);
}

static size_t cell_of(const band *b, const double *point)
{
    size_t column = (size_t)((point[0] - b->origin[0]) / b->cell), row = (size_t)((point[1] - b->origin[1]) / b->cell);
    return row * b->size[0] + column;
}

/// Lays the grid; false when it would have many more cells than there are points (a body far away).
static bool lay_grid(band *b, const double *points, size_t count, double spacing)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < 2 * count; i++) {
        low[i % 2] = fmin(low[i % 2], points[i]);
        high[i % 2] = fmax(high[i % 2], points[i]);
    }
    b->cell = CELL * spacing;
    double cells[2];
    for (int k = 0; k < 2; k++) {
        cells[k] = floor((high[k] - low[k]) / b->cell) + 4;
        b->origin[k] = low[k] - 1.5 * b->cell;
    }
    // Also false when anything is not a number.
    if (!(cells[0] * cells[1] <= 4 * (double)count + 1024)) return false;
    for (int k = 0; k < 2; k++) b->size[k] = (size_t)cells[k];
    return true;
}

static void reach(band *b, size_t cell, uint8_t depth)
{
    b->depth[cell] = depth;
    b->queue[b->queued++] = (uint32_t)cell;
}

/// Reaches the neighbours of a cell that the flood has not reached yet: `empty` tells which may be flooded (NULL: all,
/// also across corners).
static void spread(band *b, size_t cell, uint8_t depth, const uint8_t *empty)
{
    size_t column = cell % b->size[0], row = cell / b->size[0];
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            if ((dx < 0 && column == 0) || (dx > 0 && column + 1 == b->size[0]) || (dy < 0 && row == 0) ||
                (dy > 0 && row + 1 == b->size[1]) || (empty && dx != 0 && dy != 0))
                continue;
            size_t other = (size_t)((int64_t)cell + dy * (int64_t)b->size[0] + dx);
            if (b->depth[other] == INSIDE && (!empty || empty[other])) reach(b, other, depth);
        }
}

/// Depth of every cell, and the ring of left-out cells beside the band.
static scree_status flood(band *b, const double *points, size_t count, scree_error *error)
{
    size_t cells = b->size[0] * b->size[1], begin = 0;
    uint8_t *empty = NULL;
    scree_status status = scree_allocate(&empty, cells, sizeof *empty, error);
    if (!status) status = scree_allocate(&b->depth, cells, sizeof *b->depth, error);
    if (!status) status = scree_allocate(&b->queue, cells, sizeof *b->queue, error);
    if (!status) status = scree_allocate(&b->ring, cells, sizeof *b->ring, error);
    for (size_t c = 0; c < cells && !status; c++) {
        b->depth[c] = INSIDE;
        empty[c] = 1;
    }
    if (!status) {
        for (size_t i = 0; i < count; i++) empty[cell_of(b, points + 2 * i)] = 0;
        reach(b, 0, 0); // a corner of the empty ring around the points
        while (begin < b->queued) spread(b, b->queue[begin++], 0, empty);
        begin = 0;
        for (uint8_t depth = 1; depth <= DEPTH + 1; depth++)
            for (size_t end = b->queued; begin < end; begin++) spread(b, b->queue[begin], depth, NULL);
        // The last layer is not part of the band: it is the ring of what is left out.
        for (size_t c = 0; c < cells; c++) {
            if (b->depth[c] != DEPTH + 1) continue;
            b->depth[c] = INSIDE;
            b->ring[b->ring_count++] = (uint32_t)c;
        }
    }
    scree_release(&empty);
    return status;
}

/// The points of the band.
static scree_status gather(band *b, const double *points, const double *radius, size_t count, scree_error *error)
{
    for (size_t i = 0; i < count; i++) b->count += b->depth[cell_of(b, points + 2 * i)] != INSIDE;
    scree_status status = scree_allocate(&b->index, b->count, sizeof *b->index, error);
    if (!status) status = scree_allocate(&b->points, 2 * b->count, sizeof *b->points, error);
    if (!status) status = scree_allocate(&b->radius, b->count, sizeof *b->radius, error);
    size_t k = 0;
    for (size_t i = 0; i < count && !status; i++) {
        if (b->depth[cell_of(b, points + 2 * i)] == INSIDE) continue;
        b->index[k] = (uint32_t)i;
        b->points[2 * k] = points[2 * i];
        b->points[2 * k + 1] = points[2 * i + 1];
        b->radius[k++] = radius[i];
    }
    return status;
}

/// Centre and radius of the circle through three points; an infinite radius for a triangle that is flat to round-off.
static double circumcircle(const double *a, const double *b, const double *c, double centre[2])
{
    double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
    double uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1], twice = 2 * (u[0] * v[1] - u[1] * v[0]);
    if (!(twice > 1e-9 * (uu + vv))) return INFINITY;
    double x = (v[1] * uu - u[1] * vv) / twice, y = (u[0] * vv - v[0] * uu) / twice;
    centre[0] = a[0] + x;
    centre[1] = a[1] + y;
    return sqrt(x * x + y * y);
}

/// A little more than a circle, for round-off.
static bool reaches(double dx, double dy, double radius)
{
    return dx * dx + dy * dy < radius * radius * (1 + 1e-9);
}

static bool touches_ring(const band *b, const double centre[2], double radius)
{
    for (size_t r = 0; r < b->ring_count; r++) {
        double low[2] = {b->origin[0] + b->cell * (double)(b->ring[r] % b->size[0]),
                         b->origin[1] + b->cell * (double)(b->ring[r] / b->size[0])};
        double dx = centre[0] - fmin(fmax(centre[0], low[0]), low[0] + b->cell);
        double dy = centre[1] - fmin(fmax(centre[1], low[1]), low[1] + b->cell);
        if (reaches(dx, dy, radius)) return true;
    }
    return false;
}

static bool holds_left_out(const band *b, const double *points, size_t count, const double centre[2], double radius)
{
    for (size_t i = 0; i < count; i++) {
        const double *p = points + 2 * i;
        if (reaches(p[0] - centre[0], p[1] - centre[1], radius) && b->depth[cell_of(b, p)] == INSIDE) return true;
    }
    return false;
}

/// No circle of a triangle along the loop holds a left-out point. Flat triangles occur only on the hull, which the band
/// shares with the whole: their circle is the empty half-plane outside.
static bool is_certain(const band *b, const double *points, size_t count, const scree_triangulation *triangulation,
                       const uint8_t *marks)
{
    for (size_t t = 0; t < triangulation->count; t++) {
        if (marks[t] == SCREE_TRIANGLE_INSIDE) continue;
        const uint32_t *v = triangulation->vertex[t];
        double centre[2], radius = circumcircle(b->points + 2 * (size_t)v[0], b->points + 2 * (size_t)v[1],
                                                b->points + 2 * (size_t)v[2], centre);
        if (!isinf(radius) && touches_ring(b, centre, radius) && holds_left_out(b, points, count, centre, radius))
            return false;
    }
    return true;
}

/// The loop of the whole from the band, in indices of the whole; *certain false (and no loop) when it may be another
/// one.
static scree_status loop_of_band(const band *b, const double *points, size_t count, double gap_limit, uint32_t **loop,
                                 size_t *loop_count, bool *certain, scree_error *error)
{
    scree_triangulation triangulation;
    uint8_t *marks = NULL;
    scree_status status = scree_triangulation_build(b->points, b->count, &triangulation, error);
    if (!status) status = scree_allocate(&marks, triangulation.count, sizeof *marks, error);
    if (!status)
        status = scree_boundary_loop(&triangulation, b->points, b->radius, b->count, gap_limit, loop, loop_count, marks,
                                     error);
    *certain = !status && is_certain(b, points, count, &triangulation, marks);
    for (size_t k = 0; k < *loop_count; k++) (*loop)[k] = b->index[(*loop)[k]];
    if (!*certain) {
        scree_release(loop);
        *loop_count = 0;
    }
    scree_release(&marks);
    scree_triangulation_destroy(&triangulation);
    return status;
}

static scree_status loop_of_all(const double *points, const double *radius, size_t count, double gap_limit,
                                uint32_t **loop, size_t *loop_count, scree_error *error)
{
    scree_triangulation triangulation;
    scree_status status = scree_triangulation_build(points, count, &triangulation, error);
    if (!status)
        status = scree_boundary_loop(&triangulation, points, radius, count, gap_limit, loop, loop_count, NULL, error);
    scree_triangulation_destroy(&triangulation);
    return status;
}

scree_status scree_outer_loop(const double *points, const double *radius, size_t count, double spacing,
                              double gap_limit, uint32_t **loop, size_t *loop_count, scree_error *error)
{
    *loop = NULL;
    *loop_count = 0;
    band b = {0};
    bool certain = false;
    scree_status status = SCREE_OK;
    if (lay_grid(&b, points, count, spacing)) {
        status = flood(&b, points, count, error);
        if (!status) status = gather(&b, points, radius, count, error);
        if (!status && b.count < count && b.count >= 3)
            status = loop_of_band(&b, points, count, gap_limit, loop, loop_count, &certain, error);
    }
    band_destroy(&b);
    if (status || certain) return status;
    return loop_of_all(points, radius, count, gap_limit, loop, loop_count, error);
}
