/// Rules of the bodies that a prepare stage lists: as many as the case says, of its dimension, materials and sizes,
/// inside of their box, and not deeper in each other than the guard allows.
#include "prepare/bodies.h"
#include "prepare/given.h"
#include "prepare/given_outline.h"

#include "base/vectors.h"
#include "case/case.h"
#include "case/check.h"

#include <math.h>
#include <string.h>

/// The list under judgement.
typedef struct listed {
    scree_reader *reader;
    const scree_config *config;
    const scree_prepare_config *stage;
    const scree_bodies_config *own;
    const scree_node *nodes; ///< the list in the tree
    bool outlines;           ///< bodies are polygons, and can be drawn
} listed;

/// What is said of a body, and how far it reaches.
typedef struct shown {
    const scree_listed_body *body;
    const scree_node *node;
    int64_t index;
    double radius; ///< m, of equal area; NAN: missing or wrong, and noted
    bool placed;   ///< its position is known
} shown;

/// The radius is not given, or as auto.
static bool has_common_radius(const scree_node *body)
{
    const scree_node *radius = scree_node_find(body, "radius");
    return !radius || (radius->text && strcmp(radius->text, "auto") == 0);
}

static shown show(const listed *l, int64_t index)
{
    const scree_listed_body *body = &l->own->bodies[index];
    const scree_node *node = scree_node_at(l->nodes, (size_t)index);
    bool common = has_common_radius(node) && scree_listed_equal(l->config);
    double radius = common ? scree_listed_radius(l->config, body) : body->radius;
    return (shown){body, node, index, radius, scree_node_find(node, "position") != NULL};
}

/// Notes a problem at a key of body `index`, or at the body when it does not give that key.
static void refuse(const listed *l, int64_t index, const char *key, const char *accepted, const char *message)
{
    const scree_node *body = scree_node_at(l->nodes, (size_t)index), *node = scree_node_find(body, key);
    char path[SCREE_PATH_BYTES];
    scree_element_path(path, "stages.0.bodies", index, key);
    scree_problem_add(l->reader, node ? node->place : body->place, path, node ? node->text : NULL, accepted, "%s",
                      message);
}

/// As many components as space has dimensions; a spin in two dimensions is about z. Zeros may be left out of a motion.
static void check_components(const listed *l, int64_t index, const shown *s)
{
    static const char *const keys[] = {"position", "velocity", "spin"};
    const double *const values[] = {s->body->position, s->body->velocity, s->body->spin};
    const bool in_3d = l->config->dimension == 3;
    for (int k = 0; k < 3; k++) {
        const scree_node *node = scree_node_find(s->node, keys[k]);
        if (!node || node->kind != SCREE_NODE_LIST) continue; // left out, or wrong and noted
        const bool flat_spin = k == 2 && !in_3d, rests = k > 0 && scree_length(values[k]) == 0;
        const size_t wanted = in_3d || k == 2 ? 3 : 2;
        const char *accepted = flat_spin ? "[0, 0, about z]" : in_3d ? "[x, y, z]" : "[x, y]";
        char message[160];
        (void)snprintf(message, sizeof message, "%zu components are given; in %s dimensions a %s has %zu", node->count,
                       in_3d ? "three" : "two", keys[k], wanted);
        if (node->count != wanted && !rests)
            refuse(l, index, keys[k], accepted, message);
        else if (flat_spin && (values[k][0] != 0 || values[k][1] != 0))
            refuse(l, index, keys[k], accepted, "in two dimensions a body turns about z only");
    }
}

