/// A cell grid is flooded from outside through empty cells; the points at most DEPTH cells behind the flood are the
/// band. In a packing it is two to three diameters deep: of 4000 discs 800 are in it, of a million 12,000; of 100,000
/// spheres 35,000 to 45,000. Cost: O(n); of the question whether a sphere holds a left-out point: the cells in the box
/// around it, and O(n) if one of them is left out and touched.
#include "search/band.h"

#include <math.h>

/// Edge of a cell in spacings by dimension, and the depth of the band in cells. In space smaller cells cost little, and
/// the flood follows the surface more closely.
static const double cell_spacings[] = {[2] = 1.5, [3] = 1.0};
#define DEPTH 2

void scree_band_destroy(scree_band *b)
{
    scree_release(&b->depth);
    scree_release(&b->queue);
    scree_release(&b->index);
    scree_release(&b->points);
    scree_release(&b->radius);
}

static size_t cell_of(const scree_band *b, const double *point)
{
    size_t cell = 0;
    for (int k = b->dimension - 1; k >= 0; k--)
        cell = cell * b->size[k] + (size_t)((point[k] - b->origin[k]) / b->cell);
    return cell;
}

/// Lays the grid; false when it would have many more cells than there are points (a body far away), or when one is not
/// finite.
static bool lay_grid(scree_band *b, const double *points, size_t count, double spacing)
{
    size_t dimension = (size_t)b->dimension;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < dimension * count; i++) {
        if (!isfinite(points[i])) return false;
        low[i % dimension] = fmin(low[i % dimension], points[i]);
        high[i % dimension] = fmax(high[i % dimension], points[i]);
    }
    b->cell = cell_spacings[dimension] * spacing;
    double cells[3] = {1, 1, 1};
    for (size_t k = 0; k < dimension; k++) {
        cells[k] = floor((high[k] - low[k]) / b->cell) + 4;
        b->origin[k] = low[k] - 1.5 * b->cell;
    }
    if (!(cells[0] * cells[1] * cells[2] <= 4 * (double)count + 1024)) return false;
    for (int k = 0; k < 3; k++) b->size[k] = (size_t)cells[k];
    return true;
}

static void reach(scree_band *b, size_t cell, uint8_t depth)
{
    b->depth[cell] = depth;
    b->queue[b->queued++] = (uint32_t)cell;
}

/// Reaches the neighbours of a cell that the flood has not reached yet: `empty` tells which may be flooded, across
/// faces only; NULL: all, also across edges and corners.
static void spread(scree_band *b, size_t cell, uint8_t depth, const uint8_t *empty)
{
    const size_t *size = b->size;
    size_t place[3] = {cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]};
    size_t low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = place[k] > 0 ? place[k] - 1 : 0;
        high[k] = place[k] + 1 < size[k] ? place[k] + 1 : place[k];
    }
    for (size_t z = low[2]; z <= high[2]; z++)
        for (size_t y = low[1]; y <= high[1]; y++)
            for (size_t x = low[0]; x <= high[0]; x++) {
                size_t other = (z * size[1] + y) * size[0] + x;
                int moved = (x != place[0]) + (y != place[1]) + (z != place[2]);
                if (b->depth[other] == SCREE_BAND_INSIDE && (!empty || (empty[other] && moved == 1)))
                    reach(b, other, depth);
            }
}

/// Depth of every cell.
static scree_status flood(scree_band *b, const double *points, size_t count, scree_error *error)
{
    size_t cells = b->size[0] * b->size[1] * b->size[2], begin = 0;
    uint8_t *empty = NULL;
    scree_status status = scree_allocate(&empty, cells, sizeof *empty, error);
    if (!status) status = scree_allocate(&b->depth, cells, sizeof *b->depth, error);
    if (!status) status = scree_allocate(&b->queue, cells, sizeof *b->queue, error);
    if (!status) {
        for (size_t c = 0; c < cells; c++) {
            b->depth[c] = SCREE_BAND_INSIDE;
            empty[c] = 1;
        }
        for (size_t i = 0; i < count; i++) empty[cell_of(b, points + (size_t)b->dimension * i)] = 0;
        reach(b, 0, 0); // a corner of the empty ring around the points
        while (begin < b->queued) spread(b, b->queue[begin++], 0, empty);
        begin = 0;
        for (uint8_t depth = 1; depth <= DEPTH; depth++)
            for (size_t end = b->queued; begin < end; begin++) spread(b, b->queue[begin], depth, NULL);
    }
    scree_release(&empty);
    return status;
}

