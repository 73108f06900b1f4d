/// Rules of given bodies; overlaps by a grid of cells as wide as the largest body.
#include "prepare/given.h"

#include "base/memory.h"
#include "base/vectors.h"
#include "case/check.h"
#include "prepare/given_outline.h"
#include "prepare/methods.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool scree_given_has_box(const scree_config *config)
{
    if (config->stage_count < 2) return true;
    const scree_boundary *boundary = scree_config_held_by(config, 1);
    return !boundary || !boundary->open;
}

/// Whether a stage brings the particles that are not given.
static bool pours(const scree_config *config)
{
    for (int64_t i = 0; i < config->stage_count; i++)
        if (config->stages[i].kind >= 0 && scree_modules[config->stages[i].kind]->numbers->pours) return true;
    return false;
}

static void check_count(scree_reader *reader, const scree_config *config, size_t count)
{
    const scree_node *node = scree_node_find(scree_node_find(reader->root, "particles"), "count");
    const bool fewer = pours(config) && (int64_t)count <= config->particles.count;
    if (!node || config->particles.count == (int64_t)count || fewer) return;
    char accepted[32];
    (void)snprintf(accepted, sizeof accepted, "%zu", count);
    scree_problem_add(reader, node->place, "particles.count", node->text, accepted, "stages.0 gives %s bodies",
                      accepted);
}

bool scree_given_rules(scree_reader *reader, const scree_config *config, size_t count)
{
    const scree_config_stage *stage = scree_config_prepare(config);
    if (scree_config_prepared(stage)->outline != SCREE_SAMPLE_BOX) {
        scree_rule_refuse(reader, "stages.0.outline", "box",
                          "bodies that are given are not cut out of a larger packing");
        return false; // a round sample has no sides
    }
    if (config->particles.species_count > 0) {
        scree_rule_refuse(reader, "particles.species", NULL,
                          "bodies that are given have their own materials and sizes: say particles.material and the "
                          "sizes in place of species");
        return false;
    }
    check_count(reader, config, count);
    return true;
}

// ---- overlaps ------------------------------------------------------------------------------------------------------

typedef struct grid {
    double lower[3], cell;
    size_t side[3];
    uint32_t *begin, *body; ///< of each cell in `body`
} grid;

/// No body reaches farther from its centre [m].
static double reach_of(const scree_given_bodies *bodies, size_t i)
{
    return bodies->outlines ? scree_given_reach(bodies->outlines, bodies->radius[i]) : bodies->radius[i];
}

static size_t cell_of(const grid *g, const scree_given_bodies *bodies, size_t i)
{
    size_t index[3] = {0};
    for (int k = 0; k < 3 && bodies->place[k]; k++)
        index[k] = scree_cell_within(bodies->place[k][i] - g->lower[k], g->cell, g->side[k]);
    return (index[2] * g->side[1] + index[1]) * g->side[0] + index[0];
}

/// Cells as wide as the largest body, or wider so that there are no more of them than bodies.
static void size_grid(grid *g, const scree_given_bodies *bodies)
{
    const double *const *place = bodies->place;
    const double count = (double)bodies->count;
    double upper[3] = {0}, cells = 1;
    for (int k = 0; k < 3; k++) {
        g->side[k] = 1;
        for (size_t i = 0; i < bodies->count && place[k]; i++) {
            g->lower[k] = i ? fmin(g->lower[k], place[k][i]) : place[k][i];
            upper[k] = i ? fmax(upper[k], place[k][i]) : place[k][i];
        }
    }
    for (size_t i = 0; i < bodies->count; i++) g->cell = fmax(g->cell, 2 * reach_of(bodies, i));
    for (int k = 0; k < 3; k++) cells *= fmax((upper[k] - g->lower[k]) / g->cell, 1);
    if (cells > count) g->cell *= cbrt(cells / count) * (place[2] ? 1 : sqrt(cbrt(cells / count)));
    for (int k = 0; k < 3 && place[k]; k++) g->side[k] = (size_t)((upper[k] - g->lower[k]) / g->cell) + 1;
}

