/// Selection of a side of the sample: bodies on its Delaunay outline that are nearest to this side of the box around
/// it.
///
/// The outline is the loop (2D) or the surface (3D) of search/delaunay.h of all grains at their present positions, with
/// `boundary.gap_limit` and without a memory. A body of it belongs to a side when its centre is no farther from that
/// side of the box around the centres than from the nearest side of all, give or take a mean radius; so bodies at
/// corners belong to all sides that meet there. For samples that look like a box; a slanted side belongs to two. Cost:
/// one triangulation.
#include "case/check.h"
#include "module/key_rows.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"
#include "selection/selection.h"
#include "shape/outlines.h"
#include "state/body.h"

/// 2 x axis, plus 1 for the larger coordinate. The last axis is upwards; the others, in 2D none, are in between.
typedef enum side { SIDE_LEFT, SIDE_RIGHT, SIDE_BOTTOM, SIDE_TOP, SIDE_FRONT, SIDE_BACK } side;

typedef struct select_side {
    int side;
} select_side;

/// The grains in the order of their ids.
typedef struct sample {
    size_t count;
    uint32_t *row;
    double *points, *radius; ///< m
    uint8_t *outer;          ///< is on the outline
    scree_outlines outlines; ///< of the grains
} sample;

static void destroy(sample *s)
{
    scree_release(&s->row);
    scree_release(&s->points);
    scree_release(&s->radius);
    scree_release(&s->outer);
    scree_outlines_destroy(&s->outlines);
}

static scree_status gather(const scree_state *state, sample *s, scree_error *error)
{
    size_t axes = (size_t)state->dimension;
    *s = (sample){.count = scree_grain_count(state)};
    scree_status status = scree_grains_by_id(state, &s->row, error);
    if (!status) status = scree_allocate(&s->points, axes * s->count + 1, sizeof *s->points, error);
    if (!status) status = scree_allocate(&s->radius, s->count + 1, sizeof *s->radius, error);
    if (!status) status = scree_allocate(&s->outer, s->count + 1, sizeof *s->outer, error);
    if (!status) status = scree_outlines_find(state, &s->outlines, error);
    for (size_t k = 0; k < s->count && !status; k++) {
        scree_vector place;
        scree_body_position(state, s->row[k], place);
        for (size_t i = 0; i < axes; i++) s->points[axes * k + i] = place[i];
        s->radius[k] = scree_body_bounding_radius(state, s->row[k]);
    }
    return status;
}

static scree_status find_outline(const scree_model *model, sample *s, scree_error *error)
{
    const scree_peel_rule rule = {.gap_limit = 2 * model->mean_radius * model->upkeep.gap_limit,
                                  .outline = s->outlines.core};
    if (model->dimension == 2) {
        uint32_t *loop = NULL;
        size_t count = 0;
        scree_status status =
            scree_outer_loop(s->points, s->radius, s->count, 2 * model->mean_radius, &rule, &loop, &count, error);
        for (size_t k = 0; k < count && !status; k++) s->outer[loop[k]] = 1;
        scree_release(&loop);
        return status;
    }
    scree_triangle_surface surface = {0};
    scree_status status =
        scree_outer_surface(s->points, s->radius, s->count, 2 * model->mean_radius, &rule, &surface, error);
    for (size_t k = 0; k < surface.count && !status; k++)
        for (int i = 0; i < 3; i++) s->outer[surface.triangle[k][i]] = 1;
    scree_triangle_surface_destroy(&surface);
    return status;
}

/// Distances of a centre from the sides of the box [m].
static void measure(const double *point, int axes, double box[2][3], double distance[6])
{
    for (int i = 0; i < axes; i++) {
        distance[2 * i] = point[i] - box[0][i];
        distance[2 * i + 1] = box[1][i] - point[i];
    }
}

static void choose_nearest(const sample *s, int axes, int wanted, double margin, uint8_t *chosen)
{
    double box[2][3], distance[6];
    for (int i = 0; i < axes; i++) {
        box[0][i] = INFINITY;
        box[1][i] = -INFINITY;
    }
    for (size_t k = 0; k < s->count; k++)
        for (int i = 0; i < axes && s->outer[k]; i++) {
            box[0][i] = fmin(box[0][i], s->points[(size_t)axes * k + (size_t)i]);
            box[1][i] = fmax(box[1][i], s->points[(size_t)axes * k + (size_t)i]);
        }
    for (size_t k = 0; k < s->count; k++) {
        double least = INFINITY;
        measure(&s->points[(size_t)axes * k], axes, box, distance);
        for (int i = 0; i < 2 * axes; i++) least = fmin(least, distance[i]);
        chosen[s->row[k]] = s->outer[k] && distance[wanted] <= least + margin;
    }
}

static scree_status choose(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                           scree_error *error)
{
    // In which place a side stands among the distances.
    static const int flat[] = {0, 1, 2, 3, -1, -1}, solid[] = {0, 1, 4, 5, 2, 3};
    int wanted = (model->dimension == 3 ? solid : flat)[((const select_side *)own)->side];
    sample s;
    scree_status status = gather(state, &s, error);
    if (!status) status = find_outline(model, &s, error);
    if (!status) choose_nearest(&s, model->dimension, wanted, model->mean_radius, chosen);
    destroy(&s);
    return status;
}

static void rules(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const select_side *own = config->selections[i].own;
        char path[SCREE_PATH_BYTES];
        if (config->selections[i].kind != SCREE_SLOT_select_side || !own) continue;
        (void)snprintf(path, sizeof path, "selections.%lld.side", (long long)i);
        if (config->boundary.periodic > 0)
            scree_rule_refuse(reader, path, NULL, "a periodic sample has no outline: use band or layer");
        else if (config->dimension == 2 && own->side >= SIDE_FRONT)
            scree_rule_refuse(reader, path, "left, right, bottom, top", "exists in three dimensions only");
    }
}

static const scree_choice sides[] = {
    {"left", SIDE_LEFT, "where x is least"},
    {"right", SIDE_RIGHT, "where x is largest"},
    {"bottom", SIDE_BOTTOM, "least y, in 3D least z"},
    {"top", SIDE_TOP, "largest y, in 3D largest z"},
    {"front", SIDE_FRONT, "least y, in 3D"},
    {"back", SIDE_BACK, "largest y, in 3D"},
    {0},
};
static const scree_key keys[] = {
    CHOICE(select_side, side, sides, .meaning = "Which side."),
};
static const scree_selection_kind kind = {.choose = choose};

const scree_module scree_module_select_side = {
    .name = "side",
    .meaning = "Particles on one side of the Delaunay outline of the sample.",
    .choice_of = CHOICE_OF(IS("selections")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, select_side)},
    .keys_count = 1,
    .rules = rules,
    .selection = &kind,
};
