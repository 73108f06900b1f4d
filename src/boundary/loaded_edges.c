/// Which edges of the Delaunay boundary carry the lateral pressure.
///
/// Rule. A body of the loop FACES the nearer active one of the bottom and top plates if the gap between its surface and
/// the plate is at most the mean radius, so that no body fits in between; if no body faces a plate, the one nearest to
/// it does. Of the bodies that face a plate the two outermost along it are its corners. Going round the loop
/// counter-clockwise, with the sample on the left, the edges from the first to the second corner of a plate lie along
/// it and carry no pressure; all other edges do: the two lateral arcs between the four corners, or the whole loop
/// without plates. A plate with one corner takes no edge. With an active side plate nothing is loaded: the sides are
/// not free. The gap between a corner and its plate belongs to the lateral arc (measure/outline.h). Of equal candidates
/// the one that comes first in the loop counts. Cost: O(length of the loop).
#include "boundary/loaded_edges.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "measure/outline.h"

#include <math.h>
#include <string.h>

static double gap_to(const scree_state *state, const scree_wall *wall, size_t k)
{
    const scree_loop *loop = scree_loop_of(state);
    double x[2];
    scree_loop_position(state, k, x);
    return wall->normal[0] * x[0] + wall->normal[1] * x[1] - wall->position -
           scree_boundary_radius(state, loop->id[k], &loop->body[k]);
}

/// The body at place k is at least as near to this wall as to the opposite one.
static bool belongs_to(const scree_state *state, int wall, size_t k)
{
    const scree_wall *opposite = &scree_plates(state)[SCREE_WALL_BOTTOM + SCREE_WALL_TOP - wall];
    return !opposite->active || gap_to(state, &scree_plates(state)[wall], k) <= gap_to(state, opposite, k);
}

/// Gap up to which bodies face the wall: the mean radius, or the smallest gap when that is larger.
static double facing_limit(const scree_model *model, const scree_state *state, int wall)
{
    double nearest = INFINITY;
    for (size_t k = 0; k < scree_loop_of(state)->count; k++) {
        double gap = gap_to(state, &scree_plates(state)[wall], k);
        if (gap < nearest && belongs_to(state, wall, k)) nearest = gap;
    }
    return fmax(nearest, model->mean_radius);
}

static void clear_along(const scree_model *model, scree_state *state, int wall)
{
    const double *normal = scree_plates(state)[wall].normal;
    double limit = facing_limit(model, state, wall), low = INFINITY, high = -INFINITY;
    size_t count = scree_loop_of(state)->count, first = count, last = count;
    for (size_t k = 0; k < count; k++) {
        if (!belongs_to(state, wall, k) || gap_to(state, &scree_plates(state)[wall], k) > limit) continue;
        double x[2];
        scree_loop_position(state, k, x);
        // Along the wall in the sense in which the loop passes it.
        double along = normal[1] * x[0] - normal[0] * x[1];
        if (along < low) {
            low = along;
            first = k;
        }
        if (along > high) {
            high = along;
            last = k;
        }
    }
    if (first == count) return;
    for (size_t k = first; k != last; k = k + 1 < count ? k + 1 : 0) scree_loop_of(state)->loaded[k] = 0;
}

void scree_loop_mark_loaded(const scree_model *model, scree_state *state)
{
    bool free_sides = !scree_plates(state)[SCREE_WALL_LEFT].active && !scree_plates(state)[SCREE_WALL_RIGHT].active;
    memset(scree_loop_of(state)->loaded, free_sides ? 1 : 0, scree_loop_of(state)->count);
    if (!free_sides) return;
    for (int wall = SCREE_WALL_BOTTOM; wall <= SCREE_WALL_TOP; wall++)
        if (scree_plates(state)[wall].active) clear_along(model, state, wall);
}
