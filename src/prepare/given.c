/// Rules of given bodies; overlaps by a grid of cells as wide as the largest body.
#include "prepare/given.h"

#include "base/memory.h"
#include "case/check.h"
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

static size_t cell_of(const grid *g, const double *const place[3], size_t i)
{
    size_t index[3] = {0};
    for (int k = 0; k < 3 && place[k]; k++)
        index[k] = scree_cell_within(place[k][i] - g->lower[k], g->cell, g->side[k]);
    return (index[2] * g->side[1] + index[1]) * g->side[0] + index[0];
}

/// Cells as wide as the largest body, or wider so that there are no more of them than bodies.
static void size_grid(grid *g, size_t count, const double *const place[3], const double *radius)
{
    double upper[3] = {0}, cells = 1;
    for (int k = 0; k < 3; k++) {
        g->side[k] = 1;
        for (size_t i = 0; i < count && place[k]; i++) {
            g->lower[k] = i ? fmin(g->lower[k], place[k][i]) : place[k][i];
            upper[k] = i ? fmax(upper[k], place[k][i]) : place[k][i];
        }
    }
    for (size_t i = 0; i < count; i++) g->cell = fmax(g->cell, 2 * radius[i]);
    for (int k = 0; k < 3; k++) cells *= fmax((upper[k] - g->lower[k]) / g->cell, 1);
    if (cells > (double)count)
        g->cell *= cbrt(cells / (double)count) * (place[2] ? 1 : sqrt(cbrt(cells / (double)count)));
    for (int k = 0; k < 3 && place[k]; k++) g->side[k] = (size_t)((upper[k] - g->lower[k]) / g->cell) + 1;
}

static scree_status fill_grid(grid *g, size_t count, const double *const place[3], scree_error *error)
{
    const size_t cells = g->side[0] * g->side[1] * g->side[2];
    scree_status status = scree_allocate(&g->begin, cells + 2, sizeof *g->begin, error);
    if (!status) status = scree_allocate(&g->body, count, sizeof *g->body, error);
    if (status) return status;
    for (size_t i = 0; i < count; i++) g->begin[cell_of(g, place, i) + 2]++;
    for (size_t c = 2; c < cells + 2; c++) g->begin[c] += g->begin[c - 1];
    for (size_t i = 0; i < count; i++) g->body[g->begin[cell_of(g, place, i) + 1]++] = (uint32_t)i;
    return SCREE_OK;
}

/// What a search looks at.
typedef struct looked {
    const grid *grid;
    const double *const *place;
    const double *radius;
    double allowed, worst;
    scree_given_overlap *found;
} looked;

static void look_at(looked *l, size_t one, size_t other)
{
    double square = 0;
    const double smaller = fmin(l->radius[one], l->radius[other]), sum = l->radius[one] + l->radius[other];
    for (int k = 0; k < 3 && l->place[k]; k++) {
        const double apart = l->place[k][one] - l->place[k][other];
        square += apart * apart;
    }
    if (!(square < sum * sum)) return;
    const double overlap = sum - sqrt(square), share = overlap / smaller;
    l->found->count += share > l->allowed;
    if (!(share > l->worst)) return;
    l->worst = share;
    l->found->first = one < other ? one : other;
    l->found->second = one < other ? other : one;
    l->found->overlap = overlap;
}

static void look_around(looked *l, size_t body)
{
    const grid *g = l->grid;
    size_t at[3] = {0};
    for (int k = 0; k < 3 && l->place[k]; k++)
        at[k] = scree_cell_within(l->place[k][body] - g->lower[k], g->cell, g->side[k]);
    for (size_t z = at[2] > 0 ? at[2] - 1 : 0; z < g->side[2] && z <= at[2] + 1; z++)
        for (size_t y = at[1] > 0 ? at[1] - 1 : 0; y < g->side[1] && y <= at[1] + 1; y++)
            for (size_t x = at[0] > 0 ? at[0] - 1 : 0; x < g->side[0] && x <= at[0] + 1; x++) {
                const size_t cell = (z * g->side[1] + y) * g->side[0] + x;
                for (uint32_t k = g->begin[cell]; k < g->begin[cell + 1]; k++)
                    if (g->body[k] < body) look_at(l, body, g->body[k]);
            }
}

scree_status scree_given_find_overlap(size_t count, const double *const place[3], const double *radius, double allowed,
                                      scree_given_overlap *found, scree_error *error)
{
    grid g = {0};
    *found = (scree_given_overlap){0};
    size_grid(&g, count, place, radius);
    scree_status status = fill_grid(&g, count, place, error);
    looked l = {&g, place, radius, allowed, 0, found};
    for (size_t i = 0; i < count && !status; i++) look_around(&l, i);
    scree_release(&g.begin);
    scree_release(&g.body);
    return status;
}
