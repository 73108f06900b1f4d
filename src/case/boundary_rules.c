/// Rules of the boundaries: which stage can have which, what can follow what, what a velocity gradient must say.
#include "case/check.h"

#include <math.h>
#include <stdio.h>

/// Notes a problem at stages.INDEX.KEY.
static void refuse(scree_reader *reader, int64_t index, const char *key, const char *message)
{
    char path[SCREE_PATH_BYTES];
    const scree_node *stage = scree_node_at(scree_node_find(reader->root, "stages"), (size_t)index);
    const scree_node *node = scree_node_find(stage, key);
    (void)snprintf(path, sizeof path, "stages.%lld.%s", (long long)index, key);
    scree_problem_add(reader, node ? node->place : stage->place, path, node ? node->text : NULL, NULL, "%s", message);
}

static bool is_periodic(scree_boundary_kind kind)
{
    return kind == SCREE_BOUNDARY_PERIODIC || kind == SCREE_BOUNDARY_CHANNEL;
}

/// What is wrong with the preparation of a periodic sample, and under which key; NULL: nothing.
static const char *wrong_preparation(const scree_config_stage *stage, const char **key)
{
    if (stage->method >= 0 && scree_modules[stage->method]->preparation->needs_walls)
        return "this method needs walls and cannot fill a periodic cell: prepare with gas or on a lattice, and confine";
    *key = "outline";
    return stage->outline != SCREE_SAMPLE_BOX ? "a round sample cannot repeat itself" : NULL;
}

/// What is wrong with a stage of a periodic sample, and under which key; NULL: nothing.
static const char *wrong_in_cell(const scree_config *config, const scree_config_stage *stage, const char **key)
{
    scree_boundary_kind kind = scree_config_boundary_of(config, 0);
    *key = "method";
    if (stage->kind == SCREE_STAGE_PREPARE) return wrong_preparation(stage, key);
    *key = "boundary";
    if (stage->boundary != SCREE_BOUNDARY_AUTO)
        return "the sample is periodic from its preparation on (boundary.periodic) and can have no other boundary";
    *key = "stage";
    if (stage->kind == SCREE_STAGE_DEFORM && kind == SCREE_BOUNDARY_CHANNEL)
        return "only a cell that is periodic in all directions can be deformed: set boundary.periodic";
    if (stage->kind == SCREE_STAGE_ROTATE)
        return "a particle is not turned in a periodic sample, where it would feel its own images: leave out "
               "boundary.periodic";
    return NULL;
}

static void check_periodic(scree_reader *reader, const scree_config *config)
{
    const scree_config_boundary *boundary = &config->boundary;
    const scree_node *section = scree_node_find(reader->root, "boundary"), *node = scree_node_find(section, "periodic");
    const char *wrong = NULL;
    if (boundary->periodic > (1 << config->dimension) - 1)
        wrong = "there is no z in two dimensions";
    else if (config->dimension == 3 && boundary->periodic == SCREE_PERIODIC_X)
        wrong = "in three dimensions a sample is periodic in x and y, or in all directions";
    else if (boundary->periodic == (1 << config->dimension) - 1 &&
             (config->gravity[0] != 0 || config->gravity[1] != 0 || config->gravity[2] != 0))
        wrong = "gravity has nothing to fall on: without a floor the sample would fall for ever";
    if (wrong && node) scree_problem_add(reader, node->place, "boundary.periodic", node->text, NULL, "%s", wrong);
}

static bool is_free_of_plates(scree_boundary_kind kind)
{
    return kind == SCREE_BOUNDARY_MINIMAL || kind == SCREE_BOUNDARY_AFFINE;
}

/// What is wrong with `kind` after `before`; NULL: nothing.
static const char *wrong_order(scree_boundary_kind kind, scree_boundary_kind before)
{
    if (kind == before) return NULL;
    if (before == SCREE_BOUNDARY_WALLS) return "plates cannot come back among grains that have moved freely";
    if (is_free_of_plates(before) && !is_free_of_plates(kind))
        return "plates cannot come back to a sample that has deformed freely: only minimal or affine can follow";
    if (before == SCREE_BOUNDARY_MEMBRANE) return "a membrane cannot be taken away: the stages after it must keep it";
    if (kind == SCREE_BOUNDARY_PLATES) return "plates cannot come back to sides that have deformed freely";
    return NULL;
}

/// What is wrong with `kind` in a stage; NULL: nothing.
static const char *wrong_boundary(const scree_config *config, int stage, scree_boundary_kind kind)
{
    const double *gravity = config->gravity;
    if (stage != SCREE_STAGE_RELAX && config->wall_count > 0)
        return "in a case with walls only relax can follow: the other stages need plates or a free surface of the "
               "sample";
    if (kind == SCREE_BOUNDARY_WALLS && config->wall_count == 0) return "this case has no walls";
    if (stage == SCREE_STAGE_RELAX && kind != SCREE_BOUNDARY_WALLS && kind != SCREE_BOUNDARY_PLATES)
        return "relax needs something that stands: give boundary: plates, or walls and boundary: walls";
    if (is_free_of_plates(kind) && (gravity[0] != 0 || gravity[1] != 0 || gravity[2] != 0))
        return "without plates nothing holds the sample against gravity";
    if (stage == SCREE_STAGE_DEFORM && !is_free_of_plates(kind))
        return "deform imposes a velocity gradient on the boundary: give boundary: minimal or affine, or make the "
               "sample periodic";
    if (stage != SCREE_STAGE_DEFORM && kind == SCREE_BOUNDARY_AFFINE)
        return "affine needs all components of a velocity gradient: use a deform stage";
    return NULL;
}

