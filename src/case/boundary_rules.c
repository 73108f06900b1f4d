/// Rules of the boundaries: which stage can have which, what can follow what.
#include "case/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Notes a problem at stages.INDEX.KEY.
static void refuse(scree_reader *reader, int64_t index, const char *key, const char *message)
{
    char path[SCREE_PATH_BYTES];
    const scree_node *stage = scree_node_at(scree_node_find(reader->root, "stages"), (size_t)index);
    const scree_node *node = scree_node_find(stage, key);
    scree_element_path(path, "stages", index, key);
    scree_problem_add(reader, node ? node->place : stage->place, path, node ? node->text : NULL, NULL, "%s", message);
}

static bool fills_cells(const scree_module *method)
{
    return method->preparation->periodic;
}

static bool goes_without_plates(const scree_module *stage)
{
    return stage->numbers->needs_standing != NULL;
}

static bool imposes_gradients(const scree_module *boundary)
{
    return boundary->boundary->free;
}

static bool imposes_gradients_on_round(const scree_module *boundary)
{
    return boundary->boundary->free && boundary->boundary->round;
}

/// A message with the choices that would do.
static const char *with_choices(scree_reader *reader, const char *why, const char *key,
                                bool (*suits)(const scree_module *module), const char *behind)
{
    static _Thread_local char text[400];
    const char *choices = scree_rule_choices(reader, key, " or ", suits);
    (void)snprintf(text, sizeof text, "%s%s%s", why, choices ? choices : "another", behind);
    return text;
}

/// What is wrong with the preparation of a periodic sample, and under which key; NULL: nothing.
static const char *wrong_preparation(scree_reader *reader, const scree_prepare_config *stage, const char **key)
{
    *key = "method";
    if (stage->method >= 0 && !scree_modules[stage->method]->preparation->periodic)
        return scree_modules[stage->method]->preparation->needs_walls
                   ? with_choices(reader,
                                  "this method needs walls on all sides and cannot fill a sample that repeats itself "
                                  "(boundary.periodic): prepare with ",
                                  "stages.prepare.method", fills_cells, ", and confine")
                   : NULL; // of a pair more is said
    *key = "outline";
    return stage->outline != SCREE_SAMPLE_BOX ? "a round sample cannot repeat itself" : NULL;
}

/// What is wrong with a stage of a sample that repeats itself, and under which key; NULL: nothing.
static const char *wrong_in_cell(const scree_config *config, const scree_config_stage *stage,
                                 const scree_stage_numbers *numbers, const scree_boundary *boundary, const char **key)
{
    if (boundary->periodic && stage->boundary != SCREE_CHOICE_AUTO)
        return "the sample is periodic in all directions (boundary.periodic) and can have no boundary";
    if (boundary->needs_ends) return boundary->needs_ends;
    *key = "stage";
    if (scree_config_axis_repeats(config) && (numbers->settles || numbers->rate)) return boundary->needs_axis;
    *key = "boundary";
    return NULL;
}

static void check_periodic(scree_reader *reader, const scree_config *config)
{
    const scree_config_boundary *boundary = &config->boundary;
    const scree_node *section = scree_node_find(reader->root, "boundary"), *node = scree_node_find(section, "periodic");
    const char *wrong = NULL;
    if (boundary->periodic > (1 << config->dimension) - 1)
        wrong = "there is no z in two dimensions";
    else if (scree_config_is_wholly_periodic(config) && scree_config_has_gravity(config))
        wrong = "gravity has nothing to fall on: without a floor the sample would fall for ever";
    if (wrong && node) scree_problem_add(reader, node->place, "boundary.periodic", node->text, NULL, "%s", wrong);
}

/// What is wrong with `boundary` after `before`; NULL: nothing.
static const char *wrong_order(const scree_boundary *boundary, const scree_boundary *before)
{
    if (!before || boundary == before) return NULL;
    if (before->kept && !(before->free && boundary->free)) return before->kept;
    return boundary->returned;
}

/// What is wrong with a stage that closes the sample in a case with walls.
static const char *wrong_among_walls(scree_reader *reader, const scree_config *config, const scree_config_stage *stage)
{
    static _Thread_local char why[200];
    const bool said = config->source_count > 0 && stage->boundary >= 0;
    (void)snprintf(why, sizeof why, "%s%s%s", said ? "`sources` and boundary: " : "",
                   said ? scree_modules[stage->boundary]->name : "",
                   said
                       ? " do not go together: in a case with walls this stage has no free surface of the sample: only "
                       : "in a case with walls this stage has no plates and no free surface of the sample: only ");
    return with_choices(reader, why, "stages", goes_without_plates, " can follow");
}

/// What is wrong with `boundary` in a stage; NULL: nothing.
static const char *wrong_boundary(scree_reader *reader, const scree_config *config, const scree_config_stage *said,
                                  const scree_boundary *boundary)
{
    const scree_stage_numbers *stage = scree_modules[said->kind]->numbers;
    const bool falls = scree_config_has_gravity(config) && !stage->still, free = stage->still || stage->collides;
    if (!stage->needs_standing && !stage->still && config->wall_count > 0)
        return wrong_among_walls(reader, config, said);
    if (boundary->needs_walls && config->wall_count == 0) return boundary->needs_walls;
    if (stage->needs_standing && !boundary->stands && !boundary->open) return stage->needs_standing;
    if (!stage->needs_standing && !free && boundary->open)
        return with_choices(reader, "nothing stands around the sample that could press it: only ", "stages",
                            goes_without_plates, " can follow");
    if ((boundary->free || (boundary->open && config->wall_count == 0 && !stage->collides)) && falls)
        return "without plates nothing holds the sample against gravity";
    // Of a sample that repeats itself the stage itself says more.
    if (stage->needs_free && !boundary->free)
        return config->boundary.periodic > 0
                   ? NULL
                   : with_choices(reader, stage->needs_free, "stages.boundary", imposes_gradients, "");
    return stage->needs_free ? NULL : boundary->needs_gradient;
}

