/// Levels, order and cells: see the head of cell_grid.h.
#include "search/cell_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Cells from the origin at which coordinates are cut off: what is left fits into the bits of a key.
#define FARTHEST(dimension) ((dimension) == 3 ? 0x1p19 : 0x1p30)
/// Cells are wider than they need be by this part: round-off of a coordinate stays below 2^-22 cells.
#define WIDENING (1.0 + 0x1p-20)

/// Coordinate of the cell at `position`, a whole number; not a number goes to the lowest.
static double cell_coordinate(double position, double inverse_width, double farthest)
{
    double coordinate = floor(position * inverse_width);
    coordinate = coordinate > -farthest ? coordinate : -farthest;
    return coordinate < farthest ? coordinate : farthest;
}

void scree_cell_grid_fit(scree_cell_grid *grid, const scree_state *state, double skin)
{
    const bool in_3d = state->dimension == 3;
    double smallest = INFINITY, largest = 0, x = INFINITY, y = INFINITY, z = INFINITY;
    uint64_t odd = UINT64_MAX;
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        smallest = row->radius < smallest ? row->radius : smallest;
        largest = row->radius > largest ? row->radius : largest;
        x = row->x < x ? row->x : x;
        y = row->y < y ? row->y : y;
        double height = in_3d ? row->z : 0;
        z = height < z ? height : z;
        if (!isfinite(row->x + row->y + height) && state->id[k] < odd) odd = state->id[k];
    }
    double width = (2 * largest + skin) * WIDENING;
    if (!(width > 0 && width < INFINITY)) width = 1;
    int top = 0;
    while (top < SCREE_CELL_LEVELS - 1 && ldexp(width, -top - 1) >= (2 * smallest + skin) * WIDENING) top++;
    grid->dimension = state->dimension;
    grid->skin = skin;
    grid->top = top;
    for (int m = 0; m <= top; m++) grid->level[m] = (scree_cell_level){.width = ldexp(width, m - top)};
    const double least[3] = {x, y, z};
    for (int axis = 0; axis < 3; axis++)
        grid->lowest[axis] = cell_coordinate(least[axis], 1 / grid->level[0].width, FARTHEST(grid->dimension));
    grid->finite = odd == UINT64_MAX;
    grid->odd_id = odd;
}

static int level_of(const scree_cell_grid *grid, double radius)
{
    int m = 0;
    while (m < grid->top && (2 * radius + grid->skin) * WIDENING > grid->level[m].width) m++;
    return m;
}

static void destroy_bodies(scree_cell_grid *grid)
{
    void *const arrays[] = {&grid->body_level, &grid->x, &grid->y, &grid->z, &grid->radius, &grid->row, &grid->id};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    grid->body_capacity = 0;
}

static scree_status reserve_bodies(scree_cell_grid *grid, size_t count, scree_error *error)
{
    if (count <= grid->body_capacity) return SCREE_OK;
    size_t capacity = count + count / 8 + 64, slots = capacity + SCREE_SLOT_PADDING;
    destroy_bodies(grid);
    scree_status status = scree_allocate(&grid->body_level, capacity, sizeof *grid->body_level, error);
    if (!status) status = scree_allocate(&grid->x, slots, sizeof *grid->x, error);
    if (!status) status = scree_allocate(&grid->y, slots, sizeof *grid->y, error);
    if (!status && grid->dimension == 3) status = scree_allocate(&grid->z, slots, sizeof *grid->z, error);
    if (!status) status = scree_allocate(&grid->radius, slots, sizeof *grid->radius, error);
    if (!status) status = scree_allocate(&grid->row, slots, sizeof *grid->row, error);
    if (!status) status = scree_allocate(&grid->id, slots, sizeof *grid->id, error);
    if (status)
        destroy_bodies(grid);
    else
        grid->body_capacity = capacity;
    return status;
}

