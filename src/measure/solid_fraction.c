/// Solid fraction inside the Delaunay boundary. A disc inside counts whole, a disc on the boundary as the sector of the
/// interior angle that its two edges leave (exact as long as the disc meets no other edge of the loop), a sphere on the
/// hull as the interior solid angle of its triangles. Overlaps at contacts are counted twice: a relative error of the
/// order of (indentation / radius)^1.5. Cost: O(bodies).
#include "measure/measure.h"

#include "measure/hull.h"
#include "measure/outline.h"

#include <math.h>
#include <string.h>

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

/// Unit vector from x to the body at a node.
static void direction_to(const scree_state *state, const scree_vector x, size_t node, scree_vector direction)
{
    scree_hull_position(state, node, direction);
    for (int k = 0; k < 3; k++) direction[k] -= x[k];
    double length = scree_length(direction);
    for (int k = 0; k < 3; k++) direction[k] /= length;
}

static double dot(const scree_vector a, const scree_vector b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Solid angle of three unit vectors (van Oosterom and Strackee 1983), between -2 pi and 2 pi.
static double solid_angle(const scree_vector a, const scree_vector b, const scree_vector c)
{
    double triple =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    return 2 * atan2(triple, 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Interior solid angles of the hull at its nodes, modulo 4 pi. The edges at a node cut the unit sphere round it in a
/// closed polygon; its solid angle is the sum of those of the triangles of its sides and any fixed direction, that of
/// the first edge found. `first` marks the node that each node's fixed direction points to.
static void add_solid_angles(const scree_state *state, uint32_t *first, double *angle)
{
    const scree_hull *hull = &state->hull;
    for (size_t t = 0; t < hull->triangle_count; t++)
        for (int c = 0; c < 3; c++) {
            uint32_t node = hull->triangle[t][c], next = hull->triangle[t][(c + 1) % 3];
            uint32_t last = hull->triangle[t][(c + 2) % 3];
            if (first[node] == UINT32_MAX) first[node] = next;
            if (first[node] == next || first[node] == last) continue;
            scree_vector x, fixed, one, other;
            scree_hull_position(state, node, x);
            direction_to(state, x, first[node], fixed);
            direction_to(state, x, next, one);
            direction_to(state, x, last, other);
            // Seen from inside, the corners of an outward triangle turn clockwise.
            angle[node] -= solid_angle(fixed, one, other);
        }
}

/// Sphere volume inside the hull: whole ones less what the boundary cuts off.
static scree_status solid_in_hull(const scree_state *state, double *solid, scree_error *error)
{
    const scree_hull *hull = &state->hull;
    uint32_t *first = NULL;
    double *angle = NULL;
    scree_status status = scree_allocate(&first, hull->node_count, sizeof *first, error);
    if (!status) status = scree_allocate(&angle, hull->node_count, sizeof *angle, error);
    if (!status) {
        memset(first, 0xff, hull->node_count * sizeof *first);
        add_solid_angles(state, first, angle);
        for (size_t id = 0; id < state->grains; id++)
            *solid += 4 * M_PI / 3 * pow(state->row[state->row_of_id[id]].radius, 3);
        for (size_t k = 0; k < hull->node_count; k++) {
            double inside = angle[k] - 4 * M_PI * floor(angle[k] / (4 * M_PI));
            *solid -= (4 * M_PI - inside) / 3 * pow(state->row[state->row_of_id[hull->id[k]]].radius, 3);
        }
    }
    scree_release(&first);
    scree_release(&angle);
    return status;
}

/// Disc area inside the loop.
static double solid_in_loop(const scree_state *state)
{
    double solid = 0;
    for (size_t id = 0; id < state->grains; id++) {
        double radius = state->row[state->row_of_id[id]].radius;
        solid += M_PI * radius * radius;
    }
    for (size_t k = 0; k < state->loop.count; k++) {
        double radius = state->row[state->row_of_id[state->loop.id[k]]].radius;
        solid -= (M_PI - interior_angle(state, k) / 2) * radius * radius;
    }
    return solid;
}

scree_status scree_solid_fraction(const scree_state *state, double *fraction, scree_error *error)
{
    *fraction = NAN;
    double solid = 0;
    scree_status status = SCREE_OK;
    if (state->dimension == 2 && state->loop.count > 0) *fraction = solid_in_loop(state) / scree_loop_area(state);
    if (state->dimension == 3 && state->hull.node_count > 0) {
        status = solid_in_hull(state, &solid, error);
        if (!status) *fraction = solid / scree_hull_volume(state);
    }
    return status;
}