/// What is wrong with stage `index`, which moves, and under which key; NULL: nothing.
static const char *wrong_stage(scree_reader *reader, const scree_config *config, int64_t index,
                               const scree_boundary *boundary, const char **key)
{
    const scree_config_stage *stage = &config->stages[index];
    const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
    const char *wrong = NULL;
    if (config->boundary.periodic > 0) wrong = wrong_in_cell(config, stage, numbers, boundary, key);
    // Of what sources do not go with their stage says more.
    if (!wrong && numbers->pours && numbers->wrong) wrong = numbers->wrong(config, index, key);
    if (!wrong && !boundary->periodic) wrong = wrong_boundary(reader, config, stage, boundary);
    return wrong;
}

/// The first stage that moves, where all of them stand among the walls of the case; -1: not all do.
static int64_t first_among_walls(const scree_config *config)
{
    int64_t first = -1;
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_stage_numbers *numbers = scree_modules[config->stages[i].kind]->numbers;
        const scree_boundary *boundary = scree_config_held_by(config, i);
        if (numbers->places || numbers->instant) continue;
        if (!boundary || !boundary->needs_walls) return -1;
        if (first < 0) first = i;
    }
    return config->wall_count > 0 ? first : -1;
}

/// Whether something looks at the gaps between outlines where no outer boundary of the sample is kept.
static bool asks_for_gaps(const scree_reader *reader, const scree_config *config)
{
    const scree_node *strain = scree_node_find(scree_node_find(reader->root, "measure"), "mean_strain");
    return config->measure.cells || config->selection_count > 0 ||
           (strain && strain->text && strcmp(strain->text, "no") != 0);
}

/// Notes keys of `boundary` with another value than that which they have by themselves, where nothing stands but the
/// walls of the case: they are about plates, membranes and the outer boundary of a sample. What a written case says of
/// them are the values of before.
static void check_among_walls(scree_reader *reader, scree_config *config)
{
    const int64_t first = first_among_walls(config);
    const scree_node *section = scree_node_find(reader->root, "boundary");
    const scree_section *keys = scree_section_find(scree_schema(), "boundary", strlen("boundary"))->sections;
    if (first < 0 || !section) return;
    for (const scree_node *node = section->first; node; node = node->next) {
        const scree_key *key = scree_section_find(keys, node->key, strlen(node->key));
        const bool gap = strncmp(node->key, "gap_", 4) == 0, lateral = strcmp(node->key, "lateral") == 0;
        if (!key || !node->text || strcmp(node->key, "periodic") == 0 || (gap && asks_for_gaps(reader, config)) ||
            (key->standard && strcmp(node->text, key->standard) == 0))
            continue;
        char path[SCREE_PATH_BYTES];
        const char *stage_key = "boundary", *wrong = NULL;
        scree_config_stage *stage = &config->stages[first];
        const int said = stage->boundary;
        scree_key_join(path, "boundary", node->key);
        // What the stage would be told, if it had this boundary.
        stage->boundary = config->boundary.lateral;
        if (lateral) wrong = wrong_stage(reader, config, first, scree_modules[stage->boundary]->boundary, &stage_key);
        stage->boundary = said;
        scree_problem_add(reader, node->key_place, path, node->text, NULL, "%s",
                          wrong ? wrong : "not used: all stages stand beside the `walls` of the case");
    }
}

void scree_rules_check_boundaries(scree_reader *reader, scree_config *config)
{
    const scree_boundary *before = NULL;
    for (int64_t i = 0; i < config->stage_count; i++)
        if (config->stages[i].kind < 0 || config->stages[i].boundary == SCREE_CHOICE_WRONG) return; // noted
    if (config->boundary.lateral < 0 || config->boundary.periodic < 0) return;
    check_periodic(reader, config);
    if (config->dimension > 0) check_among_walls(reader, config);
    bool round = false;
    for (int64_t i = 0; i < config->stage_count; i++) {
        scree_config_stage *stage = &config->stages[i];
        const scree_boundary *boundary = scree_config_held_by(config, i);
        if (config->dimension == 0) return; // could not be read, and that has been noted
        if (!boundary) continue;            // that of a stage before, which is wrong, and noted
        const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
        const char *key = "boundary", *wrong = NULL;
        if (numbers->places) {
            round = scree_config_prepared(stage)->outline != SCREE_SAMPLE_BOX;
            if (config->boundary.periodic > 0) wrong = wrong_preparation(reader, scree_config_prepared(stage), &key);
            if (wrong) refuse(reader, i, key, wrong);
            continue;
        }
        if (numbers->instant) {
            if (numbers->wrong) wrong = numbers->wrong(config, i, &key);
            if (wrong) refuse(reader, i, key, wrong);
            continue;
        }
        wrong = wrong_stage(reader, config, i, boundary, &key);
        if (round && !boundary->periodic && !boundary->round)
            wrong = with_choices(reader, "a round sample has no plates: give boundary: ", "stages.boundary",
                                 imposes_gradients_on_round, "");
        if (!wrong) wrong = wrong_order(boundary, before);
        if (!wrong && numbers->wrong) wrong = numbers->wrong(config, i, &key);
        if (wrong) refuse(reader, i, key, wrong);
        // Where sources pour, stages that take it over and what goes with it have nothing else to say.
        if (wrong && config->source_count > 0 && strcmp(key, "boundary") == 0 && stage->boundary != SCREE_CHOICE_AUTO)
            stage->boundary = SCREE_CHOICE_WRONG;
        else
            before = boundary;
    }
}
