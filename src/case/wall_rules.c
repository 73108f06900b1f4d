/// Rules of the walls of a case: geometry that makes sense, names, files that are there.
#include "base/checksum.h"
#include "base/memory.h"
#include "base/vectors.h"
#include "case/check.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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
    (void)snprintf(path, sizeof path, "walls.%lld.%s", (long long)index, key);
    scree_problem_add(reader, node ? node->place : wall->place, path, node ? node->text : NULL, accepted, "%s",
                      message);
}

// ---- geometry ----------------------------------------------------------------------------------------------------

/// What is wrong with the shape itself, and under which key; NULL: nothing.
static const char *wrong_shape(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "shape";
    if (dimension == 2 && wall->shape > SCREE_SHAPE_OF_BOX) return "in two dimensions walls are planes and boxes";
    *key = "normal";
    if (wall->shape == SCREE_SHAPE_OF_PLANE && !(scree_length(wall->normal) > 0)) return "a normal needs a length";
    *key = "upper";
    for (int k = 0; k < dimension && wall->shape == SCREE_SHAPE_OF_BOX; k++)
        if (!(wall->upper[k] > wall->lower[k]))
            return "every coordinate of `upper` must be larger than that of `lower`";
    if (wall->shape != SCREE_SHAPE_OF_CYLINDER && wall->shape != SCREE_SHAPE_OF_CONE) return NULL;
    *key = "end";
    const double axis[3] = {wall->end[0] - wall->start[0], wall->end[1] - wall->start[1],
                            wall->end[2] - wall->start[2]};
    if (!(scree_length(axis) > 0)) return "`start` and `end` are the same point: there is no axis";
    *key = "radius_end";
    if (wall->shape == SCREE_SHAPE_OF_CONE && !(wall->radius_start > 0) && !(wall->radius_end > 0))
        return "one of the two radii must be larger than 0";
    return NULL;
}

/// The same for its motion.
static const char *wrong_motion(const scree_config_wall *wall, int dimension, const char **key)
{
    *key = "spin";
    if (wall->shape == SCREE_SHAPE_OF_PLANE && scree_length(wall->spin) > 0)
        return "a plane has no end and cannot turn: use a box or a mesh";
    if (dimension == 3) return NULL;
    if (wall->spin[0] != 0 || wall->spin[1] != 0) return "in two dimensions a wall turns about z only";
    *key = "velocity";
    if (wall->velocity[2] != 0) return "there is no z in two dimensions";
    *key = "normal";
    return wall->shape == SCREE_SHAPE_OF_PLANE && wall->normal[2] != 0 ? "there is no z in two dimensions" : NULL;
}

/// What is wrong with a wall of a sample that repeats itself; NULL: nothing. The wall must look the same from a body
/// and from its ghost.
static const char *wrong_in_cell(const scree_config_wall *wall, int periodic, const char **key)
{
    *key = "shape";
    if (wall->shape != SCREE_SHAPE_OF_PLANE)
        return "only planes go on with a sample that repeats itself (boundary.periodic)";
    *key = "normal";
    for (int k = 0; k < 3; k++)
        if (periodic >> k & 1 && wall->normal[k] != 0)
            return "the plane lies across a direction in which the sample repeats itself (boundary.periodic)";
    return NULL;
}

// ---- names -------------------------------------------------------------------------------------------------------

static void name_walls(scree_reader *reader, scree_config *config)
{
    const scree_node *list = scree_node_find(reader->root, "walls");
    const scree_key *key = scree_section_find(scree_schema(), "walls", strlen("walls"));
    for (int64_t i = 0; i < config->wall_count; i++) {
        char name[80];
        if (!scree_primitive_name(key, list, wall_node(reader, i), name, sizeof name)) continue;
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

// ---- files -------------------------------------------------------------------------------------------------------

/// Where the file of a mesh lies: beside the case file, unless its path is absolute. False: it is not there.
static bool find_file(const scree_reader *reader, const char *file, char path[PATH_MAX])
{
    char whole[2 * PATH_MAX];
    const char *source = reader->root->place.source, *slash = source ? strrchr(source, '/') : NULL;
    int folder = file[0] == '/' || !slash ? 0 : (int)(slash - source) + 1;
    (void)snprintf(whole, sizeof whole, "%.*s%s", folder < PATH_MAX ? folder : 0, folder ? source : "", file);
    return realpath(whole, path) != NULL;
}

static bool find_checksum(const char *path, char text[24])
{
    enum { CHUNK = 1 << 16 };
    char bytes[CHUNK];
    FILE *file = fopen(path, "rbe");
    if (!file) return false;
    uint64_t checksum = 0;
    for (size_t got; (got = fread(bytes, 1, sizeof bytes, file)) > 0;)
        checksum = scree_checksum_bytes(scree_checksum_word(checksum, got), bytes, got);
    bool whole = !ferror(file);
    (void)fclose(file);
    (void)snprintf(text, 24, "x%016" PRIx64, checksum);
    return whole;
}

/// Gives the key of a wall a value, in the tree as in the config.
static void set_text(scree_reader *reader, scree_node *wall, const char *key, const char *text, char **member)
{
    scree_node *node = scree_node_find(wall, key);
    *member = scree_arena_copy(reader->arena, text, strlen(text));
    if (!node && *member && (node = scree_arena_take(reader->arena, sizeof *node))) {
        *node = (scree_node){.key = key, .key_place = wall->place, .place = wall->place};
        scree_node_append(wall, node);
    }
    if (!*member || !node)
        scree_reader_fail(reader, sizeof *node);
    else
        node->text = *member;
}

static void find_mesh(scree_reader *reader, int64_t index, scree_config_wall *wall)
{
    char path[PATH_MAX], checksum[24], message[200];
    if (!wall->file) return; // missing, and noted
    errno = 0;
    if (!find_file(reader, wall->file, path) || !find_checksum(path, checksum)) {
        (void)snprintf(message, sizeof message, "the file cannot be read: %s", strerror(errno));
        refuse(reader, index, "file", NULL, message);
    } else if (wall->checksum && strcmp(wall->checksum, checksum) != 0) {
        (void)snprintf(message, sizeof message, "the file of this mesh has changed: its checksum is %s now", checksum);
        refuse(reader, index, "checksum", checksum, message);
    } else {
        set_text(reader, wall_node(reader, index), "file", path, &wall->file);
        set_text(reader, wall_node(reader, index), "checksum", checksum, &wall->checksum);
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
        const char *key, *wrong = wrong_shape(wall, (int)config->dimension, &key);
        if (!wrong) wrong = wrong_motion(wall, (int)config->dimension, &key);
        if (!wrong && config->boundary.periodic > 0) wrong = wrong_in_cell(wall, config->boundary.periodic, &key);
        if (wrong) refuse(reader, i, key, NULL, wrong);
        if (!wrong && wall->shape == SCREE_SHAPE_OF_MESH) find_mesh(reader, i, wall);
    }
}
