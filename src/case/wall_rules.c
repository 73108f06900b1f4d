/// Rules of the walls of a case: what their shapes and motions say, names.
#include "base/vectors.h"
#include "case/check.h"
#include "case/wall_motion.h"
#include "module/wall_shape.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static scree_node *wall_node(const scree_reader *reader, int64_t index)
{
    return scree_node_at(scree_node_find(reader->root, "walls"), (size_t)index);
}

/// Notes a problem at walls.INDEX.KEY.
static void refuse(scree_reader *reader, int64_t index, const char *key, const char *accepted, const char *message)
{
    char path[SCREE_PATH_BYTES];
    const scree_node *wall = wall_node(reader, index), *node = scree_node_find(wall, key);
    scree_element_path(path, "walls", index, key);
    scree_problem_add(reader, node ? node->place : wall->place, path, node ? node->text : NULL, accepted, "%s",
                      message);
}

// ---- geometry ----------------------------------------------------------------------------------------------------

/// What is wrong with the shape itself, and under which key; NULL: nothing.
static const char *wrong_shape(const scree_config_wall *wall, int dimension, const char **key)
{
    const scree_wall_shape *shape = scree_modules[wall->shape]->wall;
    *key = "shape";
    if (dimension == 2 && shape->only_3d) return "there are no walls of this shape in two dimensions";
    if (dimension == 3 && shape->only_2d) return "there are no walls of this shape in space: use a box or a mesh";
    return shape->wrong ? shape->wrong(wall->own, dimension, key) : NULL;
}

/// The same for its motion.
static const char *wrong_motion(const scree_config_wall *wall, int dimension, const char **key)
{
    const char *wrong = scree_wall_motion_wrong(wall, dimension, key);
    if (wrong) return wrong;
    *key = "spin";
    if (scree_modules[wall->shape]->wall->endless && scree_length(wall->spin) > 0)
        return "a wall of this shape has no end and cannot turn: use one that has";
    return dimension == 2 && (wall->spin[0] != 0 || wall->spin[1] != 0) ? "in two dimensions a wall turns about z only"
                                                                        : NULL;
}

/// The same for what a servo presses with.
static const char *wrong_area(scree_config_wall *wall, int dimension, const char **key)
{
    const scree_wall_shape *shape = scree_modules[wall->shape]->wall;
    double direction[3] = {wall->direction[0], wall->direction[1], wall->direction[2]};
    *key = "area";
    if (!scree_wall_motions[wall->motion].servo) return NULL;
    (void)scree_normalise(direction);
    wall->face = shape->face ? shape->face(wall->own, dimension, direction) : 0;
    return isnan(wall->area) && !(wall->face > 0)
               ? "a wall of this shape has no area along `direction` that a servo could press with: give `area`"
               : NULL;
}

/// What is wrong with a wall of a sample that repeats itself; NULL: nothing. The wall must look the same from a body
/// and from its ghost.
static const char *wrong_in_cell(const scree_config_wall *wall, int periodic, const char **key)
{
    const scree_wall_shape *shape = scree_modules[wall->shape]->wall;
    *key = "shape";
    if (!shape->wrong_in_cell) return "only planes go on with a sample that repeats itself (boundary.periodic)";
    return shape->wrong_in_cell(wall->own, periodic, key);
}

// ---- names -------------------------------------------------------------------------------------------------------

static void name_walls(scree_reader *reader, scree_config *config)
{
    const scree_node *list = scree_node_find(reader->root, "walls");
    const scree_key *key = scree_section_find(scree_schema(), "walls", strlen("walls"));
    for (int64_t i = 0; i < config->wall_count; i++) {
        char name[80];
        if (!scree_element_name(key, list, wall_node(reader, i), name, sizeof name)) continue;
        config->walls[i].name = scree_arena_copy(reader->arena, name, strlen(name));
        if (!config->walls[i].name) {
            scree_reader_fail(reader, sizeof name);
            return;
        }
        for (int64_t k = 0; k < i; k++)
            if (config->walls[k].name && strcmp(config->walls[k].name, name) == 0)
                refuse(reader, i, "name", NULL, "another wall has this name too");
    }
}

void scree_rules_check_walls(scree_reader *reader, scree_config *config)
{
    for (int64_t i = 0; i < config->wall_count; i++)
        if (config->walls[i].shape < 0) return; // wrong, and noted
    if (config->wall_count > 0 && scree_config_is_wholly_periodic(config)) {
        refuse(reader, 0, "shape", NULL,
               "a sample that is periodic in all directions has no walls: leave one of `walls` and boundary.periodic "
               "out, or a direction of boundary.periodic");
        return;
    }
    name_walls(reader, config);
    for (int64_t i = 0; i < config->wall_count; i++) {
        scree_config_wall *wall = &config->walls[i];
        if (wall->motion < 0) continue; // wrong, and noted
        const char *key, *wrong = wrong_shape(wall, (int)config->dimension, &key);
        if (!wrong) wrong = wrong_motion(wall, (int)config->dimension, &key);
        if (!wrong) wrong = wrong_area(wall, (int)config->dimension, &key);
        if (!wrong && config->boundary.periodic > 0) wrong = wrong_in_cell(wall, config->boundary.periodic, &key);
        if (wrong) refuse(reader, i, key, NULL, wrong);
        if (!wrong && scree_modules[wall->shape]->wall->find)
            scree_modules[wall->shape]->wall->find(reader, i, wall->own);
    }
}
