/// Facets of the boundary: see facets.h. Cost: O(length of the loop), O(triangles of the hull).
#include "measure/facets.h"
#include "measure/delaunay_boundary.h"

size_t scree_boundary_count(const scree_state *state)
{
    return state->dimension == 3 ? scree_hull_of(state)->node_count : scree_loop_of(state)->count;
}

size_t scree_boundary_row(const scree_state *state, size_t node)
{
    return state->row_of_id[state->dimension == 3 ? scree_hull_of(state)->id[node] : scree_loop_of(state)->id[node]];
}

size_t scree_facet_count(const scree_state *state)
{
    return state->dimension == 3 ? scree_hull_of(state)->triangle_count : scree_loop_of(state)->count;
}

scree_facet scree_facet_get(const scree_state *state, size_t index)
{
    scree_facet facet = {.corners = state->dimension};
    scree_vector origin;
    scree_body_place(state, scree_boundary_row(state, 0), origin);
    for (int c = 0; c < facet.corners; c++) {
        size_t next = index + (size_t)c < scree_loop_of(state)->count ? index + (size_t)c : 0;
        facet.node[c] = state->dimension == 3 ? scree_hull_of(state)->triangle[index][c] : next;
        scree_body_place(state, scree_boundary_row(state, facet.node[c]), facet.place[c]);
        for (int i = 0; i < 3; i++) facet.place[c][i] -= origin[i];
    }
    return facet;
}

scree_status scree_facet_rule(const scree_model *model, const scree_state *state, scree_peel_rule *rule, uint32_t **ids,
                              scree_error *error)
{
    const scree_config_boundary *boundary = &model->config->boundary;
    size_t d = (size_t)state->dimension, count = scree_facet_count(state);
    *ids = NULL;
    *rule = (scree_peel_rule){.gap_limit = boundary->gap_limit * 2 * model->mean_radius,
                              .hysteresis = boundary->gap_hysteresis,
                              .facet_count = count};
    if (count == 0) return SCREE_OK;
    scree_status status = scree_allocate(ids, count * d, sizeof **ids, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) {
        scree_facet facet = scree_facet_get(state, k);
        for (size_t c = 0; c < d; c++) (*ids)[k * d + c] = state->id[scree_boundary_row(state, facet.node[c])];
    }
    scree_peel_rule_sort(*ids, count, state->dimension);
    rule->facet = *ids;
    return SCREE_OK;
}

/// Share of each corner in the area vector of the facet [m2].
static void corner_area(const scree_model *model, const scree_facet *facet, scree_vector area)
{
    const double *a = facet->place[0], *b = facet->place[1], *c = facet->place[2];
    if (facet->corners == 2) {
        area[0] = 0.5 * model->thickness * (b[1] - a[1]);
        area[1] = -0.5 * model->thickness * (b[0] - a[0]);
        area[2] = 0;
        return;
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        area[i] = ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j])) / 6;
    }
}

void scree_boundary_areas(const scree_model *model, const scree_state *state, scree_vector *area)
{
    for (size_t k = 0; k < scree_boundary_count(state); k++) area[k][0] = area[k][1] = area[k][2] = 0;
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        scree_vector share;
        corner_area(model, &facet, share);
        for (int c = 0; c < facet.corners; c++)
            for (int i = 0; i < 3; i++) area[facet.node[c]][i] += share[i];
    }
}

double scree_boundary_volume(const scree_model *model, const scree_state *state)
{
    double volume = 0;
    // (1/d) sum x . a over the corners of all facets.
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        scree_vector share;
        corner_area(model, &facet, share);
        for (int c = 0; c < facet.corners; c++)
            for (int i = 0; i < state->dimension; i++) volume += facet.place[c][i] * share[i] / state->dimension;
    }
    return volume;
}
