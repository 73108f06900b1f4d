/// Rules that tie keys of a case together and need no model. What needs numbers of the sample (a step above the
/// critical one, a packing that does not fit) is model_build's.
#include "case/case.h"
#include "case/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MATERIALS = 16 };

/// Place and text of the value at section.key, or of element `index` of a list. Falls back to the section.
static scree_place place_of(const scree_node *section, const char *key, const char **text)
{
    static const scree_place nowhere = {0};
    const scree_node *node = scree_node_find(section, key);
    *text = node ? node->text : NULL;
    if (node) return node->place;
    return section ? section->place : nowhere;
}

static const scree_node *element(const scree_reader *reader, const char *list, int64_t index)
{
    return scree_node_at(scree_node_find(reader->root, list), (size_t)index);
}

/// A material that a wall is said to have under LIST.INDEX.KEY.
static void check_wall_material(scree_reader *reader, const scree_config *config, const char *list, int64_t index,
                                const char *key, const char *wanted)
{
    const char *names[MOST_MATERIALS + 1] = {SCREE_RIGID}, *text;
    char path[SCREE_PATH_BYTES], accepted[256] = SCREE_RIGID;
    size_t count = 1, length = strlen(accepted);
    if (!wanted || strcmp(wanted, SCREE_RIGID) == 0) return;
    for (int64_t i = 0; i < config->material_count; i++) {
        names[count++] = config->materials[i].name;
        if (strcmp(config->materials[i].name, wanted) == 0) return;
        if (length < sizeof accepted)
            length += (size_t)snprintf(accepted + length, sizeof accepted - length, ", %s", config->materials[i].name);
    }
    scree_element_path(path, list, index, key);
    const char *nearest = scree_nearest(wanted, names, count);
    scree_problem_add(reader, place_of(element(reader, list, index), key, &text), path, wanted, accepted,
                      "there is no material '%s'%s%s%s", wanted, nearest ? "; did you mean '" : "",
                      nearest ? nearest : "", nearest ? "'?" : "");
}

static void check_materials(scree_reader *reader, const scree_config *config)
{
    const char *names[MOST_MATERIALS] = {0}, *text;
    char path[SCREE_PATH_BYTES];
    size_t count = 0;
    for (int64_t i = 0; i < config->material_count; i++) {
        const char *name = config->materials[i].name;
        if (!name) return; // wrong, and noted
        for (size_t k = 0; k < count; k++) {
            if (strcmp(names[k], name) != 0) continue;
            (void)snprintf(path, sizeof path, "materials.%lld.name", (long long)i);
            scree_place place = place_of(element(reader, "materials", i), "name", &text);
            scree_problem_add(reader, place, path, name, NULL, "materials.%zu has the name '%s' too", k, name);
        }
        names[count++] = name;
        if (strcmp(name, SCREE_RIGID) != 0) continue;
        (void)snprintf(path, sizeof path, "materials.%lld.name", (long long)i);
        scree_problem_add(reader, place_of(element(reader, "materials", i), "name", &text), path, name, NULL,
                          "no material can be called " SCREE_RIGID ": walls that do not deform are");
    }
    for (int64_t i = 0; i < config->material_count; i++)
        check_wall_material(reader, config, "materials", i, "wall_material", config->materials[i].wall_material);
    for (int64_t i = 0; i < config->wall_count; i++)
        check_wall_material(reader, config, "walls", i, "material", config->walls[i].material);
}

/// Names the stages, and notes names that occur twice.
static void name_stages(scree_reader *reader, scree_config *config)
{
    const scree_node *list = scree_node_find(reader->root, "stages");
    const scree_key *key = scree_section_find(scree_schema(), "stages", strlen("stages"));
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_node *stage = element(reader, "stages", i);
        char name[80], path[SCREE_PATH_BYTES];
        if (!scree_element_name(key, list, stage, name, sizeof name)) continue;
        config->stages[i].name = scree_arena_copy(reader->arena, name, strlen(name));
        if (!config->stages[i].name) {
            scree_reader_fail(reader, sizeof name);
            return;
        }
        for (int64_t k = 0; k < i; k++) {
            if (!config->stages[k].name || strcmp(config->stages[k].name, name) != 0) continue;
            const char *text;
            scree_place place = place_of(stage, "name", &text);
            scree_element_path(path, "stages", i, "name");
            scree_problem_add(reader, place, path, name, NULL, "stages.%lld has the name '%s' too", (long long)k, name);
        }
    }
}

