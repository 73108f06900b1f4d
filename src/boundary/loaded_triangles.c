/// Which triangles of the hull carry the lateral pressure: the counterpart of loaded_edges.c in three dimensions.
///
/// Rule. A body of the hull FACES the nearer active one of the bottom and top plates if the gap between its surface and
/// the plate is at most the mean radius, so that no body fits in between; if no body faces a plate, the one nearest to
/// it does. A triangle faces a plate when its three bodies do and its outward normal is within 60 degrees of the
/// direction to the plate: so a body at the foot of a side, which stands on the plate too, is part of the side. Of what
/// is left, the largest connected part is the side of the sample; the others are dents in the ends, enclosed by
/// triangles that face a plate, and belong to that plate (to the side when they touch both plates). The side carries
/// the pressure, and so does the gap between its rim and the plate (measure/hull.h). With an active side plate nothing
/// is loaded: the sides are not free. Cost: O(triangles).
#include "boundary/loaded_triangles.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "measure/delaunay_boundary.h"
#include "measure/hull.h"

#include <math.h>
#include <string.h>

/// Cosine of the largest angle between the normal of a facing triangle and the direction to its plate.
#define FACING_COSINE 0.5

typedef struct marking {
    const scree_state *state;
    scree_hull *hull;
    uint8_t *faces; ///< by node: wall index + 1; 0: none
    uint32_t (*neighbour)[3];
    uint32_t *queue; ///< triangles
} marking;

static double gap_to(const marking *m, const scree_wall *wall, size_t node)
{
    const uint32_t id = m->hull->id[node];
    const scree_boundary_body *body = &m->hull->body[node];
    scree_vector position;
    scree_boundary_place(m->state, id, body, position);
    return wall->normal[2] * position[2] - wall->position - scree_boundary_radius(m->state, id, body);
}

/// Marks the nodes that face a wall.
static void find_facing(const scree_model *model, const marking *m, int index)
{
    const scree_wall *wall = &scree_plates(m->state)[index];
    const scree_wall *opposite = &scree_plates(m->state)[SCREE_WALL_BOTTOM + SCREE_WALL_TOP - index];
    double nearest = INFINITY;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < m->hull->node_count; k++) {
            double gap = gap_to(m, wall, k);
            if (opposite->active && gap > gap_to(m, opposite, k)) continue;
            if (pass == 0) nearest = fmin(nearest, gap);
            if (pass == 1 && gap <= fmax(nearest, model->mean_radius)) m->faces[k] = (uint8_t)(index + 1);
        }
}

/// Twice the area vector of a triangle of the hull, which need not be the state's.
static void area_vector(const marking *m, size_t t, scree_vector area)
{
    scree_vector corner[3];
    for (int c = 0; c < 3; c++) {
        const uint32_t node = m->hull->triangle[t][c];
        scree_boundary_place(m->state, m->hull->id[node], &m->hull->body[node], corner[c]);
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        area[k] = (corner[1][i] - corner[0][i]) * (corner[2][j] - corner[0][j]) -
                  (corner[1][j] - corner[0][j]) * (corner[2][i] - corner[0][i]);
    }
}

/// Triangles that face a plate; all others are loaded for the time being.
static void mark_facing(const marking *m)
{
    for (size_t t = 0; t < m->hull->triangle_count; t++) {
        const uint32_t *node = m->hull->triangle[t];
        int face = m->faces[node[0]];
        m->hull->loaded[t] = SCREE_HULL_LOADED;
        if (face == 0 || m->faces[node[1]] != face || m->faces[node[2]] != face) continue;
        scree_vector area;
        area_vector(m, t, area);
        if (-scree_plates(m->state)[face - 1].normal[2] * area[2] > FACING_COSINE * scree_length(area))
            m->hull->loaded[t] = (uint8_t)(SCREE_HULL_ON_WALL + face - 1);
    }
}

/// A connected part of what faces no plate: its triangles in queue[first .. last), its area, and which walls it
/// touches.
typedef struct part {
    size_t first, last;
    double area;
    unsigned walls;
} part;

