/// A round cylinder with any axis, open or closed.
#include "shape/wall_keys.h"

typedef scree_round_keys config;
static const scree_key keys[] = {
    WALL_AXIS,
    {.name = "radius",
     .type = SCREE_KEY_NUMBER,
     .unit = "m",
     .offset = offsetof(config, radius_start),
     ABOVE("0 m"),
     TO("1e6 m"),
     .meaning = "Radius of the cylinder."},
    WALL_SIDE(config),
    WALL_ENDS,
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    (void)dimension;
    return scree_round_wrong(own, key);
}

static double face(const void *own, int dimension, const double direction[3])
{
    const config *c = own;
    (void)dimension;
    return scree_round_face(c, c->radius_start, direction);
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    (void)dimension;
    (void)error;
    scree_round_make(c, c->radius_start, c->radius_start, surface);
    return SCREE_OK;
}

const scree_module scree_module_cylinder = {
    .name = "cylinder",
    .meaning = "A cylinder with any axis.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "round, with any axis (3D)")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.only_3d = true, .wrong = wrong, .face = face, .make = make},
};
