/// Solid fraction inside the Delaunay boundary. A disc inside counts whole, a disc on the boundary as the sector of the
/// interior angle that its two edges leave (exact as long as the disc meets no other edge of the loop), a sphere on the
/// hull as the interior solid angle of its triangles. Overlaps at contacts are counted twice: a relative error of the
/// order of (overlap / radius)^1.5. In a periodic cell all bodies count whole. Cost: O(bodies). What the boundary cuts
/// off is summed by the processes that have its bodies, in integers.
#include "measure/delaunay_boundary.h"
#include "measure/measure.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "measure/hull.h"
#include "measure/outline.h"
#include "state/periodic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Interior angle of the loop at place k, 0 to 2 pi.
static double interior_angle(const scree_state *state, size_t k)
{
    size_t count = scree_loop_of(state)->count;
    double x[2], next[2], previous[2];
    scree_loop_position(state, k, x);
    scree_loop_position(state, (k + 1) % count, next);
    scree_loop_position(state, (k + count - 1) % count, previous);
    double a[2] = {next[0] - x[0], next[1] - x[1]}, b[2] = {previous[0] - x[0], previous[1] - x[1]};
    double angle = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    return angle < 0 ? angle + 2 * M_PI : angle;
}

static void normalise(scree_vector a)
{
    double length = scree_length(a);
    for (int k = 0; k < 3; k++) a[k] /= length;
}

/// Solid angle of three unit vectors (van Oosterom and Strackee 1983), between -2 pi and 2 pi.
static double solid_angle(const scree_vector a, const scree_vector b, const scree_vector c)
{
    scree_vector product;
    scree_cross(b, c, product);
    return 2 * atan2(scree_dot(a, product), 1 + scree_dot(a, b) + scree_dot(b, c) + scree_dot(c, a));
}

/// The two edges of a triangle at its corner c, as vectors.
static void edges_at(const scree_state *state, size_t triangle, int c, scree_vector next, scree_vector last)
{
    scree_vector origin;
    scree_vector corner[3];
    scree_hull_position(state, scree_hull_of(state)->triangle[triangle][c], origin);
    scree_hull_corners(state, triangle, origin, corner);
    memcpy(next, corner[(c + 1) % 3], sizeof corner[0]);
    memcpy(last, corner[(c + 2) % 3], sizeof corner[0]);
}

/// A triangle of the hull, to be put into the order of its nodes.
typedef struct placed_triangle {
    uint32_t node[3];
    uint32_t triangle;
} placed_triangle;

static int compare_nodes(const void *a, const void *b)
{
    const placed_triangle *p = a, *q = b;
    for (int c = 0; c < 3; c++)
        if (p->node[c] != q->node[c]) return p->node[c] < q->node[c] ? -1 : 1;
    return 0;
}

/// Triangles in an order that follows from their nodes alone: sums at a node have the same bits in whatever order the
/// hull has them.
static scree_status order_triangles(const scree_hull *hull, placed_triangle **order, scree_error *error)
{
    scree_status status = scree_allocate(order, hull->triangle_count + 1, sizeof **order, error);
    for (size_t t = 0; t < hull->triangle_count && !status; t++) {
        memcpy((*order)[t].node, hull->triangle[t], sizeof(*order)[t].node);
        (*order)[t].triangle = (uint32_t)t;
    }
    if (!status) qsort(*order, hull->triangle_count, sizeof **order, compare_nodes);
    return status;
}