static int by_id(const void *a, const void *b, void *ids)
{
    const uint32_t *id = ids, one = id[*(const uint32_t *)a], other = id[*(const uint32_t *)b];
    return one > other ? 1 : one < other ? -1 : 0;
}

/// Bodies of one cell in the order of their ids. Cells hold a few.
static void order_cells(const scree_state *state, scree_key_list *list, size_t count)
{
    const uint32_t *id = state->id;
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && list->key[end] == list->key[first]; end++) continue;
        if (end - first > 16) {
            qsort_r(&list->index[first], end - first, sizeof *list->index, by_id, state->id);
            continue;
        }
        for (size_t k = first + 1; k < end; k++) {
            const uint32_t moving = list->index[k];
            size_t at = k;
            for (; at > first && id[list->index[at - 1]] > id[moving]; at--) list->index[at] = list->index[at - 1];
            list->index[at] = moving;
        }
    }
}

scree_status scree_cell_grid_order(scree_cell_grid *grid, const scree_state *state, scree_error *error)
{
    scree_status status = reserve_bodies(grid, state->count, error);
    if (!status) status = scree_key_list_reserve(&grid->curve, state->count, error);
    if (status) return status;
    const double inverse = 1 / grid->level[0].width, farthest = FARTHEST(grid->dimension);
    const double *lowest = grid->lowest;
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        // What is not a number has a coordinate below the lowest.
        uint32_t x = (uint32_t)fmax(cell_coordinate(row->x, inverse, farthest) - lowest[0], 0);
        uint32_t y = (uint32_t)fmax(cell_coordinate(row->y, inverse, farthest) - lowest[1], 0);
        grid->curve.index[k] = (uint32_t)k;
        if (grid->dimension == 3) {
            uint32_t z = (uint32_t)fmax(cell_coordinate(row->z, inverse, farthest) - lowest[2], 0);
            grid->curve.key[k] = scree_curve_key_3d(x, y, z);
        } else
            grid->curve.key[k] = scree_curve_key(x, y);
    }
    scree_key_list_sort(&grid->curve, state->count);
    order_cells(state, &grid->curve, state->count);
    grid->order = grid->curve.index;
    return SCREE_OK;
}

/// Makes room for `count` cells in all, keeping those that are there, and for sorting `scratch` of them.
static scree_status reserve_cells(scree_cell_grid *grid, size_t kept, size_t count, size_t scratch, scree_error *error)
{
    scree_status status = scree_key_list_reserve(&grid->sorted, scratch + 1, error);
    if (status || count <= grid->cell_capacity) return status;
    size_t capacity = count + count / 8 + 64;
    size_t ranges = SCREE_CELL_ROWS(grid->dimension);
    status = scree_reallocate(&grid->cell_row, kept, capacity, sizeof *grid->cell_row, error);
    if (!status) status = scree_reallocate(&grid->range, kept * ranges, capacity * ranges, sizeof *grid->range, error);
    if (!status) grid->cell_capacity = capacity;
    return status;
}

/// Number of cells of level m that bodies of this level and those below lie in: runs of equal keys along the curve.
static size_t count_cells(const scree_cell_grid *grid, size_t bodies, int m)
{
    size_t cells = 0;
    uint64_t last = UINT64_MAX;
    for (size_t k = 0; k < bodies; k++) {
        uint64_t key = grid->curve.key[k] >> grid->dimension * m;
        bool opens = grid->body_level[k] <= m && key != last;
        cells += opens;
        last = opens ? key : last;
    }
    return cells;
}

