/// Levels, order and cells: see the head of cell_grid.h.
#include "search/cell_grid.h"

#include <math.h>
#include <string.h>

/// Cells from the origin at which coordinates are cut off.
#define FARTHEST 0x1p30
/// Cells are wider than they need be by this part: round-off of a coordinate stays below 2^-22 cells.
#define WIDENING (1.0 + 0x1p-20)

/// Coordinate of the cell at `position`, a whole number; not a number goes to the lowest.
static double cell_coordinate(double position, double inverse_width)
{
    double coordinate = floor(position * inverse_width);
    coordinate = coordinate > -FARTHEST ? coordinate : -FARTHEST;
    return coordinate < FARTHEST ? coordinate : FARTHEST;
}

void scree_cell_grid_fit(scree_cell_grid *grid, const scree_state *state, double skin, int threads)
{
    double smallest = INFINITY, largest = 0, x = INFINITY, y = INFINITY;
    uint64_t odd = UINT64_MAX;
// clang-format off
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1) \
    reduction(min : smallest, x, y, odd) reduction(max : largest)
    // clang-format on
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        smallest = row->radius < smallest ? row->radius : smallest;
        largest = row->radius > largest ? row->radius : largest;
        x = row->x < x ? row->x : x;
        y = row->y < y ? row->y : y;
        if (!isfinite(row->x + row->y) && state->id[k] < odd) odd = state->id[k];
    }
    double width = (2 * largest + skin) * WIDENING;
    if (!(width > 0 && width < INFINITY)) width = 1;
    int top = 0;
    while (top < SCREE_CELL_LEVELS - 1 && ldexp(width, -top - 1) >= (2 * smallest + skin) * WIDENING) top++;
    grid->skin = skin;
    grid->top = top;
    for (int m = 0; m <= top; m++) grid->level[m] = (scree_cell_level){.width = ldexp(width, m - top)};
    grid->lowest_x = cell_coordinate(x, 1 / grid->level[0].width);
    grid->lowest_y = cell_coordinate(y, 1 / grid->level[0].width);
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
    void *const arrays[] = {&grid->body_level, &grid->order, &grid->x, &grid->y, &grid->radius, &grid->row, &grid->id};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    grid->body_capacity = 0;
}

static scree_status reserve_bodies(scree_cell_grid *grid, size_t count, scree_error *error)
{
    if (count <= grid->body_capacity) return SCREE_OK;
    size_t capacity = count + count / 8 + 64, slots = capacity + SCREE_SLOT_PADDING;
    destroy_bodies(grid);
    scree_status status = scree_allocate(&grid->body_level, capacity, sizeof *grid->body_level, error);
    if (!status) status = scree_allocate(&grid->order, capacity, sizeof *grid->order, error);
    if (!status) status = scree_allocate(&grid->x, slots, sizeof *grid->x, error);
    if (!status) status = scree_allocate(&grid->y, slots, sizeof *grid->y, error);
    if (!status) status = scree_allocate(&grid->radius, slots, sizeof *grid->radius, error);
    if (!status) status = scree_allocate(&grid->row, slots, sizeof *grid->row, error);
    if (!status) status = scree_allocate(&grid->id, slots, sizeof *grid->id, error);
    if (status)
        destroy_bodies(grid);
    else
        grid->body_capacity = capacity;
    return status;
}

scree_status scree_cell_grid_order(scree_cell_grid *grid, const scree_state *state, int threads, scree_error *error)
{
    scree_status status = reserve_bodies(grid, state->count, error);
    if (!status) status = scree_key_list_reserve(&grid->curve, state->count, error);
    if (status) return status;
    const double inverse = 1 / grid->level[0].width;
    // Keys are put down by id: the stable sort then leaves bodies of one cell in the order of their ids.
#pragma omp parallel for num_threads(threads) schedule(static) if (threads > 1)
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        uint32_t id = state->id[k];
        // What is not a number has a coordinate below the lowest.
        double x = fmax(cell_coordinate(row->x, inverse) - grid->lowest_x, 0);
        double y = fmax(cell_coordinate(row->y, inverse) - grid->lowest_y, 0);
        grid->curve.key[id] = scree_curve_key((uint32_t)x, (uint32_t)y);
        grid->curve.index[id] = id;
    }
    scree_key_list_sort(&grid->curve, state->count);
    for (size_t k = 0; k < state->count; k++) grid->order[k] = state->row_of_id[grid->curve.index[k]];
    return SCREE_OK;
}

/// Makes room for `count` cells in all, keeping those that are there, and for sorting `scratch` of them.
static scree_status reserve_cells(scree_cell_grid *grid, size_t kept, size_t count, size_t scratch, scree_error *error)
{
    scree_status status = scree_key_list_reserve(&grid->sorted, scratch + 1, error);
    if (status || count <= grid->cell_capacity) return status;
    size_t capacity = count + count / 8 + 64;
    status = scree_reallocate(&grid->cell_row, kept, capacity, sizeof *grid->cell_row, error);
    if (!status) status = scree_reallocate(&grid->ranges, kept, capacity, sizeof *grid->ranges, error);
    if (!status) grid->cell_capacity = capacity;
    return status;
}

