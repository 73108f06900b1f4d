/// Pressure applied directly to the triangulated hull (P 2.5; Bagi 1996), at the present positions every step.
///
/// A loaded triangle presses its bodies; a triangle that faces a plate gives what the upright walls of its prism carry
/// (measure/hull.h); walls between two such triangles cancel. Equations and integers: pressed_facet.h. So, to the last
/// bit, the forces on a closed hull add up to zero, and with plates the horizontal ones do: whatever the shape of the
/// sides, they only press against each other.
///
/// Bodies are handed to the triangulation in the order of their ids: neither the order of rows nor the number of
/// threads shows. Cost: O(triangles) a step, 10 ns each; a refresh 20 to 50 microseconds a body near the outside
/// (search/outer_surface.c).
#include "boundary/hull.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "base/wrapping.h"
#include "boundary/loaded_triangles.h"
#include "boundary/pressed_facet.h"
#include "measure/facets.h"
#include "measure/hull.h"
#include "measure/measure.h"
#include "search/tetrahedra.h"

#include <math.h>
#include <string.h>

/// The outer surface of the present positions, in ids.
static scree_status find_surface(const scree_model *model, const scree_state *state, scree_triangle_surface *surface,
                                 scree_error *error)
{
    double *points = NULL, *radius = NULL;
    scree_peel_rule rule;
    uint32_t *past = NULL;
    scree_grain_place *grain = NULL;
    size_t count = 0;
    *surface = (scree_triangle_surface){0};
    scree_status status = scree_grain_places(state, &grain, &count, error);
    if (!status) status = scree_facet_rule(model, state, grain, count, &rule, &past, error);
    if (!status) status = scree_allocate(&points, 3 * count, sizeof *points, error);
    if (!status) status = scree_allocate(&radius, count, sizeof *radius, error);
    if (!status) {
        for (size_t k = 0; k < count; k++) {
            memcpy(points + 3 * k, grain[k].position, sizeof grain[k].position);
            radius[k] = grain[k].radius;
        }
        status = scree_outer_surface(points, radius, count, 2 * model->mean_radius, &rule, surface, error);
    }
    for (size_t k = 0; k < 3 * surface->count && !status; k++)
        surface->triangle[k / 3][k % 3] = (uint32_t)grain[surface->triangle[k / 3][k % 3]].id;
    scree_release(&grain);
    scree_release(&past);
    scree_release(&points);
    scree_release(&radius);
    return status;
}

static void hull_destroy(scree_hull *hull)
{
    scree_release(&hull->id);
    scree_release(&hull->position);
    scree_release(&hull->force);
    scree_release(&hull->body);
    scree_release(&hull->triangle);
    scree_release(&hull->loaded);
}

static scree_status hull_create(scree_hull *hull, size_t nodes, size_t triangles, scree_error *error)
{
    *hull = (scree_hull){.node_capacity = nodes, .triangle_capacity = triangles};
    scree_status status = scree_allocate(&hull->id, nodes, sizeof *hull->id, error);
    if (!status) status = scree_allocate(&hull->position, nodes, sizeof *hull->position, error);
    if (!status) status = scree_allocate(&hull->force, nodes, sizeof *hull->force, error);
    if (!status) status = scree_allocate(&hull->body, nodes, sizeof *hull->body, error);
    if (!status) status = scree_allocate(&hull->triangle, triangles, sizeof *hull->triangle, error);
    if (!status) status = scree_allocate(&hull->loaded, triangles, sizeof *hull->loaded, error);
    return status;
}

/// Nodes and triangles of a surface; `node_of` has room for every id.
static scree_status fill_hull(const scree_state *state, const scree_triangle_surface *surface, uint32_t *node_of,
                              scree_hull *hull, scree_error *error)
{
    size_t nodes = 0;
    for (size_t k = 0; k < 3 * surface->count; k++) node_of[surface->triangle[k / 3][k % 3]] = 1;
    for (size_t id = 0; id < state->id_count; id++) nodes += node_of[id];
    scree_status status = hull_create(hull, nodes, surface->count, error);
    if (status) return status;
    for (size_t id = 0; id < state->id_count; id++) {
        if (!node_of[id]) continue;
        hull->id[hull->node_count] = (uint32_t)id;
        node_of[id] = (uint32_t)hull->node_count++;
    }
    scree_boundary_tell(state, hull->id, hull->body, nodes);
    for (size_t k = 0; k < nodes; k++) scree_boundary_place(state, hull->id[k], &hull->body[k], hull->position[k]);
    for (size_t k = 0; k < 3 * surface->count; k++)
        hull->triangle[k / 3][k % 3] = node_of[surface->triangle[k / 3][k % 3]];
    hull->triangle_count = surface->count;
    hull->updated = state->step;
    return SCREE_OK;
}