/// Bonds hold a sample together without a pressure: in a periodic cell, between plates with its sides free, or where
/// all sides are driven.
static bool stands_by_bonds(const scree_config *config, int64_t index, bool bonded)
{
    const scree_boundary *boundary = bonded ? scree_config_held_by(config, index) : NULL;
    const scree_config_stage *stage = &config->stages[index];
    const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
    return boundary &&
           (boundary->periodic || boundary->unpressed ||
            (numbers->strains_all && stage->own && numbers->strains_all(stage->own, (int)config->dimension)));
}

static void check_stage_order(scree_reader *reader, const scree_config *config)
{
    bool confined = false, bonded = false;
    const scree_preparation *method = scree_config_preparation(config);
    for (int64_t i = 0; i < config->stage_count; i++)
        if (config->stages[i].kind < 0) return; // wrong, and noted
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_stage_numbers *stage = scree_modules[config->stages[i].kind]->numbers;
        const char *wrong = NULL, *text;
        if (i == 0 && !stage->places)
            wrong = "the first stage must be prepare: it places the particles";
        else if (i > 0 && stage->places)
            wrong = "only the first stage can be prepare";
        else if (i == 1 && method && method->empty && !stage->pours)
            wrong = "there are no particles yet: the stage behind an empty preparation must be pour";
        else if (stage->needs_pressure && !confined && !stands_by_bonds(config, i, bonded))
            wrong = stage->needs_pressure;
        else if (i > 0 && stage->needs_approach && method && !method->approaching)
            wrong = stage->needs_approach;
        else if (i > 0 && !stage->collides && !stage->instant && method && method->binary)
            wrong = "two particles can only collide";
        confined = confined || stage->settles;
        bonded = bonded || stage->bonds;
        if (!wrong) continue;
        char path[SCREE_PATH_BYTES];
        scree_element_path(path, "stages", i, "stage");
        scree_place place = place_of(element(reader, "stages", i), "stage", &text);
        scree_problem_add(reader, place, path, text, NULL, "%s", wrong);
    }
}

/// Notes a choice that exists in the other dimension only; `other` takes its place in this one.
static void refuse_dimension(scree_reader *reader, const scree_config *config, int64_t stage, const char *key,
                             const char *other)
{
    const bool in_3d = config->dimension == 3;
    char path[SCREE_PATH_BYTES];
    const char *text;
    scree_element_path(path, "stages", stage, key);
    scree_place place = place_of(element(reader, "stages", stage), key, &text);
    scree_problem_add(reader, place, path, text, other, "'%s' exists in %s dimensions only; in %s choose '%s'",
                      text ? text : "", in_3d ? "two" : "three", in_3d ? "three" : "two", other);
}

/// Discs in two dimensions, spheres in three; as many components of gravity.
/// Components of gravity, or of the rows of its table.
static void check_gravity(scree_reader *reader, const scree_node *node, const char *path, const scree_schedule *gravity,
                          bool in_3d)
{
    if (!node || node->kind != SCREE_NODE_LIST || !node->first || scree_config_is_open(gravity)) return;
    bool table = node->first->kind == SCREE_NODE_LIST;
    size_t given = table ? node->first->count - 1 : node->count;
    double plane = scree_schedule_largest(&gravity[0]) + scree_schedule_largest(&gravity[1]);
    if (in_3d ? given != 2 || !(plane > 0) : !(scree_schedule_largest(&gravity[2]) > 0)) return;
    scree_problem_add(reader, node->place, path, NULL,
                      in_3d ? (table ? "[time, x, y, z]" : "[x, y, z]") : (table ? "[time, x, y]" : "[x, y]"),
                      in_3d ? "in three dimensions gravity has three components, z upwards"
                            : "in two dimensions gravity has two components, y upwards");
}

static void check_dimension(scree_reader *reader, const scree_config *config)
{
    const bool in_3d = config->dimension == 3;
    const char *text;
    const scree_shape *shape = config->particles.shape >= 0 ? scree_modules[config->particles.shape]->shape : NULL;
    if (shape && shape->dimension != config->dimension) {
        scree_place place = place_of(scree_node_find(reader->root, "particles"), "shape", &text);
        scree_problem_add(reader, place, "particles.shape", text, shape->elsewhere, "%s", shape->only_here);
    }
    check_gravity(reader, scree_node_find(reader->root, "gravity"), "gravity", config->gravity, in_3d);
    for (int64_t i = 0; i < config->stage_count; i++) {
        char path[SCREE_PATH_BYTES];
        scree_element_path(path, "stages", i, "gravity");
        check_gravity(reader, scree_node_find(element(reader, "stages", i), "gravity"), path, config->stages[i].gravity,
                      in_3d);
    }
}

