/// A convex polygon as a wall in two dimensions: solid, seen from outside.
#include "shape/wall_keys.h"

#include "case/check.h"

#include <math.h>
#include <string.h>

typedef scree_polygon_keys config;
static const scree_key keys[] = {
    KEY(config, corners, SCREE_KEY_PAIRS, .unit = "m", FROM("-1e6 m"), TO("1e6 m"),
        .count_offset = offsetof(config, corner_count), .element_size = sizeof(double[2]), .columns = {"x", "y"},
        .meaning = "Its corners, 3 to 32, counter-clockwise, [[x, y], [x, y], [x, y]] or a .csv file, which may name "
                   "its columns x and y, in any order."),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    (void)own;
    (void)dimension;
    (void)key;
    return NULL;
}

/// Corners that are no convex polygon, with the corner and the reason.
static void find(scree_reader *reader, int64_t index, void *own)
{
    const config *c = own;
    char key[SCREE_PATH_BYTES];
    scree_error why;
    (void)snprintf(key, sizeof key, "walls.%lld.corners", (long long)index);
    if (!c->corners) return; // missing, and noted
    const int count = c->corner_count > SCREE_POLYGON_CORNERS ? SCREE_POLYGON_CORNERS + 1 : (int)c->corner_count;
    if (scree_polygon_check(count, (const double(*)[2])c->corners, &why))
        scree_rule_refuse(reader, key, NULL, "%s", why.message);
}

/// Its length seen along `direction`.
static double face(const void *own, int dimension, const double direction[3])
{
    const config *c = own;
    double least = INFINITY, most = -INFINITY;
    (void)dimension;
    for (int64_t k = 0; k < c->corner_count; k++) {
        const double across = c->corners[k][1] * direction[0] - c->corners[k][0] * direction[1];
        least = fmin(least, across);
        most = fmax(most, across);
    }
    return most > least ? most - least : 0;
}

void scree_surface_outline_set(scree_surface *surface, int count, const double (*corner)[2])
{
    const scree_polygon_measures m = scree_polygon_measure(count, corner);
    surface->corner_count = count;
    surface->bound = m.bound * (1 + 0x1p-50);
    memcpy(surface->middle, m.centroid, sizeof surface->middle);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) surface->corner[k][i] = corner[k][i] - m.centroid[i];
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    (void)dimension;
    (void)error;
    surface->kind = SCREE_SURFACE_OUTLINE;
    surface->count = 1;
    scree_surface_outline_set(surface, (int)c->corner_count, (const double(*)[2])c->corners);
    return SCREE_OK;
}

const scree_module scree_module_wall_polygon = {
    .name = "polygon",
    .meaning = "A solid convex polygon, in two dimensions.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "a solid convex polygon (2D)")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.only_2d = true, .wrong = wrong, .face = face, .find = find, .make = make},
};
