/// The sample inside a triangulated hull: see hull.h. Volumes, centre and areas are sums in integers. Cost:
/// O(triangles).
#include "measure/hull.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/integer_sum.h"

#include <math.h>

void scree_hull_position(const scree_state *state, size_t node, scree_vector position)
{
    const scree_hull *hull = scree_hull_of(state);
    scree_boundary_place(state, hull->id[node], &hull->body[node], position);
}

void scree_hull_corners(const scree_state *state, size_t triangle, const scree_vector origin, scree_vector corner[3])
{
    for (int c = 0; c < 3; c++) {
        scree_hull_position(state, scree_hull_of(state)->triangle[triangle][c], corner[c]);
        for (int k = 0; k < 3; k++) corner[c][k] -= origin[k];
    }
}

/// Six times the volume of the tetrahedron of the origin and a triangle.
static double six_volumes(const scree_vector a, const scree_vector b, const scree_vector c)
{
    scree_vector product;
    scree_cross(b, c, product);
    return scree_dot(a, product);
}

/// Volume, and centre relative to `origin`.
static double volume_about(const scree_state *state, const scree_vector origin, scree_vector centre)
{
    scree_integer_sum sum[4] = {0}; // volume; moments
    scree_vector corner[3];
    while (scree_integer_sum_next(sum, 4))
        for (size_t t = 0; t < scree_hull_of(state)->triangle_count; t++) {
            scree_hull_corners(state, t, origin, corner);
            double part = six_volumes(corner[0], corner[1], corner[2]) / 6;
            scree_integer_sum_add(&sum[0], part);
            for (int k = 0; k < 3; k++)
                scree_integer_sum_add(&sum[1 + k], part * (corner[0][k] + corner[1][k] + corner[2][k]) / 4);
        }
    double volume = scree_integer_sum_total(&sum[0]);
    for (int k = 0; k < 3; k++) centre[k] = volume > 0 ? scree_integer_sum_total(&sum[1 + k]) / volume : 0;
    return volume;
}

double scree_hull_volume(const scree_state *state)
{
    scree_vector origin = {0}, centre;
    if (scree_hull_of(state)->node_count > 0) scree_hull_position(state, 0, origin);
    return volume_about(state, origin, centre);
}