scree_status scree_hull_renew(const scree_model *model, scree_state *state, scree_error *error)
{
    scree_triangle_surface surface;
    scree_hull fresh = {0};
    uint32_t *node_of = NULL;
    scree_status status = find_surface(model, state, &surface, error);
    if (!status) status = scree_allocate(&node_of, state->id_count, sizeof *node_of, error);
    if (!status) status = fill_hull(state, &surface, node_of, &fresh, error);
    if (!status) status = scree_hull_mark_loaded(model, state, &fresh, error);
    if (!status) {
        double enclosed = scree_strain_close(state);
        hull_destroy(scree_hull_of(state));
        *scree_hull_of(state) = fresh;
        scree_delaunay_boundary_of(state)->stale = 0;
        scree_strain_redetected(state, enclosed);
    } else {
        hull_destroy(&fresh);
    }
    scree_release(&node_of);
    scree_triangle_surface_destroy(&surface);
    return status;
}

/// Where forces go.
typedef struct hull_press {
    scree_state *state;
    double quantum; ///< N
    double scale;   ///< p / 6 / quantum
    bool adds;      ///< to the sums, too
} hull_press;

static void add_force(const hull_press *press, size_t node, const int64_t force[3])
{
    scree_hull *hull = scree_hull_of(press->state);
    const uint32_t row = scree_state_row_of(press->state, hull->id[node]);
    if (press->adds && row != SCREE_NO_ROW) {
        scree_sum_row *sum = &press->state->sum[row];
        scree_wrapping_add(&sum->fx, force[0]);
        scree_wrapping_add(&sum->fy, force[1]);
        scree_wrapping_add(&sum->fz, force[2]);
    }
    for (int k = 0; k < 3; k++) hull->force[node][k] += (double)force[k] * press->quantum;
}

static void press_triangle(const hull_press *press, size_t t, scree_vector corner[3])
{
    int64_t force[3];
    scree_triangle_press(press->scale, corner, force);
    for (int c = 0; c < 3; c++) add_force(press, scree_hull_of(press->state)->triangle[t][c], force);
}

/// The walls between the edges of a triangle and the plate at height `plate`.
static void press_walls(const hull_press *press, size_t t, double plate, scree_vector corner[3])
{
    const scree_hull *hull = scree_hull_of(press->state);
    for (int c = 0; c < 3; c++) {
        int64_t at_a[3], at_b[3];
        size_t a = hull->triangle[t][c], b = hull->triangle[t][(c + 1) % 3];
        scree_wall_press(press->scale, plate, corner[c], corner[(c + 1) % 3], a < b, at_a, at_b);
        add_force(press, a, at_a);
        add_force(press, b, at_b);
    }
}

void scree_hull_press(scree_state *state, double quantum, bool adds)
{
    scree_hull *hull = scree_hull_of(state);
    if (hull->node_count == 0) return;
    memset(hull->force, 0, hull->node_count * sizeof *hull->force);
    if (!(scree_direct_pressure(state) > 0)) return;
    const hull_press press = {state, quantum, scree_direct_pressure(state) / 6 / quantum, adds};
    scree_vector origin, corner[3];
    scree_hull_position(state, 0, origin);
    for (size_t t = 0; t < hull->triangle_count; t++) {
        if (hull->loaded[t] == SCREE_HULL_BARE) continue;
        scree_hull_corners(state, t, origin, corner);
        int index = scree_hull_wall(hull, t);
        if (index < 0) {
            press_triangle(&press, t, corner);
            continue;
        }
        const scree_wall *wall = &scree_plates(state)[index];
        double plate = wall->normal[2] * wall->position - origin[2];
        press_walls(&press, t, plate, corner);
    }
}

double scree_hull_pressure_bound(const scree_model *model, const scree_state *state)
{
    const scree_hull *hull = scree_hull_of(state);
    if (!(scree_direct_pressure(state) > 0) || hull->node_count == 0) return 0;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < hull->node_count; i++) {
            low = fmin(low, hull->position[i][k]);
            high = fmax(high, hull->position[i][k]);
        }
        square += (high - low) * (high - low);
    }
    // A cube of four mean radii is more than the triangles of any body in a packing; and the integers of the edges, up
    // to p / 6 x square, and the largest triangle that a lone body can have, p / 2 x square, stay below 2^8 times the
    // bound.
    double cell = 4 * model->mean_radius;
    return scree_direct_pressure(state) * fmax(cell * cell, square / 256);
}

double scree_hull_power(const scree_state *state)
{
    const scree_hull *hull = scree_hull_of(state);
    scree_integer_sum power = {0};
    while (scree_integer_sum_next(&power, 1))
        for (size_t k = 0; k < hull->node_count; k++) {
            scree_vector velocity;
            scree_boundary_velocity(state, hull->id[k], &hull->body[k], velocity);
            scree_integer_sum_add(&power, scree_dot(hull->force[k], velocity));
        }
    return scree_integer_sum_total(&power);
}