/// Finds the cells of level m along the curve: first row, number of bodies of the level (left in the first of its
/// ranges), and key.
static void find_cells(scree_cell_grid *grid, size_t bodies, int m)
{
    scree_cell_level *level = &grid->level[m];
    const size_t ranges = SCREE_CELL_ROWS(grid->dimension);
    uint32_t *cell_row = grid->cell_row + level->first_cell;
    scree_slot_range *range = grid->range + level->first_cell * ranges;
    uint64_t last = UINT64_MAX;
    size_t cells = 0;
    for (size_t k = 0; k < bodies; k++) {
        uint64_t key = grid->curve.key[k] >> grid->dimension * m;
        if (grid->body_level[k] > m) continue;
        if (key != last) {
            cell_row[cells] = (uint32_t)k;
            range[cells * ranges].begin = 0;
            grid->sorted.key[cells++] = last = key;
        }
        range[(cells - 1) * ranges].begin += grid->body_level[k] == m;
    }
}

/// Replaces the keys of the `cells` in grid->sorted by plane, row and column, one beside the other in one number, and
/// sorts by them. Coordinates are counted from 1, and the last has a neighbour, so a step to the row or plane beside is
/// a constant difference. Fills `step` with the differences of the middles of the SCREE_CELL_ROWS rows around a cell.
static void sort_cells(scree_cell_grid *grid, size_t cells, uint64_t *step)
{
    const bool in_3d = grid->dimension == 3;
    uint64_t *key = grid->sorted.key;
    uint32_t column = 0, row = 0;
    for (size_t k = 0; k < cells; k++) {
        column |= in_3d ? scree_curve_gather_3d(key[k]) : scree_curve_gather(key[k]);
        if (in_3d) row |= scree_curve_gather_3d(key[k] >> 1);
    }
    // Coordinates are at most 2^20 in 3D and 2^31 in 2D (twice FARTHEST), which bounds what their neighbours need.
    int most = in_3d ? 21 : 32;
    int column_bits = 64 - __builtin_clzll((uint64_t)column + 2), row_bits = 64 - __builtin_clzll((uint64_t)row + 2);
    column_bits = column_bits < most ? column_bits : most;
    row_bits = row_bits < most ? row_bits : most;
    for (size_t k = 0; k < cells; k++) {
        uint64_t one = key[k], other;
        if (in_3d) {
            other = ((uint64_t)scree_curve_gather_3d(one >> 2) + 1) << row_bits;
            other = (other + scree_curve_gather_3d(one >> 1) + 1) << column_bits;
            other += (uint64_t)scree_curve_gather_3d(one) + 1;
        } else {
            other = ((uint64_t)scree_curve_gather(one >> 1) + 1) << column_bits;
            other += (uint64_t)scree_curve_gather(one) + 1;
        }
        key[k] = other;
        grid->sorted.index[k] = (uint32_t)k;
    }
    scree_key_list_sort(&grid->sorted, cells);
    const int64_t beside = INT64_C(1) << column_bits, above = in_3d ? INT64_C(1) << (column_bits + row_bits) : 0;
    for (int d = 0; d < SCREE_CELL_ROWS(grid->dimension); d++)
        step[d] = (uint64_t)((in_3d ? d / 3 - 1 : 0) * above + (d % 3 - 1) * beside);
}

/// Copies the bodies of level m into their slots: row by row of cells, within a cell along the curve.
static void fill_slots(scree_cell_grid *grid, const scree_state *state, int m, uint32_t first_slot)
{
    const scree_cell_level *level = &grid->level[m];
    const size_t ranges = SCREE_CELL_ROWS(grid->dimension);
    scree_slot_range *range = grid->range + level->first_cell * ranges;
    uint32_t *first = grid->sorted.other_index, slot = first_slot;
    for (size_t k = 0; k < level->cells; k++) {
        scree_slot_range *cell = &range[grid->sorted.index[k] * ranges];
        first[k] = slot;
        slot += cell->begin;
        cell->begin = first[k];
    }
    first[level->cells] = slot;
    uint64_t last = UINT64_MAX;
    size_t cell = SIZE_MAX;
    for (size_t k = 0; k < state->count; k++) {
        if (grid->body_level[k] > m) continue;
        uint64_t key = grid->curve.key[k] >> grid->dimension * m;
        cell += key != last;
        last = key;
        if (grid->body_level[k] < m) continue;
        uint32_t to = range[cell * ranges].begin++;
        const scree_row *row = &state->row[k];
        grid->x[to] = row->x;
        grid->y[to] = row->y;
        if (grid->dimension == 3) grid->z[to] = row->z;
        grid->radius[to] = row->radius;
        grid->row[to] = (uint32_t)k;
        grid->id[to] = state->id[k];
    }
}