/// Interior solid angles of the hull at its nodes, modulo 4 pi. The edges at a node cut the unit sphere round it in a
/// closed polygon; its solid angle is the sum of those of the triangles of its sides and any fixed direction: here that
/// against the sum of the normals. `inward` is zero before.
static void add_solid_angles(const scree_state *state, const placed_triangle *order, scree_vector *inward,
                             double *angle)
{
    const scree_hull *hull = scree_hull_of(state);
    scree_vector next, last, area;
    for (size_t k = 0; k < hull->triangle_count; k++) {
        edges_at(state, order[k].triangle, 0, next, last);
        scree_cross(last, next, area);
        for (int c = 0; c < 3; c++) scree_along(inward[order[k].node[c]], 1, area, inward[order[k].node[c]]);
    }
    for (size_t node = 0; node < hull->node_count; node++) normalise(inward[node]);
    for (size_t k = 0; k < hull->triangle_count; k++)
        for (int c = 0; c < 3; c++) {
            edges_at(state, order[k].triangle, c, next, last);
            normalise(next);
            normalise(last);
            // Seen from inside, the corners of an outward triangle turn clockwise.
            angle[order[k].node[c]] += solid_angle(inward[order[k].node[c]], last, next);
        }
}

/// Area (2D) or volume of all grains.
static double solid_of_all(const scree_state *state)
{
    scree_integer_sum solid = {0};
    while (scree_comm_sum_next(state, &solid, 1))
        for (size_t row = 0; row < state->count; row++) {
            if (!scree_body_is_grain(state, row)) continue;
            scree_integer_sum_add(&solid, scree_body_volume(state, row));
        }
    return scree_integer_sum_total(&solid);
}

/// Sphere volume inside the hull: whole ones less what the boundary cuts off.
static scree_status solid_in_hull(const scree_state *state, double *solid, scree_error *error)
{
    const scree_hull *hull = scree_hull_of(state);
    scree_vector *inward = NULL;
    double *angle = NULL;
    placed_triangle *order = NULL;
    scree_status status = order_triangles(hull, &order, error);
    if (!status) status = scree_allocate(&inward, hull->node_count, sizeof *inward, error);
    if (!status) status = scree_allocate(&angle, hull->node_count, sizeof *angle, error);
    if (!status) {
        add_solid_angles(state, order, inward, angle);
        *solid = solid_of_all(state);
        scree_integer_sum outside = {0};
        while (scree_comm_sum_next(state, &outside, 1))
            for (size_t k = 0; k < hull->node_count; k++) {
                const uint32_t row = scree_state_row_of(state, hull->id[k]);
                if (row == SCREE_NO_ROW) continue;
                const double inside = angle[k] - 4 * M_PI * floor(angle[k] / (4 * M_PI));
                scree_integer_sum_add(&outside,
                                      (4 * M_PI - inside) / 3 * pow(scree_body_equivalent_radius(state, row), 3));
            }
        *solid -= scree_integer_sum_total(&outside);
    }
    scree_release(&inward);
    scree_release(&angle);
    scree_release(&order);
    return status;
}

/// Disc area inside the loop.
static double solid_in_loop(const scree_state *state)
{
    const scree_loop *loop = scree_loop_of(state);
    scree_integer_sum outside = {0};
    const double all = solid_of_all(state);
    while (scree_comm_sum_next(state, &outside, 1))
        for (size_t k = 0; k < loop->count; k++) {
            const uint32_t row = scree_state_row_of(state, loop->id[k]);
            if (row == SCREE_NO_ROW) continue;
            const double radius = scree_body_equivalent_radius(state, row);
            scree_integer_sum_add(&outside, (M_PI - interior_angle(state, k) / 2) * radius * radius);
        }
    return all - scree_integer_sum_total(&outside);
}

scree_status scree_solid_fraction(const scree_state *state, double *fraction, scree_error *error)
{
    *fraction = NAN;
    double solid = 0;
    scree_status status = SCREE_OK;
    if (scree_cell(state)->directions && scree_periodic_is_closed(state))
        *fraction = solid_of_all(state) / scree_periodic_extent(state);
    if (state->dimension == 2 && scree_loop_of(state)->count > 0)
        *fraction = solid_in_loop(state) / scree_loop_area(state);
    if (state->dimension == 3 && scree_hull_of(state)->node_count > 0) {
        status = solid_in_hull(state, &solid, error);
        if (!status) *fraction = solid / scree_hull_volume(state);
    }
    return status;
}
