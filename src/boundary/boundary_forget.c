/// Takes a body out of the Delaunay boundary, which stays closed until it is found anew at the next search: areas,
/// volumes and forces are asked for before that.
///
/// In 2D the neighbours of the vertex are joined. In 3D the triangles around the node go, and a cone takes their place:
/// from one of their other corners over all their outer edges that do not have it. These edges are a closed chain, so
/// the surface is closed again. The strain until now is accumulated before, and the change of what is enclosed is
/// counted as one of a re-detection. The forces of the present step on the other bodies stay, since their work is not
/// all accumulated yet; that on the body leaves with it. Cost: O(boundary), for bodies of the boundary.
#include "boundary/boundary_forget.h"

#include "measure/delaunay_boundary.h"
#include "measure/hull.h"
#include "measure/imposed_gradient.h"
#include "measure/measure.h"
#include "measure/outline.h"

#include <string.h>

/// Moves the elements behind number `k` up by one.
static void close_gap(void *array, size_t size, size_t k, size_t count)
{
    unsigned char *at = (unsigned char *)array + k * size;
    memmove(at, at + size, (count - k - 1) * size);
}

/// What boundaries that impose a velocity gradient keep a node.
static void drop_imposed(scree_state *state, size_t node, bool whole)
{
    scree_imposed_gradient *imposed = scree_imposed(state);
    if (imposed->count == 0) return;
    close_gap(imposed->force, sizeof *imposed->force, node, imposed->count);
    imposed->count = whole ? 0 : imposed->count - 1;
}

static void drop_vertex(scree_loop *loop, size_t k)
{
    close_gap(loop->id, sizeof *loop->id, k, loop->count);
    close_gap(loop->loaded, sizeof *loop->loaded, k, loop->count);
    close_gap(loop->fx, sizeof *loop->fx, k, loop->count);
    close_gap(loop->fy, sizeof *loop->fy, k, loop->count);
    loop->count--;
}

/// Strains are measured from where the bodies of the boundary are now.
static void place_anew(scree_state *state)
{
    scree_loop *loop = scree_loop_of(state);
    scree_hull *hull = scree_hull_of(state);
    for (size_t k = 0; k < loop->count; k++) {
        double x[2];
        scree_loop_position(state, k, x);
        loop->x[k] = x[0];
        loop->y[k] = x[1];
    }
    for (size_t k = 0; k < hull->node_count; k++) scree_hull_position(state, k, hull->position[k]);
}

/// Replaces a triangle around `node` by one with the corner `apex`; false where that has no area.
static bool turn_to(uint32_t triangle[3], uint32_t node, uint32_t apex)
{
    int c = triangle[0] == node ? 0 : triangle[1] == node ? 1 : 2;
    triangle[c] = apex;
    return triangle[(c + 1) % 3] != apex && triangle[(c + 2) % 3] != apex;
}

static bool has_node(const uint32_t triangle[3], uint32_t node)
{
    return triangle[0] == node || triangle[1] == node || triangle[2] == node;
}

static void drop_node(scree_hull *hull, uint32_t node)
{
    uint32_t apex = UINT32_MAX;
    size_t kept = 0;
    for (size_t t = 0; t < hull->triangle_count; t++) {
        uint32_t *triangle = hull->triangle[kept];
        memmove(triangle, hull->triangle[t], sizeof hull->triangle[t]);
        hull->loaded[kept] = hull->loaded[t];
        if (has_node(triangle, node)) {
            if (apex == UINT32_MAX) apex = triangle[0] == node ? triangle[1] : triangle[0];
            if (!turn_to(triangle, node, apex)) continue;
        }
        kept++;
    }
    hull->triangle_count = kept;
    for (size_t t = 0; t < kept; t++)
        for (int c = 0; c < 3; c++) hull->triangle[t][c] -= hull->triangle[t][c] > node;
    close_gap(hull->id, sizeof *hull->id, node, hull->node_count);
    close_gap(hull->force, sizeof *hull->force, node, hull->node_count);
    hull->node_count--;
}

/// Number of the node that is this body; the number of nodes when none is.
static size_t find_node(const scree_state *state, uint32_t id)
{
    const scree_loop *loop = scree_loop_of(state);
    const scree_hull *hull = scree_hull_of(state);
    const uint32_t *ids = state->dimension == 3 ? hull->id : loop->id;
    size_t count = state->dimension == 3 ? hull->node_count : loop->count, node = 0;
    while (node < count && ids[node] != id) node++;
    return node;
}

void scree_boundary_forget(scree_state *state, uint32_t id)
{
    scree_loop *loop = scree_loop_of(state);
    scree_hull *hull = scree_hull_of(state);
    size_t count = state->dimension == 3 ? hull->node_count : loop->count, node = find_node(state, id);
    if (node == count) return;
    double enclosed = scree_strain_close(state);
    bool whole = count <= (size_t)state->dimension + 1; // nothing that encloses anything is left
    drop_imposed(state, node, whole);
    if (whole)
        loop->count = hull->node_count = hull->triangle_count = 0;
    else if (state->dimension == 3)
        drop_node(hull, (uint32_t)node);
    else
        drop_vertex(loop, node);
    place_anew(state);
    scree_strain_redetected(state, enclosed);
    scree_delaunay_boundary_of(state)->stale = 1;
}
