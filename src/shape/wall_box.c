/// A box with sides along the axes: six planes seen from inside, one solid body seen from outside.
#include "shape/wall_keys.h"

#include <math.h>
#include <string.h>

typedef scree_box_keys config;
static const scree_key keys[] = {
    PLACE(config, lower, .meaning = "Corner with the smallest coordinates."),
    PLACE(config, upper, .meaning = "Corner with the largest coordinates."),
    WALL_SIDE(config),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    *key = "upper";
    for (int k = 0; k < dimension; k++)
        if (!(c->upper[k] > c->lower[k])) return "every coordinate of `upper` must be larger than that of `lower`";
    return NULL;
}

static double face(const void *own, int dimension, const double direction[3])
{
    const config *c = own;
    double face = 0;
    for (int k = 0; k < dimension; k++) {
        double area = fabs(direction[k]);
        for (int i = 0; i < dimension; i++)
            if (i != k) area *= c->upper[i] - c->lower[i];
        face += area;
    }
    return face;
}

static scree_status make(const void *own, int dimension, scree_surface *surface, scree_error *error)
{
    const config *c = own;
    (void)error;
    surface->kind = c->side == SCREE_SIDE_INSIDE ? SCREE_SURFACE_PLANES : SCREE_SURFACE_BOX;
    surface->count = c->side == SCREE_SIDE_INSIDE ? 2 * (size_t)dimension : 1;
    surface->cornered = true;
    memcpy(surface->lower, c->lower, sizeof surface->lower);
    memcpy(surface->upper, c->upper, sizeof surface->upper);
    if (surface->kind == SCREE_SURFACE_BOX && dimension == 2) {
        const double *l = c->lower, *u = c->upper,
                     corner[4][2] = {{l[0], l[1]}, {u[0], l[1]}, {u[0], u[1]}, {l[0], u[1]}};
        scree_surface_outline_set(surface, 4, corner);
    }
    for (int k = 0; k < 2 * dimension; k++) {
        surface->normal[k][k / 2] = k % 2 ? -1 : 1;
        surface->offset[k] = k % 2 ? -c->upper[k / 2] : c->lower[k / 2];
    }
    return SCREE_OK;
}

const scree_module scree_module_box = {
    .name = "box",
    .meaning = "A box with sides along the axes; in 2D a rectangle.",
    .choice_of = CHOICE_OF(IS("walls", .meaning = "with sides along the axes")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .wall = &(const scree_wall_shape){.wrong = wrong, .face = face, .make = make},
};