static void check_material(const listed *l, int64_t index, const char *name)
{
    enum { MOST_MATERIALS = 16 };
    const char *names[MOST_MATERIALS];
    char accepted[256] = "", message[200];
    size_t count = 0, length = 0;
    if (!name || l->config->material_count == 0) return; // wrong and noted
    for (int64_t k = 0; k < l->config->material_count && k < MOST_MATERIALS; k++) {
        const char *one = l->config->materials[k].name;
        if (!one || strcmp(one, name) == 0) return; // wrong and noted, or found
        if (length < sizeof accepted)
            length += (size_t)snprintf(accepted + length, sizeof accepted - length, "%s%s", k > 0 ? ", " : "", one);
        names[count++] = one;
    }
    const char *nearest = scree_nearest(name, names, count);
    (void)snprintf(message, sizeof message, "there is no material '%s'%s%s%s", scree_show(name).text,
                   nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    refuse(l, index, "material", accepted, message);
}

static void check_radius(const listed *l, int64_t index, const shown *s)
{
    const scree_size_moments sizes = scree_listed_sizes(l->config);
    const bool equal = scree_listed_equal(l->config);
    char message[200];
    if (has_common_radius(s->node) && !equal)
        refuse(l, index, "radius", "a length",
               "the particles of this case have no radius in common: give one, or particles.distribution: equal");
    if (!(s->radius < sizes.least || s->radius > sizes.most)) return;
    (void)snprintf(message, sizeof message,
                   equal ? "%.6g m is not the radius of the particles, %.6g m: set particles.distribution to uniform, "
                           "and radius_min and radius_max around all radii"
                         : "%.6g m is not between particles.radius_min, %.6g m, and radius_max, %.6g m",
                   s->radius, sizes.least, sizes.most);
    refuse(l, index, "radius", NULL, message);
}

/// What a body reaches from its centre towards both walls across direction c [m].
static void find_reach(const listed *l, const shown *s, int c, double reach[2])
{
    reach[0] = reach[1] = s->radius;
    if (!l->outlines || !isfinite(s->radius) || !isfinite(s->body->angle)) return;
    scree_given_outline_reach(l->config, (uint64_t)s->index, s->radius, s->body->angle, c, reach);
}

/// No deeper in a wall of the box than the guard allows; in a periodic cell the centre lies within it.
static void check_inside(const listed *l, int64_t index, const shown *s)
{
    const bool in_3d = l->config->dimension == 3;
    const double side[3] = {l->stage->width, in_3d ? l->stage->depth : l->own->height, l->own->height};
    static const char *const names[2][3] = {{"width", "height", ""}, {"width", "depth", "height"}};
    for (int c = 0; c < l->config->dimension && s->placed && scree_given_has_box(l->config); c++) {
        const bool periodic = l->config->boundary.periodic >> c & 1;
        const double at = s->body->position[c], allowed = s->radius * l->config->guard.overlap;
        const char *what = l->outlines ? "its outline reaches" : "the radius";
        double reach[2];
        char message[200];
        find_reach(l, s, c, reach);
        if (at < (periodic ? 0 : reach[0] - allowed))
            (void)snprintf(message, sizeof message,
                           "outside of the box: %c is %.6g m, %s %.6g m, and the box begins at 0", "xyz"[c], at, what,
                           reach[0]);
        else if (at > side[c] - (periodic ? 0 : reach[1] - allowed))
            (void)snprintf(message, sizeof message,
                           "outside of the box: %c is %.6g m, %s %.6g m, and the %s of the "
                           "box %.6g m",
                           "xyz"[c], at, what, reach[1], names[in_3d][c], side[c]);
        else
            continue;
        refuse(l, index, "position", NULL, message);
        return;
    }
}

/// Way from one centre to the other; along periodic directions of known sides to the nearest ghost.
static void find_way(const listed *l, const shown *one, const shown *other, double way[3])
{
    const double side[3] = {l->stage->width, l->config->dimension == 3 ? l->stage->depth : l->own->height,
                            l->own->height};
    for (int c = 0; c < 3; c++) {
        way[c] = c < l->config->dimension ? other->body->position[c] - one->body->position[c] : 0;
        bool folds = l->config->boundary.periodic >> c & 1 && side[c] > 0;
        if (folds) way[c] -= side[c] * rint(way[c] / side[c]);
    }
}

/// Whether two polygons overlap by more than the guard allows, and what is said of it.
static bool outlines_overlap(const listed *l, const shown *one, const shown *other, const double way[3], char *message,
                             size_t size)
{
    const double far = scree_given_reach(l->config, one->radius) + scree_given_reach(l->config, other->radius);
    if (!(scree_length(way) < far) || !isfinite(one->body->angle + other->body->angle)) return false;
    const scree_given_outline first =
        scree_given_outline_of(l->config, (uint64_t)one->index, one->radius, one->body->angle);
    const scree_given_outline second =
        scree_given_outline_of(l->config, (uint64_t)other->index, other->radius, other->body->angle);
    const scree_given_depth found = scree_given_outline_depth(&first, &second, way);
    const double most = l->config->guard.overlap * fmin(first.bound, second.bound);
    if (!(found.overlap > most)) return false;
    const int length = snprintf(message, size, "bodies %lld and %lld lie %.6g m deep in each other",
                                (long long)one->index, (long long)other->index, found.depth);
    if (isinf(found.overlap))
        (void)snprintf(message + length, size - (size_t)length, ", where no law has a force: move them apart");
    else
        (void)snprintf(message + length, size - (size_t)length,
                       ", which is an overlap of %.6g m to their law; guard.overlap allows %.6g m: move them apart",
                       found.overlap, most);
    return true;
}

static bool round_bodies_overlap(const listed *l, const shown *one, const shown *other, const double way[3],
                                 char *message, size_t size)
{
    const double overlap = one->radius + other->radius - scree_length(way);
    const double most = l->config->guard.overlap * fmin(one->radius, other->radius);
    (void)snprintf(message, size,
                   "bodies %lld and %lld overlap by %.6g m; guard.overlap allows %.6g m: move them apart",
                   (long long)one->index, (long long)other->index, overlap, most);
    return overlap > most;
}

/// Notes the first body before this one that it overlaps by more than the guard allows.
static void check_overlap(const listed *l, int64_t index, const shown *s)
{
    for (int64_t k = 0; k < index && s->placed; k++) {
        const shown other = show(l, k);
        double way[3];
        char message[240];
        find_way(l, &other, s, way);
        if (!other.placed ||
            !(l->outlines ? outlines_overlap : round_bodies_overlap)(l, &other, s, way, message, sizeof message))
            continue;
        refuse(l, index, "position", NULL, message);
        return;
    }
}

void scree_bodies_rules(scree_reader *reader, const scree_config *config)
{
    const scree_config_stage *stage = scree_config_prepare(config);
    if (!stage || scree_config_prepared(stage)->method != SCREE_SLOT_bodies || scree_bodies_of(stage)->body_count == 0)
        return;
    const scree_node *node = scree_node_at(scree_node_find(reader->root, "stages"), 0);
    listed l = {reader, config, scree_config_prepared(stage), scree_bodies_of(stage), scree_node_find(node, "bodies"),
                false};
    if (!scree_given_rules(reader, config, (size_t)l.own->body_count)) return;
    l.outlines = scree_given_has_outlines(config);
    for (int64_t i = 0; i < l.own->body_count; i++) {
        shown s = show(&l, i);
        if (s.node->kind != SCREE_NODE_MAPPING) continue; // noted
        check_components(&l, i, &s);
        check_material(&l, i, s.body->material);
        check_radius(&l, i, &s);
        check_inside(&l, i, &s);
        check_overlap(&l, i, &s);
    }
}
