/// A half-space as a wall.
#include "shape/wall_keys.h"

#include "base/vectors.h"

#include <string.h>

typedef scree_plane_keys config;
static const scree_key keys[] = {
    PLACE(config, point, .meaning = "A point of the plane."),
    KEY(config, normal, SCREE_KEY_VECTOR, .unit = "1", FROM("-1e6"), TO("1e6"),
        .meaning = "Normal, towards the particles; any length."),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    *key = "normal";
    if (!(scree_length(c->normal) > 0)) return "a normal needs a length";
    return dimension == 2 && c->normal[2] != 0 ? "there is no z in two dimensions" : NULL;
}

static const char *wrong_in_cell(const void *own, int periodic, const char **key)
{
    const config *c = own;
    *key = "normal";
    for (int k = 0; k < 3; k++)
        if (periodic >> k & 1 && c->normal[k] != 0)
            return "the plane lies across a direction in which the sample repeats itself (boundary.periodic)";
    return NULL;
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    (void)dimension;
    (void)error;
    surface->kind = SCREE_SURFACE_PLANES;
    surface->endless = true;
    memcpy(surface->normal[0], c->normal, sizeof surface->normal[0]);
    (void)scree_normalise(surface->normal[0]);
    surface->offset[0] = scree_dot(surface->normal[0], c->point);
    surface->count = 1;
    return SCREE_OK;
}

const scree_module scree_module_plane = {
    .name = "plane",
    .meaning = "A half-space; in 2D a half-plane.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "a half-space")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.endless = true, .wrong = wrong, .wrong_in_cell = wrong_in_cell, .make = make},
};
