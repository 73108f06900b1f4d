/// The outline of a sample: what bounds it, as straight segments counter-clockwise. One description serves the pressure
/// (what it acts on), the area of the sample and the stress that the boundary applies, so that they agree exactly.
///
/// The outline follows the loaded edges of the Delaunay boundary. Where a run of edges without pressure faces the
/// bottom or top plate, it leaves the run: from the last loaded disc (a corner) along the normal of the plate to the
/// plate, along the plate, and back to the disc at the other end of the run. The two short segments, one gap of about a
/// radius each, carry the pressure too, all of it on their corner disc: so the lateral force is exactly pressure x
/// distance of the plates x thickness. Between the active plates nothing of the sample is left out and nothing is
/// counted twice.
#ifndef SCREE_MEASURE_OUTLINE_H
#define SCREE_MEASURE_OUTLINE_H

#include "measure/delaunay_boundary.h"
#include "state/state.h"

#include <stdbool.h>
#include <string.h>

typedef enum scree_outline_kind {
    SCREE_OUTLINE_EDGE, ///< between two discs; pressure shared equally by the two
    SCREE_OUTLINE_END,  ///< between a corner disc and the plate; pressure on the disc alone
    SCREE_OUTLINE_BARE, ///< along a plate (or an edge of a loop without any loaded edge); no pressure
} scree_outline_kind;

typedef struct scree_outline_segment {
    scree_outline_kind kind;
    double from[2], to[2]; ///< m
    size_t first, second;  ///< places in the loop of the discs at both ends; equal for SCREE_OUTLINE_END
    int wall;              ///< the plate that SCREE_OUTLINE_END and _BARE belong to; -1: none
} scree_outline_segment;

typedef void scree_outline_visitor(void *user, const scree_outline_segment *segment);

/// Calls `visit` for every segment, at the present positions of the bodies. Nothing when there is no loop.
/// Cost: O(length of the loop).
void scree_outline_visit(const scree_state *state, scree_outline_visitor *visit, void *user);

/// The three segments that stand for the run of unloaded edges which begins at place k.
void scree_outline_visit_run(const scree_state *state, scree_outline_visitor *visit, void *user, size_t k);

/// Present position [m] of the body at place k of the loop.
static inline void scree_loop_position(const scree_state *state, size_t k, double position[2])
{
    const scree_loop *loop = scree_loop_of(state);
    scree_vector place;
    scree_boundary_place(state, loop->id[k], &loop->body[k], place);
    position[0] = place[0];
    position[1] = place[1];
}

static inline size_t scree_loop_next(const scree_loop *loop, size_t k)
{
    return k + 1 < loop->count ? k + 1 : 0;
}

/// scree_outline_visit with the visitor inlined, for what happens in every step.
static inline __attribute__((always_inline)) void scree_outline_walk(const scree_state *state,
                                                                     scree_outline_visitor *visit, void *user)
{
    const scree_loop *loop = scree_loop_of(state);
    if (loop->count == 0) return;
    bool any = memchr(loop->loaded, 1, loop->count) != NULL;
    scree_outline_segment edge = {.kind = any ? SCREE_OUTLINE_EDGE : SCREE_OUTLINE_BARE, .wall = -1};
    scree_loop_position(state, 0, edge.to);
    for (size_t k = 0; k < loop->count; k++) {
        edge.first = k;
        edge.second = scree_loop_next(loop, k);
        edge.from[0] = edge.to[0];
        edge.from[1] = edge.to[1];
        scree_loop_position(state, edge.second, edge.to);
        if (!any || loop->loaded[k])
            visit(user, &edge);
        else if (loop->loaded[k > 0 ? k - 1 : loop->count - 1])
            scree_outline_visit_run(state, visit, user, k);
    }
}

/// Length [m] of the bottom or top plate that the outline runs along, from corner to corner: what the plate has to
/// carry under an all-round pressure p is p x this length x thickness, and with that the sample is in equilibrium. 0
/// when the outline does not touch the plate in two corners.
double scree_outline_plate_length(const scree_state *state, int wall);

/// Area [m2] and centre of area [m] of the outline; zeros when there is no loop.
double scree_outline_area(const scree_state *state, double centre[2]);

#endif
