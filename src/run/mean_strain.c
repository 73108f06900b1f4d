/// Mean strain of the sample over the Delaunay cells of its particles (Bagi 1996; M 4.4-4.6), since the stage began.
///
/// Displacements are linear within a cell, so the mean over the volume of all cells is an integral over their outer
/// faces alone,
///     u_i,j = 1/V sum over faces (mean of u_i over the corners) n_j A,    strain = its symmetric part
/// with the outline as places and orientations at the begin of the stage have it (boundary.gap_limit cuts cells that
/// reach across gaps, of polygons those between their outlines). Tension positive. The outline is found anew for every
/// sample from these places, so nothing is remembered. Cost: a triangulation a sample, some 10 microseconds a disc.
/// Limits: a sample that repeats itself has no outline.
#include "case/case.h"
#include "case/check.h"
#include "model/model.h"
#include "module/key_rows.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"
#include "shape/outlines.h"
#include "state/body.h"

#include <math.h>

/// Its keys, and its numbers.
typedef struct config {
    bool mean_strain;
} config;

static const scree_key keys[] = {
    FLAG(config, mean_strain, .standard = "no",
         .meaning = "Columns mean_strain_...: mean over the Delaunay cells of all particles, since the stage began."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_mean_strain, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    if (own && own->mean_strain && whole->boundary.periodic > 0)
        scree_rule_refuse(reader, "measure.mean_strain", "no",
                          "a sample that repeats itself has no outline: take axial_strain, or gauges");
}

// ---- the sample --------------------------------------------------------------------------------------------------

/// The grains in the order of their ids.
typedef struct grains {
    size_t count;
    uint32_t *row;
    double *place, *radius; ///< m, at the begin
    double (*moved)[3];     ///< m
    scree_outlines outlines;
} grains;

static void destroy(grains *g)
{
    scree_release(&g->row);
    scree_release(&g->place);
    scree_release(&g->radius);
    scree_release(&g->moved);
    scree_outlines_destroy(&g->outlines);
}

static scree_status gather(const scree_state *state, grains *g, scree_error *error)
{
    const size_t axes = (size_t)state->dimension;
    *g = (grains){.count = scree_grain_count(state)};
    scree_status status = scree_grains_by_id(state, &g->row, error);
    if (!status) status = scree_allocate(&g->place, axes * g->count + 1, sizeof *g->place, error);
    if (!status) status = scree_allocate(&g->radius, g->count + 1, sizeof *g->radius, error);
    if (!status) status = scree_allocate(&g->moved, g->count + 1, sizeof *g->moved, error);
    if (!status) status = scree_outlines_find_reference(state, &g->outlines, error);
    for (size_t k = 0; k < g->count && !status; k++) {
        const double *begin = state->reference[g->row[k]];
        scree_vector now;
        scree_body_position(state, g->row[k], now);
        for (size_t i = 0; i < axes; i++) {
            g->place[axes * k + i] = begin[i];
            g->moved[k][i] = now[i] - begin[i];
        }
        g->radius[k] = scree_body_bounding_radius(state, g->row[k]);
    }
    return status;
}

/// Displacement gradient of a loop, 3 x 3 by rows.
static scree_status loop_gradient(const scree_model *model, const grains *g, const scree_peel_rule *rule,
                                  double gradient[9], scree_error *error)
{
    uint32_t *loop = NULL;
    size_t count = 0;
    double area = 0;
    scree_status status =
        scree_outer_loop(g->place, g->radius, g->count, 2 * model->mean_radius, rule, &loop, &count, error);
    for (size_t k = 0; k < count && !status; k++) {
        const uint32_t one = loop[k], other = loop[k + 1 < count ? k + 1 : 0];
        const double *a = &g->place[(size_t)2 * one], *b = &g->place[(size_t)2 * other], *origin = g->place;
        const double outwards[2] = {b[1] - a[1], a[0] - b[0]};
        for (int i = 0; i < 2; i++) {
            area += 0.25 * outwards[i] * (a[i] + b[i] - 2 * origin[i]);
            for (int j = 0; j < 2; j++)
                gradient[3 * i + j] += 0.5 * (g->moved[one][i] + g->moved[other][i]) * outwards[j];
        }
    }
    for (int k = 0; k < 9; k++) gradient[k] /= area;
    scree_release(&loop);
    return status;
}

static scree_status surface_gradient(const scree_model *model, const grains *g, const scree_peel_rule *rule,
                                     double gradient[9], scree_error *error)
{
    scree_triangle_surface surface = {0};
    double volume = 0;
    scree_status status =
        scree_outer_surface(g->place, g->radius, g->count, 2 * model->mean_radius, rule, &surface, error);
    for (size_t t = 0; t < surface.count && !status; t++) {
        const uint32_t *of = surface.triangle[t];
        double corner[3][3], area[3];
        for (int c = 0; c < 3; c++)
            for (size_t i = 0; i < 3; i++) corner[c][i] = g->place[3 * of[c] + i] - g->place[i];
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            area[i] = 0.5 * ((corner[1][j] - corner[0][j]) * (corner[2][k] - corner[0][k]) -
                             (corner[1][k] - corner[0][k]) * (corner[2][j] - corner[0][j]));
        }
        for (int i = 0; i < 3; i++) {
            volume += area[i] * (corner[0][i] + corner[1][i] + corner[2][i]) / 9;
            const double mean = (g->moved[of[0]][i] + g->moved[of[1]][i] + g->moved[of[2]][i]) / 3;
            for (int j = 0; j < 3; j++) gradient[3 * i + j] += mean * area[j];
        }
    }
    for (int k = 0; k < 9; k++) gradient[k] /= volume;
    scree_triangle_surface_destroy(&surface);
    return status;
}

