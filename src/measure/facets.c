/// Facets of the boundary: see facets.h. Cost: O(length of the loop), O(triangles of the hull).
///
/// Area vectors steer boundaries, so facets may come in any order. In 2D that of a node is half the way from the one
/// before to the one behind, turned, times the thickness: no sum. In 3D the shares of a node in its triangles are added
/// as integers, which its area holds until they are all there, in quanta so small that a node could have all triangles:
/// 62 bits less those of their number are left for a share.
#include "measure/facets.h"

#include "base/wrapping.h"
#include "measure/delaunay_boundary.h"

#include <math.h>
#include <string.h>

size_t scree_boundary_count(const scree_state *state)
{
    return state->dimension == 3 ? scree_hull_of(state)->node_count : scree_loop_of(state)->count;
}

size_t scree_facet_count(const scree_state *state)
{
    return state->dimension == 3 ? scree_hull_of(state)->triangle_count : scree_loop_of(state)->count;
}

scree_facet scree_facet_get(const scree_state *state, size_t index)
{
    scree_facet facet = {.corners = state->dimension};
    scree_vector origin;
    scree_boundary_position(state, 0, origin);
    for (int c = 0; c < facet.corners; c++) {
        size_t next = index + (size_t)c < scree_loop_of(state)->count ? index + (size_t)c : 0;
        facet.node[c] = state->dimension == 3 ? scree_hull_of(state)->triangle[index][c] : next;
        scree_boundary_position(state, facet.node[c], facet.position[c]);
        for (int i = 0; i < 3; i++) facet.position[c][i] -= origin[i];
    }
    return facet;
}

/// Place of a body among the grains in the order of their ids.
static uint32_t place_of(const scree_grain_place *grain, size_t grains, uint32_t id)
{
    size_t low = 0, high = grains;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        *(grain[middle].id <= id ? &low : &high) = middle;
    }
    return (uint32_t)low;
}

scree_status scree_facet_rule(const scree_model *model, const scree_state *state, const scree_grain_place *grain,
                              size_t grains, scree_peel_rule *rule, uint32_t **positions, scree_error *error)
{
    size_t d = (size_t)state->dimension, count = scree_facet_count(state);
    *positions = NULL;
    *rule = (scree_peel_rule){.gap_limit = model->upkeep.gap_limit * 2 * model->mean_radius,
                              .hysteresis = model->upkeep.hysteresis,
                              .facet_count = count};
    if (count == 0) return SCREE_OK;
    scree_status status = scree_allocate(positions, count * d, sizeof **positions, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) {
        scree_facet facet = scree_facet_get(state, k);
        for (size_t c = 0; c < d; c++)
            (*positions)[k * d + c] = place_of(grain, grains, scree_boundary_id(state, facet.node[c]));
    }
    scree_peel_rule_sort(*positions, count, state->dimension);
    rule->facet = *positions;
    return SCREE_OK;
}

/// Share of each corner in the area vector of a triangle [m2].
static void corner_area(const scree_facet *facet, scree_vector area)
{
    const double *a = facet->position[0], *b = facet->position[1], *c = facet->position[2];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        area[i] = ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j])) / 6;
    }
}

/// Largest component of all shares [m2].
static double largest_share(const scree_state *state)
{
    double largest = 0;
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        scree_vector share;
        corner_area(&facet, share);
        for (int i = 0; i < 3; i++) largest = fmax(largest, fabs(share[i]));
    }
    return largest;
}

/// Adds to an integer that lies where a double will be.
static void add_quanta(double *position, int64_t quanta)
{
    int64_t sum;
    memcpy(&sum, position, sizeof sum);
    scree_wrapping_add(&sum, quanta);
    memcpy(position, &sum, sizeof sum);
}

static double quanta_at(const double *position)
{
    int64_t sum;
    memcpy(&sum, position, sizeof sum);
    return (double)sum;
}

static void areas_3d(const scree_state *state, scree_vector *area)
{
    int share_bits, number_bits;
    (void)frexp(largest_share(state), &share_bits);
    (void)frexp((double)scree_facet_count(state), &number_bits);
    const double quantum = ldexp(1.0, share_bits + number_bits - 62), inverse = 1 / quantum;
    // Zero is all bits zero, of doubles and of integers.
    memset(area, 0, scree_boundary_count(state) * sizeof *area);
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        scree_vector share;
        corner_area(&facet, share);
        for (int i = 0; i < 3; i++) {
            int64_t quanta = llrint(share[i] * inverse);
            for (int c = 0; c < 3; c++) add_quanta(&area[facet.node[c]][i], quanta);
        }
    }
    for (size_t k = 0; k < scree_boundary_count(state); k++)
        for (int i = 0; i < 3; i++) area[k][i] = quanta_at(&area[k][i]) * quantum;
}

static void areas_2d(const scree_model *model, const scree_state *state, scree_vector *area)
{
    const size_t count = scree_loop_of(state)->count;
    const double half = 0.5 * model->thickness;
    scree_vector before, here, behind;
    if (count == 0) return;
    scree_boundary_position(state, count - 1, before);
    scree_boundary_position(state, 0, here);
    for (size_t k = 0; k < count; k++) {
        scree_boundary_position(state, k + 1 < count ? k + 1 : 0, behind);
        area[k][0] = half * (behind[1] - before[1]);
        area[k][1] = -half * (behind[0] - before[0]);
        area[k][2] = 0;
        memcpy(before, here, sizeof before);
        memcpy(here, behind, sizeof here);
    }
}

void scree_boundary_areas(const scree_model *model, const scree_state *state, scree_vector *area)
{
    if (state->dimension == 3)
        areas_3d(state, area);
    else
        areas_2d(model, state, area);
}