/// Number of cells of level m that bodies of this level and those below lie in: runs of equal keys along the curve.
static size_t count_cells(const scree_cell_grid *grid, size_t bodies, int m)
{
    size_t cells = 0;
    uint64_t last = UINT64_MAX;
    for (size_t k = 0; k < bodies; k++) {
        uint64_t key = grid->curve.key[k] >> 2 * m;
        bool opens = grid->body_level[k] <= m && key != last;
        cells += opens;
        last = opens ? key : last;
    }
    return cells;
}

/// Finds the cells of level m along the curve: first row, number of bodies of the level (left in begin[0] of its
/// ranges), and key. Returns the number of bits for a column.
static int find_cells(scree_cell_grid *grid, size_t bodies, int m)
{
    scree_cell_level *level = &grid->level[m];
    uint32_t *cell_row = grid->cell_row + level->first_cell, column = 0;
    scree_cell_ranges *ranges = grid->ranges + level->first_cell;
    uint64_t last = UINT64_MAX;
    size_t cells = 0;
    for (size_t k = 0; k < bodies; k++) {
        uint64_t key = grid->curve.key[k] >> 2 * m;
        if (grid->body_level[k] > m) continue;
        if (key != last) {
            cell_row[cells] = (uint32_t)k;
            ranges[cells].begin[0] = 0;
            grid->sorted.key[cells++] = last = key;
            column |= scree_curve_gather(key);
        }
        ranges[cells - 1].begin[0] += grid->body_level[k] == m;
    }
    // Columns are counted from 1, and the last has a neighbour.
    return column >= UINT32_MAX / 2 ? 32 : 32 - __builtin_clz(2 * column + 2);
}

/// Copies the bodies of level m into their slots: row by row of cells, within a cell along the curve.
static void fill_slots(scree_cell_grid *grid, const scree_state *state, int m, uint32_t first_slot)
{
    const scree_cell_level *level = &grid->level[m];
    scree_cell_ranges *ranges = grid->ranges + level->first_cell;
    uint32_t *first = grid->sorted.other_index, slot = first_slot;
    for (size_t k = 0; k < level->cells; k++) {
        scree_cell_ranges *cell = &ranges[grid->sorted.index[k]];
        first[k] = slot;
        slot += cell->begin[0];
        cell->begin[0] = first[k];
    }
    first[level->cells] = slot;
    uint64_t last = UINT64_MAX;
    size_t cell = SIZE_MAX;
    for (size_t k = 0; k < state->count; k++) {
        if (grid->body_level[k] > m) continue;
        uint64_t key = grid->curve.key[k] >> 2 * m;
        cell += key != last;
        last = key;
        if (grid->body_level[k] < m) continue;
        uint32_t to = ranges[cell].begin[0]++;
        const scree_row *row = &state->row[k];
        grid->x[to] = row->x;
        grid->y[to] = row->y;
        grid->radius[to] = row->radius;
        grid->row[to] = (uint32_t)k;
        grid->id[to] = state->id[k];
    }
}

/// Gives every cell of level m its three ranges of slots. All six cursors only move forward.
static void find_ranges(scree_cell_grid *grid, int m, int column_bits)
{
    const scree_cell_level *level = &grid->level[m];
    scree_cell_ranges *ranges = grid->ranges + level->first_cell;
    const uint64_t *key = grid->sorted.key;
    const uint32_t *first = grid->sorted.other_index;
    const uint64_t rows[3] = {-(UINT64_C(1) << column_bits), 0, UINT64_C(1) << column_bits};
    size_t begin[3] = {0}, end[3] = {0};
    for (size_t k = 0; k < level->cells; k++) {
        scree_cell_ranges *cell = &ranges[grid->sorted.index[k]];
        for (int d = 0; d < 3; d++) {
            uint64_t middle = key[k] + rows[d];
            while (begin[d] < level->cells && key[begin[d]] < middle - 1) begin[d]++;
            while (end[d] < level->cells && key[end[d]] <= middle + 1) end[d]++;
            cell->begin[d] = first[begin[d]];
            cell->end[d] = first[end[d]];
        }
    }
}

static scree_status fill_level(scree_cell_grid *grid, const scree_state *state, int m, size_t cells_before,
                               uint32_t first_slot, scree_error *error)
{
    scree_cell_level *level = &grid->level[m];
    level->first_cell = cells_before;
    level->cells = count_cells(grid, state->count, m);
    scree_status status = reserve_cells(grid, cells_before, cells_before + level->cells, level->cells, error);
    if (status) return status;
    int column_bits = find_cells(grid, state->count, m);
    for (size_t k = 0; k < level->cells; k++) {
        uint64_t key = grid->sorted.key[k];
        uint64_t row = (uint64_t)scree_curve_gather(key >> 1) + 1, column = (uint64_t)scree_curve_gather(key) + 1;
        grid->sorted.key[k] = row << column_bits | column;
        grid->sorted.index[k] = (uint32_t)k;
    }
    scree_key_list_sort(&grid->sorted, level->cells);
    fill_slots(grid, state, m, first_slot);
    find_ranges(grid, m, column_bits);
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
    scree_release(&grid->ranges);
    memset(grid, 0, sizeof *grid);
}
