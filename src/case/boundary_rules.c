/// Rules of the boundaries: which stage can have which, what can follow what.
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
static const char *wrong_preparation(const scree_prepare_config *stage, const char **key)
{
    if (stage->method >= 0 && scree_modules[stage->method]->preparation->needs_walls)
        return "this method needs walls and cannot fill a periodic cell: prepare with gas or on a lattice, and confine";
    *key = "outline";
    return stage->outline != SCREE_SAMPLE_BOX ? "a round sample cannot repeat itself" : NULL;
}

/// What is wrong with a stage of a periodic sample, and under which key; NULL: nothing.
static const char *wrong_in_cell(const scree_config_stage *stage, const char **key)
{
    *key = "method";
    if (scree_modules[stage->kind]->numbers->places) return wrong_preparation(scree_config_prepared(stage), key);
    *key = "boundary";
    if (stage->boundary != SCREE_BOUNDARY_AUTO)
        return "the sample is periodic from its preparation on (boundary.periodic) and can have no other boundary";
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
static const char *wrong_boundary(const scree_config *config, const scree_stage_numbers *stage,
                                  scree_boundary_kind kind)
{
    const double *gravity = config->gravity;
    if (!stage->needs_standing && config->wall_count > 0)
        return "in a case with walls only relax can follow: the other stages need plates or a free surface of the "
               "sample";
    if (kind == SCREE_BOUNDARY_WALLS && config->wall_count == 0) return "this case has no walls";
    if (stage->needs_standing && kind != SCREE_BOUNDARY_WALLS && kind != SCREE_BOUNDARY_PLATES)
        return stage->needs_standing;
    if (is_free_of_plates(kind) && (gravity[0] != 0 || gravity[1] != 0 || gravity[2] != 0))
        return "without plates nothing holds the sample against gravity";
    if (stage->needs_free && !is_free_of_plates(kind)) return stage->needs_free;
    if (!stage->needs_free && kind == SCREE_BOUNDARY_AFFINE)
        return "affine needs all components of a velocity gradient: use a deform stage";
    return NULL;
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
        const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
        if (numbers->places) round = scree_config_prepared(stage)->outline != SCREE_SAMPLE_BOX;
        if (numbers->places && !is_periodic(kind)) continue;
        const char *key = "boundary",
                   *wrong = is_periodic(kind) ? wrong_in_cell(stage, &key) : wrong_boundary(config, numbers, kind);
        if (round && !is_periodic(kind) && !is_free_of_plates(kind) && kind != SCREE_BOUNDARY_WALLS)
            wrong = "a round sample has no plates: give boundary: minimal or affine";
        if (!wrong && before != SCREE_BOUNDARY_AUTO) wrong = wrong_order(kind, before);
        if (!wrong && numbers->wrong) wrong = numbers->wrong(config, i, &key);
        if (wrong) refuse(reader, i, key, wrong);
        before = kind;
    }
}