/// Gives every cell of level m its ranges of slots. All cursors only move forward. `own`: only bodies of the level
/// itself look here, each for higher rows; cells that lie before theirs on the curve are then left out at the ends.
static inline __attribute__((always_inline)) void find_ranges(scree_cell_grid *grid, int m, const uint64_t *step,
                                                              const int ranges, const bool own)
{
    const scree_cell_level *level = &grid->level[m];
    scree_slot_range *range = grid->range + level->first_cell * (size_t)ranges;
    const uint64_t *key = grid->sorted.key;
    const uint32_t *first = grid->sorted.other_index, *position = grid->sorted.index;
    size_t begin[9] = {0}, end[9] = {0};
    for (size_t k = 0; k < level->cells; k++) {
        scree_slot_range *cell = &range[grid->sorted.index[k] * (size_t)ranges];
        for (int d = 0; d < ranges; d++) {
            uint64_t middle = key[k] + step[d];
            while (begin[d] < level->cells && key[begin[d]] < middle - 1) begin[d]++;
            while (end[d] < level->cells && key[end[d]] <= middle + 1) end[d]++;
            size_t from = begin[d], to = end[d];
            while (own && from < to && position[from] < position[k]) from++;
            while (own && from < to && position[to - 1] < position[k]) to--;
            cell[d] = (scree_slot_range){first[from], first[to]};
        }
    }
}

static scree_status fill_level(scree_cell_grid *grid, const scree_state *state, int m, size_t cells_before,
                               uint32_t first_slot, scree_error *error)
{
    scree_cell_level *level = &grid->level[m];
    uint64_t step[9];
    level->first_cell = cells_before;
    level->cells = count_cells(grid, state->count, m);
    scree_status status = reserve_cells(grid, cells_before, cells_before + level->cells, level->cells, error);
    if (status) return status;
    find_cells(grid, state->count, m);
    sort_cells(grid, level->cells, step);
    fill_slots(grid, state, m, first_slot);
    const bool lowest = grid->levels_in_use == 1;
    if (grid->dimension == 3)
        find_ranges(grid, m, step, SCREE_CELL_ROWS(3), lowest);
    else
        find_ranges(grid, m, step, SCREE_CELL_ROWS(2), lowest);
    return SCREE_OK;
}

scree_status scree_cell_grid_fill(scree_cell_grid *grid, const scree_state *state, scree_error *error)
{
    grid->levels_in_use = 0;
    for (size_t k = 0; k < state->count; k++) {
        int m = level_of(grid, state->row[k].radius);
        grid->body_level[k] = (uint8_t)m;
        grid->level[m].bodies++;
    }
    size_t cells = 0, slots = 0;
    scree_status status = SCREE_OK;
    for (int m = 0; m <= grid->top && !status; m++) {
        if (grid->level[m].bodies == 0) continue;
        grid->levels_in_use++;
        status = fill_level(grid, state, m, cells, (uint32_t)slots, error);
        cells += grid->level[m].cells;
        slots += grid->level[m].bodies;
    }
    return status;
}

void scree_cell_grid_destroy(scree_cell_grid *grid)
{
    destroy_bodies(grid);
    scree_key_list_destroy(&grid->curve);
    scree_key_list_destroy(&grid->sorted);
    scree_release(&grid->cell_row);
    scree_release(&grid->range);
    memset(grid, 0, sizeof *grid);
}
