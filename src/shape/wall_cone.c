/// A truncated or pointed cone with any axis, open or closed.
#include "shape/wall_keys.h"

#include <math.h>

typedef scree_round_keys config;
static const scree_key keys[] = {
    WALL_AXIS,
    NUMBER(config, radius_start, "m", FROM("0 m"), TO("1e6 m"), .meaning = "Radius at `start`."),
    NUMBER(config, radius_end, "m", FROM("0 m"), TO("1e6 m"), .meaning = "Radius at `end`."),
    WALL_SIDE(config),
    WALL_ENDS,
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    const char *axis = scree_round_wrong(c, key);
    (void)dimension;
    if (axis) return axis;
    *key = "radius_end";
    return c->radius_start > 0 || c->radius_end > 0 ? NULL : "one of the two radii must be larger than 0";
}

static double face(const void *own, int dimension, const double direction[3])
{
    const config *c = own;
    (void)dimension;
    return scree_round_face(c, fmax(c->radius_start, c->radius_end), direction);
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    (void)dimension;
    (void)error;
    scree_round_make(c, c->radius_start, c->radius_end, surface);
    return SCREE_OK;
}

const scree_module scree_module_cone = {
    .name = "cone",
    .meaning = "A truncated or pointed cone with any axis.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "a truncated or a pointed cone (3D)")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.only_3d = true, .wrong = wrong, .face = face, .make = make},
};
