/// A cell grid is flooded from outside through empty cells; the points of the cells at most DEPTH steps behind the
/// flood are the band. Where a circle (sphere) holds points that it leaves out, it is extended by the cells that the
/// circle touches and those beside them; of a large circle only by those near its corners, since a point there is
/// enough to show that the simplex is none of the whole. Of 4000 discs 800 are in the band, of a million 12,000; of
/// 100,000 spheres about 32,000. Cost: O(n); of the question whether a circle holds a left-out point: the cells in the
/// box around it, and the points in those that are left out and touched.
#include "search/band.h"

#include <math.h>

/// Edge of a cell in spacings, and the depth of the band in cells.
#define CELL_SPACINGS 1.5
#define DEPTH         2
/// A step of depth goes across this many coordinates at most: in the plane also across corners, in space across faces
/// only, or most of a packing would be in the band.
static const int step_across[] = {[2] = 2, [3] = 1};
/// A cell that is to join the band.
#define WANTED (SCREE_BAND_INSIDE - 1)
/// Reach of what is taken around the corners of a large circle, in cells.
#define REACH 1.0
/// Extensions that are tried before all points are taken.
#define ROUNDS 3
/// A band of nearly all points saves nothing.
#define LARGEST_SHARE 0.6

/// Cells from low to high, both included.
typedef struct cell_box {
    size_t low[3], high[3];
} cell_box;

void scree_band_destroy(scree_band *b)
{
    scree_release(&b->end);
    scree_release(&b->order);
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
static bool lay_grid(scree_band *b, double spacing)
{
    const double *points = b->all_points;
    size_t dimension = (size_t)b->dimension, count = b->all_count;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < dimension * count; i++) {
        if (!isfinite(points[i])) return false;
        low[i % dimension] = fmin(low[i % dimension], points[i]);
        high[i % dimension] = fmax(high[i % dimension], points[i]);
    }
    b->cell = CELL_SPACINGS * spacing;
    double cells[3] = {1, 1, 1};
    for (size_t k = 0; k < dimension; k++) {
        cells[k] = floor((high[k] - low[k]) / b->cell) + 4;
        b->origin[k] = low[k] - 1.5 * b->cell;
    }
    if (!(cells[0] * cells[1] * cells[2] <= 4 * (double)count + 1024)) return false;
    for (int k = 0; k < 3; k++) b->size[k] = (size_t)cells[k];
    return true;
}

/// Points by cell.
static scree_status sort_points(scree_band *b, scree_error *error)
{
    size_t cells = b->size[0] * b->size[1] * b->size[2], dimension = (size_t)b->dimension;
    scree_status status = scree_allocate(&b->end, cells + 1, sizeof *b->end, error);
    if (!status) status = scree_allocate(&b->order, b->all_count, sizeof *b->order, error);
    if (status) return status;
    for (size_t i = 0; i < b->all_count; i++) b->end[cell_of(b, b->all_points + dimension * i) + 1]++;
    for (size_t c = 0; c < cells; c++) b->end[c + 1] += b->end[c];
    // Filling advances the start of each cell to its end, which is the start of the next one.
    for (size_t i = 0; i < b->all_count; i++) {
        uint32_t *position = &b->end[cell_of(b, b->all_points + dimension * i)];
        b->order[(*position)++] = (uint32_t)i;
    }
    return SCREE_OK;
}

static size_t begin_of(const scree_band *b, size_t cell)
{
    return cell > 0 ? b->end[cell - 1] : 0;
}

static void reach(scree_band *b, size_t cell, uint8_t depth)
{
    b->depth[cell] = depth;
    b->queue[b->queued++] = (uint32_t)cell;
}

/// Reaches the neighbours of a cell that the flood has not reached yet: at depth zero the empty ones across faces,
/// behind it all that are one step away.
static void spread(scree_band *b, size_t cell, uint8_t depth)
{
    const size_t *size = b->size;
    size_t position[3] = {cell % size[0], cell / size[0] % size[1], cell / size[0] / size[1]};
    size_t low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = position[k] > 0 ? position[k] - 1 : 0;
        high[k] = position[k] + 1 < size[k] ? position[k] + 1 : position[k];
    }
    for (size_t z = low[2]; z <= high[2]; z++)
        for (size_t y = low[1]; y <= high[1]; y++)
            for (size_t x = low[0]; x <= high[0]; x++) {
                size_t other = (z * size[1] + y) * size[0] + x;
                int moved = (x != position[0]) + (y != position[1]) + (z != position[2]);
                bool empty = b->end[other] == begin_of(b, other);
                bool open = depth > 0 ? moved <= step_across[b->dimension] : empty && moved == 1;
                if (open && b->depth[other] == SCREE_BAND_INSIDE) reach(b, other, depth);
            }
}

/// Depth of every cell.
static scree_status flood(scree_band *b, scree_error *error)
{
    size_t cells = b->size[0] * b->size[1] * b->size[2], begin = 0;
    scree_status status = scree_allocate(&b->depth, cells, sizeof *b->depth, error);
    if (!status) status = scree_allocate(&b->queue, cells, sizeof *b->queue, error);
    if (status) return status;
    for (size_t c = 0; c < cells; c++) b->depth[c] = SCREE_BAND_INSIDE;
    reach(b, 0, 0); // a corner of the empty ring around the points
    while (begin < b->queued) spread(b, b->queue[begin++], 0);
    begin = 0;
    for (uint8_t depth = 1; depth <= DEPTH; depth++)
        for (size_t end = b->queued; begin < end; begin++) spread(b, b->queue[begin], depth);
    return SCREE_OK;
}