static scree_status fill_grid(grid *g, const scree_given_bodies *bodies, scree_error *error)
{
    const size_t cells = g->side[0] * g->side[1] * g->side[2];
    scree_status status = scree_allocate(&g->begin, cells + 2, sizeof *g->begin, error);
    if (!status) status = scree_allocate(&g->body, bodies->count, sizeof *g->body, error);
    if (status) return status;
    for (size_t i = 0; i < bodies->count; i++) g->begin[cell_of(g, bodies, i) + 2]++;
    for (size_t c = 2; c < cells + 2; c++) g->begin[c] += g->begin[c - 1];
    for (size_t i = 0; i < bodies->count; i++) g->body[g->begin[cell_of(g, bodies, i) + 1]++] = (uint32_t)i;
    return SCREE_OK;
}

/// What a search looks at.
typedef struct looked {
    const grid *grid;
    const scree_given_bodies *bodies;
    double allowed;
    scree_given_overlap *found;
} looked;

static scree_given_outline outline_of(const scree_given_bodies *bodies, size_t i)
{
    const double angle = bodies->angle ? bodies->angle[i] : 0;
    return scree_given_outline_of(bodies->outlines, i, bodies->radius[i], angle);
}

/// Overlap of two outlines [m]; smaller: the smaller reach of both [m].
static double outlines_overlap(const scree_given_bodies *bodies, const size_t pair[2], const double apart[2],
                               double *smaller)
{
    const scree_given_outline first = outline_of(bodies, pair[0]), second = outline_of(bodies, pair[1]);
    *smaller = fmin(first.bound, second.bound);
    return scree_given_outline_depth(&first, &second, apart).overlap;
}

static void look_at(looked *l, size_t one, size_t other)
{
    const scree_given_bodies *bodies = l->bodies;
    const size_t pair[2] = {one < other ? one : other, one < other ? other : one};
    const double sum = reach_of(bodies, one) + reach_of(bodies, other);
    double apart[3] = {0}, smaller = fmin(bodies->radius[one], bodies->radius[other]);
    for (int k = 0; k < 3 && bodies->place[k]; k++) apart[k] = bodies->place[k][pair[1]] - bodies->place[k][pair[0]];
    const double distance = scree_length(apart);
    if (!(distance < sum)) return;
    const double overlap = bodies->outlines ? outlines_overlap(bodies, pair, apart, &smaller) : sum - distance;
    const double share = overlap / smaller;
    l->found->count += share > l->allowed;
    if (share > l->found->share) *l->found = (scree_given_overlap){l->found->count, pair[0], pair[1], overlap, share};
}

static void look_around(looked *l, size_t body)
{
    const grid *g = l->grid;
    size_t at[3] = {0};
    for (int k = 0; k < 3 && l->bodies->place[k]; k++)
        at[k] = scree_cell_within(l->bodies->place[k][body] - g->lower[k], g->cell, g->side[k]);
    for (size_t z = at[2] > 0 ? at[2] - 1 : 0; z < g->side[2] && z <= at[2] + 1; z++)
        for (size_t y = at[1] > 0 ? at[1] - 1 : 0; y < g->side[1] && y <= at[1] + 1; y++)
            for (size_t x = at[0] > 0 ? at[0] - 1 : 0; x < g->side[0] && x <= at[0] + 1; x++) {
                const size_t cell = (z * g->side[1] + y) * g->side[0] + x;
                for (uint32_t k = g->begin[cell]; k < g->begin[cell + 1]; k++)
                    if (g->body[k] < body) look_at(l, body, g->body[k]);
            }
}

scree_status scree_given_find_overlap(const scree_given_bodies *bodies, double allowed, scree_given_overlap *found,
                                      scree_error *error)
{
    grid g = {0};
    *found = (scree_given_overlap){0};
    size_grid(&g, bodies);
    scree_status status = fill_grid(&g, bodies, error);
    looked l = {&g, bodies, allowed, found};
    for (size_t i = 0; i < bodies->count && !status; i++) look_around(&l, i);
    scree_release(&g.begin);
    scree_release(&g.body);
    return status;
}
