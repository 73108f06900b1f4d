/// Particles that are convex polygons: what a run keeps of them beside their rows.
///
/// Corners lie in one pool, in the frame of their body, as they were drawn (polygon_make.h) or given; a body knows
/// where its own begin and how many they are, none of a disc among polygons. Rows have the bounding radius; state->form
/// the radius of the disc of equal area and that of equal inertia (state/body.h). The angle of a body is its
/// orientation. Posed corners, turned by that angle and relative to the centre, are derived: renewed in every step,
/// before contacts.
#ifndef SCREE_SHAPE_POLYGONS_H
#define SCREE_SHAPE_POLYGONS_H

#include "shape/polygon.h"
#include "state/body.h"

/// Where the corners of a body are in the pool.
typedef struct scree_corners {
    uint32_t first, count;
} scree_corners;

/// State of the module `polygon`.
typedef struct scree_polygons {
    double (*corner)[2];    ///< m, count, in the frame of the body
    double (*posed)[2];     ///< m, turned (derived)
    size_t count, capacity; ///< of the pool, with those of bodies that are gone until it is full
    scree_corners *of;      ///< one a row; NULL: all bodies are round
} scree_polygons;

static inline scree_polygons *scree_polygons_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_polygon];
}

/// The body in `row` as it lies; of a disc without corners.
SCREE_INLINE scree_polygon scree_polygon_of_row(const scree_state *state, const scree_polygons *polygons, size_t row)
{
    const scree_corners *of = &polygons->of[row];
    return (scree_polygon){.corner = (const double(*)[2])polygons->posed + of->first,
                           .count = (int)of->count,
                           .radius = state->form[row].radius,
                           .bound = state->row[row].radius};
}

/// Gives a body a convex outline [m], in any frame: its centroid becomes the centre, and mass (by the density of its
/// material), inertia and sizes follow. Errors: memory.
scree_status scree_polygons_set(const scree_model *model, scree_state *state, size_t row, int count,
                                const double (*corner)[2], scree_error *error) SCREE_MUST_USE;

/// Renews the posed corners. Cost: one sine and cosine a body, four products a corner.
void scree_polygons_pose(scree_state *state);

#endif