/// Area of the foot of a triangle on a plate across the last axis, positive when the triangle faces it.
static double foot_area(const scree_wall *wall, scree_vector corner[3])
{
    const double *a = corner[0], *b = corner[1], *c = corner[2];
    return -0.5 * wall->normal[2] * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

double scree_hull_sample_volume(const scree_state *state, scree_vector centre)
{
    scree_vector origin = {0}, corner[3];
    if (scree_hull_of(state)->node_count > 0) scree_hull_position(state, 0, origin);
    scree_integer_sum prisms = {0};
    while (scree_integer_sum_next(&prisms, 1))
        for (size_t t = 0; t < scree_hull_of(state)->triangle_count; t++) {
            int w = scree_hull_wall(scree_hull_of(state), t);
            if (w < 0) continue;
            const scree_wall *wall = &scree_plates(state)[w];
            scree_hull_corners(state, t, origin, corner);
            double height = wall->normal[2] * (origin[2] + (corner[0][2] + corner[1][2] + corner[2][2]) / 3);
            scree_integer_sum_add(&prisms, foot_area(wall, corner) * (height - wall->position));
        }
    double volume = volume_about(state, origin, centre) + scree_integer_sum_total(&prisms);
    for (int k = 0; k < 3; k++) centre[k] += origin[k];
    return volume;
}

/// moment_ij -= area_i x_j
static void take_product(const scree_vector area, const scree_vector position, double factor, double moment[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) moment[3 * i + j] -= factor * area[i] * position[j];
}

void scree_hull_pressure_moment(const scree_state *state, const scree_vector centre, double moment[9])
{
    const scree_hull *hull = scree_hull_of(state);
    scree_vector corner[3];
    for (int i = 0; i < 9; i++) moment[i] = 0;
    for (size_t t = 0; t < hull->triangle_count; t++) {
        if (hull->loaded[t] == SCREE_HULL_BARE) continue;
        scree_hull_corners(state, t, centre, corner);
        int w = scree_hull_wall(hull, t);
        for (int c = 0; c < 3; c++) {
            const double *a = corner[c], *b = corner[(c + 1) % 3];
            if (w < 0) {
                // A third of the area, which is half the sum of the products of the edges, at each corner.
                for (int e = 0; e < 3; e++) {
                    const double *p = corner[e], *q = corner[(e + 1) % 3];
                    scree_vector product;
                    scree_cross(p, q, product);
                    take_product(product, a, 1.0 / 6, moment);
                }
                continue;
            }
            double plate = scree_plates(state)[w].position * scree_plates(state)[w].normal[2] - centre[2];
            double at_a = a[2] - plate, at_b = b[2] - plate;
            scree_vector across = {a[1] - b[1], b[0] - a[0], 0};
            take_product(across, a, (2 * at_a + at_b) / 6, moment);
            take_product(across, b, (at_a + 2 * at_b) / 6, moment);
        }
    }
}

double scree_hull_plate_area(const scree_state *state, int wall)
{
    scree_integer_sum area = {0};
    scree_vector origin = {0}, corner[3];
    if (scree_hull_of(state)->node_count > 0) scree_hull_position(state, 0, origin);
    while (scree_integer_sum_next(&area, 1))
        for (size_t t = 0; t < scree_hull_of(state)->triangle_count; t++) {
            if (scree_hull_of(state)->loaded[t] != SCREE_HULL_ON_WALL + wall) continue;
            scree_hull_corners(state, t, origin, corner);
            scree_integer_sum_add(&area, foot_area(&scree_plates(state)[wall], corner));
        }
    return scree_integer_sum_total(&area);
}

/// Partner of the edge `edge` (3 x triangle + corner) among those that start at its end; UINT32_MAX: none.
static uint32_t partner_of(const scree_hull *hull, const uint32_t *begin, const uint32_t *edges, size_t edge)
{
    uint32_t a = hull->triangle[edge / 3][edge % 3], b = hull->triangle[edge / 3][(edge % 3 + 1) % 3];
    for (uint32_t k = begin[b]; k < begin[b + 1]; k++)
        if (hull->triangle[edges[k] / 3][(edges[k] % 3 + 1) % 3] == a) return edges[k] / 3;
    return UINT32_MAX;
}

scree_status scree_hull_neighbours(const scree_hull *hull, uint32_t (*neighbour)[3], scree_error *error)
{
    uint32_t *begin = NULL, *edges = NULL;
    size_t count = 3 * hull->triangle_count;
    scree_status status = scree_allocate(&begin, hull->node_count + 2, sizeof *begin, error);
    if (!status) status = scree_allocate(&edges, count, sizeof *edges, error);
    if (!status) {
        // Edges bucketed by their first node; filling advances begin[i + 1] from the start to the end of bucket i.
        for (size_t e = 0; e < count; e++) begin[hull->triangle[e / 3][e % 3] + 2]++;
        for (size_t i = 1; i <= hull->node_count; i++) begin[i + 1] += begin[i];
        for (size_t e = 0; e < count; e++) edges[begin[hull->triangle[e / 3][e % 3] + 1]++] = (uint32_t)e;
    }
    for (size_t e = 0; e < count && !status; e++) {
        neighbour[e / 3][e % 3] = partner_of(hull, begin, edges, e);
        if (neighbour[e / 3][e % 3] == UINT32_MAX)
            status = scree_error_set(error, SCREE_ERROR_GUARD, "the hull is not closed at body %u",
                                     hull->id[hull->triangle[e / 3][e % 3]]);
    }
    scree_release(&begin);
    scree_release(&edges);
    return status;
}
