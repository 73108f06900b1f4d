/// A triangulated tube: rings of `around` bodies, one above the other, every second ring turned by half a spacing.
/// Body k = ring x around + place, counter-clockwise seen from above. Each spacing between two rings has 2 x around
/// triangles; a body has springs to the next of its ring, and to the two above it (right, then left seen from outside).
#ifndef SCREE_BOUNDARY_SHEET_H
#define SCREE_BOUNDARY_SHEET_H

#include "state/state.h"

enum { SCREE_SHEET_SPRINGS = 3 };

/// The body at the other end of spring `s` of body `k`; SIZE_MAX: there is no such spring.
static inline size_t scree_sheet_neighbour(size_t around, size_t count, size_t k, int s)
{
    size_t ring = k / around, position = k % around, above = (ring + 1) * around;
    if (s == 0) return ring * around + (position + 1) % around;
    if (above >= count) return SIZE_MAX;
    // An odd ring is turned to the right.
    size_t right = ring % 2 == 1 ? position + 1 : position;
    return above + (s == 1 ? right : right + around - 1) % around;
}

static inline size_t scree_sheet_triangle_count(size_t around, size_t count)
{
    return count > 0 ? 2 * (count - around) : 0;
}

/// Corners of triangle `t`, counter-clockwise seen from outside.
static inline void scree_sheet_triangle(size_t around, size_t count, size_t t, size_t corner[3])
{
    size_t k = t / 2, right = scree_sheet_neighbour(around, count, k, 1);
    corner[0] = k;
    corner[1] = t % 2 == 0 ? scree_sheet_neighbour(around, count, k, 0) : right;
    corner[2] = t % 2 == 0 ? right : scree_sheet_neighbour(around, count, k, 2);
}

/// Largest radius [m] that a ball which slips through the sheet of the membrane can have, between three of its bodies
/// or between two of its ends and their plate (sheet_hole.c). Cost: O(bodies of the membrane).
double scree_sheet_hole(const scree_state *state);

/// Places the sheet of a membrane around the grains (sheet_place.c).
scree_status scree_sheet_place(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

#endif