/// The points of the band; none when they are all the points.
static scree_status gather(scree_band *b, const double *points, const double *radius, size_t count, scree_error *error)
{
    size_t dimension = (size_t)b->dimension, found = 0;
    for (size_t i = 0; i < count; i++) found += b->depth[cell_of(b, points + dimension * i)] != SCREE_BAND_INSIDE;
    if (found == count) return SCREE_OK;
    scree_status status = scree_allocate(&b->index, found, sizeof *b->index, error);
    if (!status) status = scree_allocate(&b->points, dimension * found, sizeof *b->points, error);
    if (!status) status = scree_allocate(&b->radius, found, sizeof *b->radius, error);
    for (size_t i = 0; i < count && !status; i++) {
        if (b->depth[cell_of(b, points + dimension * i)] == SCREE_BAND_INSIDE) continue;
        b->index[b->count] = (uint32_t)i;
        for (size_t k = 0; k < dimension; k++) b->points[dimension * b->count + k] = points[dimension * i + k];
        b->radius[b->count++] = radius[i];
    }
    return status;
}

scree_status scree_band_build(const double *points, const double *radius, size_t count, int dimension, double spacing,
                              scree_band *b, scree_error *error)
{
    *b = (scree_band){.dimension = dimension};
    if (!lay_grid(b, points, count, spacing)) return SCREE_OK;
    scree_status status = flood(b, points, count, error);
    if (!status) status = gather(b, points, radius, count, error);
    if (status) scree_band_destroy(b);
    return status;
}

/// A little more than a sphere, for round-off.
static bool reaches(double square, double radius)
{
    return square < radius * radius * (1 + 1e-9);
}

static bool holds_left_out(const scree_band *b, const double *points, size_t count, const double *centre, double radius)
{
    for (size_t i = 0; i < count; i++) {
        const double *p = points + (size_t)b->dimension * i;
        double square = 0;
        for (int k = 0; k < b->dimension; k++) square += (p[k] - centre[k]) * (p[k] - centre[k]);
        if (reaches(square, radius) && b->depth[cell_of(b, p)] == SCREE_BAND_INSIDE) return true;
    }
    return false;
}

/// Square of the distance along one axis from `place` to the cells of index `index`.
static double square_to(const scree_band *b, int axis, size_t index, double place)
{
    double low = b->origin[axis] + b->cell * (double)index, apart = place - fmin(fmax(place, low), low + b->cell);
    return apart * apart;
}

bool scree_band_leaves_out(const scree_band *b, const double *points, size_t count, const double *centre, double radius)
{
    // The cells of the box around the sphere; a margin of one covers round-off.
    size_t low[3] = {0}, high[3] = {0};
    for (int k = 0; k < b->dimension; k++) {
        double last = (double)(b->size[k] - 1), place = (centre[k] - b->origin[k]) / b->cell, reach = radius / b->cell;
        low[k] = (size_t)fmax(0, fmin(last, floor(place - reach) - 1));
        high[k] = (size_t)fmax(0, fmin(last, floor(place + reach) + 1));
    }
    for (size_t z = low[2]; z <= high[2]; z++) {
        double across = b->dimension == 3 ? square_to(b, 2, z, centre[2]) : 0;
        if (!reaches(across, radius)) continue;
        for (size_t y = low[1]; y <= high[1]; y++) {
            double row = across + square_to(b, 1, y, centre[1]);
            const uint8_t *depth = b->depth + (z * b->size[1] + y) * b->size[0];
            if (!reaches(row, radius)) continue;
            for (size_t x = low[0]; x <= high[0]; x++)
                if (depth[x] == SCREE_BAND_INSIDE && reaches(row + square_to(b, 0, x, centre[0]), radius))
                    return holds_left_out(b, points, count, centre, radius);
        }
    }
    return false;
}