static bool is_given(const double tensor[9], int component)
{
    return !isnan(tensor[component]);
}

/// What is wrong with the prescribed components of a deform stage, and under which key; NULL: nothing.
static const char *wrong_components(const scree_config_stage *stage, int dimension, scree_boundary_kind kind,
                                    const char **key)
{
    const double *full = stage->velocity_gradient, *symmetric = stage->strain_rate;
    double largest = 0;
    for (int c = 0; c < 9; c++) {
        int mirror = 3 * (c % 3) + c / 3;
        bool outside = c / 3 >= dimension || c % 3 >= dimension;
        *key = is_given(full, c) ? "velocity_gradient" : "strain_rate";
        if (outside && (is_given(full, c) || is_given(symmetric, c))) return "there is no z in two dimensions";
        if (is_given(symmetric, c) && (is_given(full, c) || is_given(full, mirror)))
            return "a component is prescribed twice, by velocity_gradient and by strain_rate";
        if (kind == SCREE_BOUNDARY_MINIMAL && c != mirror && is_given(full, c) && !is_given(full, mirror))
            return "a rigid rotation would satisfy one component beside the diagonal without any strain: give its "
                   "mirror too (0 for simple shear), or the strain_rate";
        *key = "stress";
        if (is_given(stage->stress, c)) {
            if (kind != SCREE_BOUNDARY_PERIODIC) return "only a periodic cell can hold stresses: set boundary.periodic";
            if (outside) return "there is no z in two dimensions";
            if (is_given(full, c) || is_given(symmetric, c))
                return "the same component has a rate: give one of the two";
        }
        *key = "velocity_gradient";
        if (kind == SCREE_BOUNDARY_AFFINE && !outside && !is_given(full, c))
            return "affine moves every body of the boundary: all components must be given";
        if (is_given(full, c)) largest = fmax(largest, fabs(full[c]));
        if (is_given(symmetric, c)) largest = fmax(largest, fabs(symmetric[c]));
    }
    *key = "strain";
    return largest > 0 ? NULL : "no component of velocity_gradient or strain_rate moves, so it is never reached";
}

/// Why the forced particle cannot be turned, or NULL.
static const char *wrong_particle(const scree_config *config, const scree_config_stage *stage, const char **key)
{
    *key = "axis";
    if (stage->axis != SCREE_AXIS_Z && config->dimension == 2) return "in two dimensions a particle turns about z only";
    *key = "particle";
    if (isnan(stage->particle)) return NULL;
    if (stage->particle != floor(stage->particle)) return "the number of a particle is whole";
    return stage->particle < (double)config->particles.count
               ? NULL
               : "there is no such particle: numbers begin at 0 and end below particles.count";
}

void scree_rules_check_boundaries(scree_reader *reader, const scree_config *config)
{
    scree_boundary_kind before = SCREE_BOUNDARY_AUTO;
    for (int64_t i = 0; i < config->stage_count; i++)
        if (config->stages[i].kind < 0 || config->stages[i].boundary < 0) return; // wrong, and noted
    if (config->boundary.lateral < 0 || config->boundary.periodic < 0) return;
    check_periodic(reader, config);
    bool round = false;
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_config_stage *stage = &config->stages[i];
        scree_boundary_kind kind = scree_config_boundary_of(config, i);
        if (stage->kind == SCREE_STAGE_PREPARE) round = stage->outline != SCREE_SAMPLE_BOX;
        if (stage->kind == SCREE_STAGE_PREPARE && !is_periodic(kind)) continue;
        const char *key = "boundary", *wrong = is_periodic(kind) ? wrong_in_cell(config, stage, &key)
                                                                 : wrong_boundary(config, stage->kind, kind);
        if (round && !is_periodic(kind) && !is_free_of_plates(kind) && kind != SCREE_BOUNDARY_WALLS)
            wrong = "a round sample has no plates: give boundary: minimal or affine";
        if (!wrong && before != SCREE_BOUNDARY_AUTO) wrong = wrong_order(kind, before);
        if (!wrong && stage->kind == SCREE_STAGE_DEFORM)
            wrong = wrong_components(stage, (int)config->dimension, kind, &key);
        if (!wrong && stage->kind == SCREE_STAGE_ROTATE) wrong = wrong_particle(config, stage, &key);
        if (wrong) refuse(reader, i, key, wrong);
        before = kind;
    }
}
