/// Particles that are convex polygons: what a run keeps of them beside their rows.
///
/// Corners lie in one pool, in the frame of their body, as they were drawn (polygon_make.h) or given; a body knows
/// where its own begin and how many they are, none of a disc among polygons. Rows have the bounding radius; state->form
/// the radius of the disc of equal area and that of equal inertia (state/body.h). The angle of a body is its
/// orientation. Posed corners, turned by that angle and relative to the centre, are derived: renewed in every step,
/// before contacts.
///
/// A part of a sample (comm/parts.h) has the pool of all bodies, of those that come too: corners do not change, so
/// nothing of them goes from one process to another. Those of ghosts are turned by the heading that they follow in.
///
/// Where corners are rounded the corners of the pool are those of the core, and the outline lies a rounding outside of
/// it (shape/rounding.h); centre, sizes, mass and inertia are those of the whole body.
#ifndef SCREE_SHAPE_POLYGONS_H
#define SCREE_SHAPE_POLYGONS_H

#include "shape/core_pair.h"
#include "shape/pose.h"
#include "state/body.h"

/// State of the module `polygon`.
typedef struct scree_polygons {
    double (*corner)[2];    ///< m, count, in the frame of the body
    double (*posed)[2];     ///< m, turned (derived)
    size_t count, capacity; ///< of the pool, with those of bodies that are gone until it is full
    scree_corners *of;      ///< one a row; NULL: all bodies are round
    double *rounding;       ///< m, one a row, 0 of discs; NULL: all corners are sharp
    double *heading; ///< rad, one a row: the angle, for ghosts in other processes; NULL: there are none (derived)
} scree_polygons;

static inline scree_polygons *scree_polygons_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_polygon];
}

/// The body in `row` as it lies; of a disc without corners, as all are where there have been no polygons.
SCREE_INLINE scree_polygon scree_polygon_of_row(const scree_state *state, const scree_polygons *polygons, size_t row)
{
    if (!polygons->of) return (scree_polygon){.radius = state->row[row].radius, .bound = state->row[row].radius};
    const scree_corners *of = &polygons->of[row];
    return (scree_polygon){.corner = (const double(*)[2])polygons->posed + of->first,
                           .count = (int)of->count,
                           .radius = state->form[row].radius,
                           .bound = state->row[row].radius};
}

/// The rounding of the corners of the body in `row` [m].
SCREE_INLINE double scree_rounding_of_row(const scree_polygons *polygons, size_t row)
{
    return polygons->rounding ? polygons->rounding[row] : 0;
}

/// What geometries of closest features take of the body in `row` as it lies; of a disc its centre.
SCREE_INLINE scree_core scree_core_of_row(const scree_state *state, const scree_polygons *polygons, size_t row)
{
    const double radius = state->row[row].radius;
    if (!polygons->of || polygons->of[row].count == 0) return (scree_core){.rounding = radius};
    const scree_corners *of = &polygons->of[row];
    const double rounding = scree_rounding_of_row(polygons, row);
    return (scree_core){.corner = (const double(*)[2])polygons->posed + of->first,
                        .count = (int)of->count,
                        .bound = radius - rounding,
                        .rounding = rounding};
}

/// Gives a body a convex outline [m], in any frame, with corners rounded by `rounding` [m] outside of it, or sharp: its
/// centroid becomes the centre, and mass (by the density of its material), inertia and sizes follow. Errors: memory.
scree_status scree_polygons_set(const scree_model *model, scree_state *state, size_t row, int count,
                                const double (*corner)[2], double rounding, scree_error *error) SCREE_MUST_USE;

/// Of the largest circle about its centre that lies in the body [m]; 0 of shapes of which nothing is known here.
double scree_body_inner_radius(const scree_state *state, size_t row);

/// Renews the posed corners. Cost: one sine and cosine a body, four products a corner.
void scree_polygons_pose(scree_state *state);

/// Turns corners of any list of bodies, to the same bits.
void scree_polygons_turn(const scree_pose *pose);

#endif