// ---- the columns -------------------------------------------------------------------------------------------------

static const scree_result columns[] = {
    {"mean_strain_xx", "1", "mean strain over the Delaunay cells since the stage began, tension positive"},
    {"mean_strain_yy", "1", "the same"},
    {"mean_strain_zz", "1", "the same; not a number in 2D"},
    {"mean_strain_yz", "1", "the same; not a number in 2D"},
    {"mean_strain_xz", "1", "the same; not a number in 2D"},
    {"mean_strain_xy", "1", "the same, half of the engineering shear strain"},
    {"mean_strain_volume", "1", "its trace"},
};

static scree_status sample(const scree_context *context, size_t index, double *value, scree_error *error)
{
    static const int first[] = {0, 1, 2, 1, 0, 0}, second[] = {0, 1, 2, 2, 2, 1};
    const scree_model *model = context->model;
    const bool in_3d = model->dimension == 3;
    double g[9] = {0};
    grains all;
    (void)index;
    scree_status status = gather(context->state, &all, error);
    const scree_peel_rule rule = {.gap_limit = 2 * model->mean_radius * model->upkeep.gap_limit,
                                  .outline = all.outlines.core};
    if (!status)
        status = in_3d ? surface_gradient(model, &all, &rule, g, error) : loop_gradient(model, &all, &rule, g, error);
    for (int k = 0; k < 6; k++) {
        const int i = first[k], j = second[k];
        const bool exists = in_3d || (i != 2 && j != 2);
        value[k] = exists ? 0.5 * (g[3 * i + j] + g[3 * j + i]) : (double)NAN;
    }
    value[6] = g[0] + g[4] + g[8];
    destroy(&all);
    return status;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    const config *own = own_config(whole);
    name[0] = 0;
    return index == 0 && own && own->mean_strain;
}

const scree_module scree_module_mean_strain = {
    .name = "mean_strain",
    .meaning = "mean strain over the Delaunay cells",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .columns = SCREE_RESULTS(columns, sample),
    .told = told,
};
