/// A heap of discs that grows disc by disc: each falls, rolls and comes to rest by exact geometry. See drop_2d.c.
#ifndef SCREE_PREPARE_DROP_2D_H
#define SCREE_PREPARE_DROP_2D_H

#include "base/memory.h"

#include <stdbool.h>

typedef struct scree_drop_2d {
    const double *radius; ///< m, of all discs, owned by the caller
    double *x, *y;        ///< m, centres of the discs placed so far, owned by the caller
    double *level;        ///< m, highest centre among a disc and all that it rests on, owned by the caller
    double width;         ///< m, walls at x = 0 and x = width; the floor is y = 0
    double largest;       ///< m, largest radius
    double cell;          ///< m, side of a grid cell
    size_t columns, rows; ///< of the grid
    uint32_t *head;       ///< rows x columns: 1 + the last disc of a cell, 0 for none
    uint32_t *next;       ///< 1 + the next disc of the same cell
    size_t *filled;       ///< of each column: rows up to the highest disc in it
} scree_drop_2d;

/// An empty box of `width`; the arrays have room for `count` discs.
scree_status scree_drop_2d_create(scree_drop_2d *drop, const double *radius, size_t count, double width, double *x,
                                  double *y, double *level, scree_error *error) SCREE_MUST_USE;
void scree_drop_2d_destroy(scree_drop_2d *drop);

/// Would disc `index`, let fall at abscissa `x`, reach the floor without touching another disc?
bool scree_drop_2d_sees_floor(const scree_drop_2d *drop, size_t index, double x);

/// Lets disc `index` fall from above at abscissa `x` in [radius, width - radius] and roll to its place of rest, which
/// it fills in. Errors: memory; the disc finds no rest (does not happen unless radii or positions are not numbers).
scree_status scree_drop_2d_add(scree_drop_2d *drop, size_t index, double x, scree_error *error) SCREE_MUST_USE;

#endif
