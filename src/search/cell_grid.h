/// Cell grid for bodies of any sizes: occupied cells only, one level of cells for each octave of radii.
///
/// Method (after the hierarchical grid of Ogarko and Luding 2012). The cells of level m are squares or cubes of side
/// h_m = h_top 2^(m - top), h_top = 2 R_max + skin; a body belongs to the lowest level whose cells are at least
/// 2 R + skin wide. Two bodies closer than R_i + R_j + skin then lie in the same or in touching cells of the higher of
/// their levels, so each body looks for partners in 3 x 3 (x 3) cells of its own level and of every level above: linear
/// cost for any distribution of sizes, because a body never looks for smaller ones.
///
/// No array spans the domain. Occupied cells are sorted by (plane,) row and column; three cursors (nine in 3D) that
/// walk along the sorted cells together find, for every cell, the bodies of three cells side by side in each of the
/// rows of cells around it as three (nine) ranges of one array ("slots"). Memory and cost are linear in the number of
/// bodies wherever they are.
///
/// Limits: 16 levels (sizes 1 : 65536; smaller bodies share the lowest level); positions beyond 2^30 finest cells from
/// the origin in 2D, 2^19 in 3D, count as if they were there: right, but bodies there share cells. Cost: bodies x
/// levels in use.
#ifndef SCREE_SEARCH_CELL_GRID_H
#define SCREE_SEARCH_CELL_GRID_H

#include "search/space_curve.h"
#include "state/state.h"

#define SCREE_CELL_LEVELS 16
/// Slots that may be read (not used) after the last one.
#define SCREE_SLOT_PADDING 8

/// Slots of the bodies in three cells side by side.
typedef struct scree_slot_range {
    uint32_t begin, end;
} scree_slot_range;

/// Rows of cells around a cell, from the lowest to the highest, with its own in the middle.
#define SCREE_CELL_ROWS(dimension) ((dimension) == 3 ? 9 : 3)

typedef struct scree_cell_level {
    double width;      ///< m
    size_t bodies;     ///< of this level
    size_t first_cell; ///< of this level in the arrays of cells
    size_t cells;      ///< that bodies of this level and of those below lie in; 0 when the level has no bodies
} scree_cell_level;

typedef struct scree_cell_grid {
    int dimension;     ///< 2 or 3
    double skin;       ///< m
    int top;           ///< highest level
    int levels_in_use; ///< levels that hold bodies
    scree_cell_level level[SCREE_CELL_LEVELS];
    double lowest[3]; ///< lowest coordinates of an occupied finest cell
    bool finite;      ///< all positions are finite
    uint64_t odd_id;  ///< smallest id of a body that is not at a finite position
    // bodies in curve order (rows)
    scree_key_list curve; ///< key of the finest cell and id
    uint8_t *body_level;
    uint32_t *order; ///< those of the curve, until the next time
    // cells, level by level, along the curve
    uint32_t *cell_row;      ///< first row in the cell of a body of this level or one below
    scree_slot_range *range; ///< SCREE_CELL_ROWS of each cell; in the lowest level without cells before it on the curve
    scree_key_list sorted;   ///< scratch: cells of one level by (plane,) row and column
    size_t cell_capacity;
    // slots: bodies by level, (plane,) row and column of cells
    double *x, *y, *z, *radius; ///< m; z NULL in 2D
    uint32_t *row, *id;
    size_t body_capacity;
} scree_cell_grid;

/// Chooses levels for the radii in `state`, and looks for positions that are not finite.
void scree_cell_grid_fit(scree_cell_grid *grid, const scree_state *state, double skin);

/// Fills grid->order: the rows of `state` in the order of the curve, bodies of one cell by id. Errors: memory.
scree_status scree_cell_grid_order(scree_cell_grid *grid, const scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Builds cells and slots, after the rows have been brought into grid->order. Errors: memory.
scree_status scree_cell_grid_fill(scree_cell_grid *grid, const scree_state *state, scree_error *error) SCREE_MUST_USE;

void scree_cell_grid_destroy(scree_cell_grid *grid);

#endif
