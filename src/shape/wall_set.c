/// Life of the walls of a case. Their shapes make the surfaces; here they get their extent and what their motion does.
#include "shape/wall_set.h"

#include "base/vectors.h"
#include "case/wall_motion.h"
#include "module/wall_shape.h"

#include <stdio.h>

/// Contacts of one wall with normals closer than this are one, where there is no angle `smooth`: round-off only.
#define SAME_NORMAL (1 - 1e-9)

/// Extent around the centre of rotation.
static double find_reach(const scree_surface *surface)
{
    const scree_config_wall *config = surface->config;
    double reach = 0, apart[3];
    for (int k = 0; surface->cornered && k < 8; k++) {
        for (int i = 0; i < 3; i++) apart[i] = (k >> i & 1 ? surface->upper[i] : surface->lower[i]) - config->centre[i];
        reach = fmax(reach, sqrt(scree_dot(apart, apart)));
    }
    for (int k = 0; k < surface->corner_count; k++)
        reach = fmax(reach, hypot(surface->middle[0] + surface->corner[k][0] - config->centre[0],
                                  surface->middle[1] + surface->corner[k][1] - config->centre[1]));
    for (int k = 0; k < surface->profile_count; k++)
        for (int i = 0; i < 2; i++) {
            scree_along(surface->start, surface->profile[k].s[i], surface->axis, apart);
            scree_subtract(apart, config->centre, apart);
            reach = fmax(reach, sqrt(scree_dot(apart, apart)) + surface->profile[k].r[i]);
        }
    for (size_t v = 0; v < surface->mesh.vertex_count; v++) {
        scree_subtract(surface->mesh.vertex[v], config->centre, apart);
        reach = fmax(reach, sqrt(scree_dot(apart, apart)));
    }
    return reach;
}

/// Whether its motion moves the geometry: a body of revolution that spins about its own axis stays where it is.
static void find_motion(scree_surface *surface)
{
    const scree_config_wall *config = surface->config;
    double offset[3], beside[3];
    const double velocity[3] = {config->velocity[0].value, config->velocity[1].value, config->velocity[2].value};
    surface->steady = scree_wall_is_steady(config);
    surface->stands = scree_wall_stands(config);
    surface->shifts = !surface->steady || scree_dot(velocity, velocity) > 0;
    surface->turns = scree_dot(config->spin, config->spin) > 0;
    if (surface->endless && surface->steady) surface->shifts = scree_dot(velocity, surface->normal[0]) != 0;
    if (surface->profile_count == 0 || !surface->turns) return;
    double spin = sqrt(scree_dot(config->spin, config->spin));
    scree_subtract(config->centre, surface->start, offset);
    scree_cross(surface->axis, offset, offset);
    scree_cross(surface->axis, config->spin, beside);
    bool aligned = scree_dot(beside, beside) <= 1e-24 * spin * spin;
    surface->turns = !(aligned && scree_dot(offset, offset) <= 1e-24 * surface->reach * surface->reach);
}

static scree_status make_surface(int dimension, const scree_config_wall *config, scree_surface *surface,
                                 scree_error *error)
{
    surface->config = config;
    surface->smooth = SAME_NORMAL;
    scree_status status = scree_modules[config->shape]->wall->make(config->own, dimension, surface, error);
    if (status) return status;
    surface->reach = find_reach(surface);
    find_motion(surface);
    return SCREE_OK;
}

scree_status scree_wall_set_create(const scree_config *config, scree_wall_set **wall_set, scree_error *error)
{
    *wall_set = NULL;
    if (config->wall_count == 0) return SCREE_OK;
    scree_status status = scree_allocate(wall_set, 1, sizeof **wall_set, error);
    if (status) return status;
    scree_wall_set *c = *wall_set;
    c->dimension = (int)config->dimension;
    for (int k = 0; k < config->wall_count && !status; k++) {
        scree_surface *surface = &c->surface[c->count++];
        status = make_surface(c->dimension, &config->walls[k], surface, error);
        surface->first = c->primitives;
        c->primitives += surface->count;
        if (!status && c->primitives >= SCREE_PRIMITIVES)
            status = scree_error_set(error, SCREE_ERROR_INPUT, "the walls of a case have at most %u elements",
                                     SCREE_PRIMITIVES);
        status = scree_error_key(error, status, "walls.%d.file", k);
    }
    scree_wall_set_place(c, NULL, 0, 0);
    scree_wall_set_list(c);
    if (status) scree_wall_set_destroy(wall_set);
    return status;
}

void scree_wall_set_destroy(scree_wall_set **wall_set)
{
    for (int k = 0; *wall_set && k < (*wall_set)->count; k++) scree_mesh_destroy(&(*wall_set)->surface[k].mesh);
    scree_release(wall_set);
}