/// The points of the band; none when it does not pay.
static scree_status gather(scree_band *b, scree_error *error)
{
    size_t dimension = (size_t)b->dimension, cells = b->size[0] * b->size[1] * b->size[2], found = 0;
    for (size_t c = 0; c < cells; c++) {
        if (b->depth[c] == WANTED) b->depth[c] = DEPTH;
        if (b->depth[c] != SCREE_BAND_INSIDE) found += b->end[c] - begin_of(b, c);
    }
    b->count = 0;
    if (found <= dimension || (double)found > LARGEST_SHARE * (double)b->all_count) return SCREE_OK;
    scree_release(&b->index);
    scree_release(&b->points);
    scree_release(&b->radius);
    scree_status status = scree_allocate(&b->index, found, sizeof *b->index, error);
    if (!status) status = scree_allocate(&b->points, dimension * found, sizeof *b->points, error);
    if (!status) status = scree_allocate(&b->radius, found, sizeof *b->radius, error);
    for (size_t i = 0; i < b->all_count && !status; i++) {
        const double *point = b->all_points + dimension * i;
        if (b->depth[cell_of(b, point)] == SCREE_BAND_INSIDE) continue;
        b->index[b->count] = (uint32_t)i;
        for (size_t k = 0; k < dimension; k++) b->points[dimension * b->count + k] = point[k];
        b->radius[b->count++] = b->all_radius[i];
    }
    return status;
}

scree_status scree_band_build(const double *points, const double *radius, size_t count, int dimension, double spacing,
                              scree_band *b, scree_error *error)
{
    *b = (scree_band){.dimension = dimension, .all_points = points, .all_radius = radius, .all_count = count};
    if (!lay_grid(b, spacing)) return SCREE_OK;
    scree_status status = sort_points(b, error);
    if (!status) status = flood(b, error);
    if (!status) status = gather(b, error);
    if (status) scree_band_destroy(b);
    return status;
}

scree_status scree_band_extend(scree_band *b, scree_error *error)
{
    b->count = 0;
    return b->rounds++ < ROUNDS ? gather(b, error) : SCREE_OK;
}

/// A little more than a sphere, for round-off.
static bool reaches(double square, double radius)
{
    return square < radius * radius * (1 + 1e-9);
}

/// Whether a point of a cell lies in the sphere.
static bool holds_one(const scree_band *b, size_t cell, const double *centre, double radius)
{
    for (size_t n = begin_of(b, cell); n < b->end[cell]; n++) {
        const double *p = b->all_points + (size_t)b->dimension * b->order[n];
        double square = 0;
        for (int k = 0; k < b->dimension; k++) square += (p[k] - centre[k]) * (p[k] - centre[k]);
        if (reaches(square, radius)) return true;
    }
    return false;
}

/// Square of the distance along one axis from `position` to the cells of index `index`.
static double square_to(const scree_band *b, int axis, size_t index, double position)
{
    double low = b->origin[axis] + b->cell * (double)index, apart = position - fmin(fmax(position, low), low + b->cell);
    return apart * apart;
}

/// The cells of a cube; a margin of one covers round-off.
static cell_box box_around(const scree_band *b, const double *centre, double reach)
{
    cell_box box = {0};
    for (int k = 0; k < b->dimension; k++) {
        double last = (double)(b->size[k] - 1), position = centre[k] - b->origin[k];
        box.low[k] = (size_t)fmax(0, fmin(last, floor((position - reach) / b->cell) - 1));
        box.high[k] = (size_t)fmax(0, fmin(last, floor((position + reach) / b->cell) + 1));
    }
    return box;
}

/// Whether a cell of the box that is left out and touched by the sphere holds a point in it; with `take` all cells that
/// are touched join the band.
static bool search_box(scree_band *b, cell_box box, const double *centre, double radius, bool take)
{
    for (size_t z = box.low[2]; z <= box.high[2]; z++) {
        double across = b->dimension == 3 ? square_to(b, 2, z, centre[2]) : 0;
        if (!reaches(across, radius)) continue;
        for (size_t y = box.low[1]; y <= box.high[1]; y++) {
            double row = across + square_to(b, 1, y, centre[1]);
            size_t first = (z * b->size[1] + y) * b->size[0];
            if (!reaches(row, radius)) continue;
            for (size_t x = box.low[0]; x <= box.high[0]; x++) {
                if (b->depth[first + x] < WANTED) continue;
                if (!reaches(row + square_to(b, 0, x, centre[0]), radius)) continue;
                if (take)
                    b->depth[first + x] = WANTED;
                else if (holds_one(b, first + x, centre, radius))
                    return true;
            }
        }
    }
    return false;
}

/// Whether the sphere holds a left-out point in the box; if so the cells that it touches, and those beside them, join.
static bool wants_in_box(scree_band *b, cell_box box, const double *centre, double radius)
{
    if (!search_box(b, box, centre, radius, false)) return false;
    search_box(b, box, centre, radius + b->cell, true);
    return true;
}

bool scree_band_wants(scree_band *b, const double *const *corner, const double *centre, double radius)
{
    bool wanted = false;
    // Of a large sphere the points near its corners are enough to do away with it.
    for (int k = 0; k <= b->dimension && radius > 2 * b->cell; k++)
        wanted = wants_in_box(b, box_around(b, corner[k], REACH * b->cell), centre, radius) || wanted;
    return wanted || wants_in_box(b, box_around(b, centre, radius), centre, radius);
}
