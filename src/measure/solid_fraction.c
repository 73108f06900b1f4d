/// Solid fraction inside the Delaunay boundary. A disc inside counts whole, a disc on the boundary as the sector of the
/// interior angle that its two edges leave (exact as long as the disc meets no other edge of the loop). Overlaps at
/// contacts are counted twice: a relative error of the order of (indentation / radius)^1.5. Cost: O(bodies).
#include "measure/measure.h"

#include "measure/outline.h"
#include "state/cell.h"

#include <math.h>

/// Interior angle of the loop at place k, 0 to 2 pi.
static double interior_angle(const scree_state *state, size_t k)
{
    size_t count = state->loop.count;
    double x[2], next[2], previous[2];
    scree_loop_position(state, k, x);
    scree_loop_position(state, (k + 1) % count, next);
    scree_loop_position(state, (k + count - 1) % count, previous);
    double a[2] = {next[0] - x[0], next[1] - x[1]}, b[2] = {previous[0] - x[0], previous[1] - x[1]};
    double angle = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    return angle < 0 ? angle + 2 * M_PI : angle;
}

double scree_solid_fraction(const scree_state *state)
{
    double solid = 0;
    for (size_t id = 0; id < state->grains; id++) {
        double radius = state->row[state->row_of_id[id]].radius;
        solid += state->dimension == 2 ? M_PI * radius * radius : 4 * M_PI / 3 * radius * radius * radius;
    }
    if (state->cell.periodic) return solid / scree_cell_extent(state);
    for (size_t k = 0; k < state->loop.count; k++) {
        double radius = state->row[state->row_of_id[state->loop.id[k]]].radius;
        solid -= (M_PI - interior_angle(state, k) / 2) * radius * radius;
    }
    return state->loop.count > 0 ? solid / scree_loop_area(state) : NAN;
}