/// Twice the area of the triangles queue[first .. last): which part is the largest depends on no order.
static double area_of(const marking *m, size_t first, size_t last)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1))
        for (size_t k = first; k < last; k++) {
            scree_vector area;
            area_vector(m, m->queue[k], area);
            scree_integer_sum_add(&sum, scree_length(area));
        }
    return scree_integer_sum_total(&sum);
}

/// The part that holds the triangle `start`, queued behind those found before; its triangles become bare for the time.
static part collect_part(const marking *m, uint32_t start, size_t first)
{
    part p = {.first = first, .last = first + 1};
    m->queue[first] = start;
    m->hull->loaded[start] = SCREE_HULL_BARE;
    for (size_t k = first; k < p.last; k++)
        for (int c = 0; c < 3; c++) {
            uint32_t beside = m->neighbour[m->queue[k]][c];
            int wall = scree_hull_wall(m->hull, beside);
            if (wall >= 0) p.walls |= 1U << wall;
            if (m->hull->loaded[beside] != SCREE_HULL_LOADED) continue;
            m->hull->loaded[beside] = SCREE_HULL_BARE;
            m->queue[p.last++] = beside;
        }
    p.area = area_of(m, p.first, p.last);
    return p;
}

static void mark_part(const marking *m, const part *p, uint8_t load)
{
    for (size_t k = p->first; k < p->last; k++) m->hull->loaded[m->queue[k]] = load;
}

/// Gives the dents to their plates. A part is settled as soon as a larger one is known.
static void settle_parts(const marking *m)
{
    part largest = {0};
    size_t queued = 0;
    for (size_t t = 0; t < m->hull->triangle_count; t++) {
        if (m->hull->loaded[t] != SCREE_HULL_LOADED) continue;
        // Parts that are the side for certain are behind `queued` and no longer looked at.
        part p = collect_part(m, (uint32_t)t, queued);
        queued = p.last;
        part smaller = p.area > largest.area ? largest : p;
        if (p.area > largest.area) largest = p;
        bool single = smaller.walls == 1U << SCREE_WALL_BOTTOM || smaller.walls == 1U << SCREE_WALL_TOP;
        uint8_t wall = smaller.walls == 1U << SCREE_WALL_BOTTOM ? SCREE_WALL_BOTTOM : SCREE_WALL_TOP;
        if (single) mark_part(m, &smaller, (uint8_t)(SCREE_HULL_ON_WALL + wall));
    }
    for (size_t t = 0; t < m->hull->triangle_count; t++)
        if (m->hull->loaded[t] == SCREE_HULL_BARE) m->hull->loaded[t] = SCREE_HULL_LOADED;
}

scree_status scree_hull_mark_loaded(const scree_model *model, const scree_state *state, scree_hull *hull,
                                    scree_error *error)
{
    bool free_sides = true;
    if (hull->triangle_count == 0) return SCREE_OK;
    for (int w = SCREE_WALL_LEFT; w < SCREE_WALL_COUNT; w++) free_sides = free_sides && !scree_plates(state)[w].active;
    memset(hull->loaded, free_sides ? SCREE_HULL_LOADED : SCREE_HULL_BARE, hull->triangle_count);
    if (!free_sides) return SCREE_OK;
    marking m = {.state = state, .hull = hull};
    scree_status status = scree_allocate(&m.faces, hull->node_count, sizeof *m.faces, error);
    if (!status) status = scree_allocate(&m.neighbour, hull->triangle_count, sizeof *m.neighbour, error);
    if (!status) status = scree_allocate(&m.queue, hull->triangle_count, sizeof *m.queue, error);
    if (!status) status = scree_hull_neighbours(hull, m.neighbour, error);
    if (!status) {
        for (int w = SCREE_WALL_BOTTOM; w <= SCREE_WALL_TOP; w++)
            if (scree_plates(state)[w].active) find_facing(model, &m, w);
        mark_facing(&m);
        settle_parts(&m);
    }
    scree_release(&m.faces);
    scree_release(&m.neighbour);
    scree_release(&m.queue);
    return status;
}