static void check_preparation(scree_reader *reader, const scree_config *config)
{
    const bool in_3d = config->dimension == 3;
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_config_stage *stage = &config->stages[i];
        if (stage->kind < 0 || !scree_modules[stage->kind]->numbers->places) continue;
        const scree_prepare_config *prepare = scree_config_prepared(stage);
        const scree_preparation *method = prepare->method >= 0 ? scree_modules[prepare->method]->preparation : NULL;
        if (method && method->only_dimension && method->only_dimension != config->dimension)
            refuse_dimension(reader, config, i, "method", method->elsewhere);
        if (prepare->outline == (in_3d ? SCREE_SAMPLE_CIRCLE : SCREE_SAMPLE_BALL))
            refuse_dimension(reader, config, i, "outline", in_3d ? "ball" : "circle");
        char path[SCREE_PATH_BYTES];
        const char *text;
        scree_element_path(path, "stages", i, "depth");
        scree_place place = place_of(element(reader, "stages", i), "depth", &text);
        if (prepare->outline != SCREE_SAMPLE_BOX && text && !isnan(prepare->depth))
            scree_problem_add(reader, place, path, text, "auto", "a round sample has no depth of its own");
    }
}

/// A pair is two particles, and gravity would be nobody's to bear.
static void check_pair(scree_reader *reader, const scree_config *config)
{
    const char *text;
    const scree_preparation *method = scree_config_preparation(config);
    bool pair = method && method->binary;
    for (int64_t i = 1; i < config->stage_count; i++)
        pair = pair || (config->stages[i].kind >= 0 && scree_modules[config->stages[i].kind]->numbers->collides);
    if (!pair) return;
    scree_place place = place_of(scree_node_find(reader->root, "particles"), "count", &text);
    if (config->particles.count != 2)
        scree_problem_add(reader, place, "particles.count", text, "2", "a pair is two particles");
    place = place_of(scree_node_find(reader->root, "boundary"), "periodic", &text);
    if (config->boundary.periodic > 0)
        scree_problem_add(reader, place, "boundary.periodic", text, "none", "two particles that collide have no cell");
    place = place_of(reader->root, "gravity", &text);
    if (scree_config_has_gravity(config))
        scree_problem_add(reader, place, "gravity", NULL, "0",
                          "two particles that collide fall freely: leave gravity out");
}

static void check_windows(scree_reader *reader, const scree_config *config)
{
    double largest = 0;
    const char *largest_text = "0 %";
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_config_stage *stage = &config->stages[i];
        if (stage->kind < 0) return; // noted
        double (*strain_of)(const void *config) = scree_modules[stage->kind]->numbers->strain;
        double strain = strain_of ? strain_of(stage->own) : 0;
        if (strain_of && !(strain > 0)) return; // noted
        if (!strain_of || strain <= largest) continue;
        largest = strain;
        (void)place_of(element(reader, "stages", i), "strain", &largest_text);
    }
    const scree_node *list = scree_node_find(scree_node_find(reader->root, "measure"), "windows");
    for (int64_t i = 0; i < config->measure.window_count; i++) {
        const scree_config_window *window = &config->measure.windows[i];
        const scree_node *pair = scree_node_at(list, (size_t)i);
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "measure.windows.%lld", (long long)i);
        if (window->from >= window->to)
            scree_problem_add(reader, pair->place, path, NULL, NULL, "a window must begin before it ends");
        else if (largest == 0 && config->stage_count > 0 && !isnan(window->to))
            scree_problem_add(reader, pair->place, path, NULL, NULL,
                              "no stage loads the sample, so there is no strain");
        else if (largest > 0 && window->to > largest)
            scree_problem_add(reader, pair->place, path, NULL, NULL, "ends at '%s', beyond the largest strain, '%s'",
                              pair->last->text, largest_text);
    }
}

void scree_rules_check(scree_reader *reader, scree_config *config)
{
    check_materials(reader, config);
    scree_rules_check_particles(reader, config);
    name_stages(reader, config);
    check_stage_order(reader, config);
    check_dimension(reader, config);
    check_preparation(reader, config);
    check_pair(reader, config);
    check_windows(reader, config);
    scree_rules_check_boundaries(reader, config);
    scree_rules_check_walls(reader, config);
    scree_rules_check_sources(reader, config);
    scree_rules_check_selections(reader, config);
    scree_rules_check_pair_laws(reader, config);
    scree_rules_check_modules(reader, config);
}
