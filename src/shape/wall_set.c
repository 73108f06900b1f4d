/// Life of the walls of a case: from what the user said to planes, profiles and meshes.
#include "shape/wall_set.h"

#include "base/vectors.h"
#include "shape/stl.h"

#include <stdio.h>
#include <string.h>

/// Contacts of one wall with normals closer than this are one, where there is no angle `smooth`: round-off only.
#define SAME_NORMAL (1 - 1e-9)

static void make_plane(const scree_config_wall *config, scree_surface *surface)
{
    memcpy(surface->normal[0], config->normal, sizeof surface->normal[0]);
    (void)scree_normalise(surface->normal[0]);
    surface->offset[0] = scree_dot(surface->normal[0], config->point);
    surface->count = 1;
}

static void make_box(int dimension, const scree_config_wall *config, scree_surface *surface)
{
    surface->count = config->side == SCREE_SIDE_INSIDE ? 2 * (size_t)dimension : 1;
    for (int k = 0; k < 2 * dimension; k++) {
        surface->normal[k][k / 2] = k % 2 ? -1 : 1;
        surface->offset[k] = k % 2 ? -config->upper[k / 2] : config->lower[k / 2];
    }
}

/// A line from (s0, r0) to (s1, r1); the bodies are on its right for `sign` = 1.
static scree_profile make_line(double s0, double r0, double s1, double r1, double sign)
{
    double length = hypot(s1 - s0, r1 - r0);
    return (scree_profile){
        .s = {s0, s1}, .r = {r0, r1}, .normal = {sign * (r1 - r0) / length, -sign * (s1 - s0) / length}};
}

static void make_round(const scree_config_wall *config, scree_surface *surface)
{
    bool cone = config->shape == SCREE_SHAPE_OF_CONE, inside = config->side == SCREE_SIDE_INSIDE;
    double low = cone ? config->radius_start : config->radius, high = cone ? config->radius_end : config->radius;
    double sign = inside ? 1 : -1;
    scree_subtract(config->end, config->start, surface->axis);
    double length = scree_normalise(surface->axis);
    surface->profile[0] = make_line(0, low, length, high, sign);
    surface->profile_count = 1;
    surface->profile[0].free_ends = config->ends == SCREE_ENDS_OPEN;
    surface->count = 1;
    if (config->ends == SCREE_ENDS_OPEN) return;
    if (low > 0) surface->profile[surface->profile_count++] = make_line(0, 0, 0, low, sign);
    if (high > 0) surface->profile[surface->profile_count++] = make_line(length, high, length, 0, sign);
    if (inside) surface->count = (size_t)surface->profile_count;
}

static scree_status make_mesh(const scree_config_wall *config, scree_surface *surface, scree_error *error)
{
    char *bytes;
    size_t length, count;
    double(*corner)[3] = NULL;
    char reason[sizeof error->message];
    scree_error failure = {0};
    scree_status status = scree_stl_load(config->file, &bytes, &length, &failure);
    if (!status) status = scree_stl_parse(bytes, length, &corner, &count, &failure);
    for (size_t c = 0; !status && c < 3 * count; c++)
        for (int k = 0; k < 3; k++) corner[c][k] = config->at[k] + config->scale * corner[c][k];
    if (!status) status = scree_mesh_build(&surface->mesh, count, (const double(*)[3])corner, &failure);
    scree_release(&bytes);
    scree_release(&corner);
    surface->count = scree_mesh_primitives(&surface->mesh);
    surface->smooth = cos(config->smooth);
    if (!status) return SCREE_OK;
    (void)snprintf(reason, sizeof reason, "%s", failure.message);
    return scree_error_set(error, status, "%s: %s", config->file, reason);
}

/// Extent around the centre of rotation.
static double find_reach(const scree_surface *surface)
{
    const scree_config_wall *config = surface->config;
    double reach = 0, apart[3];
    for (int k = 0; config->shape == SCREE_SHAPE_OF_BOX && k < 8; k++) {
        for (int i = 0; i < 3; i++) apart[i] = (k >> i & 1 ? config->upper[i] : config->lower[i]) - config->centre[i];
        reach = fmax(reach, sqrt(scree_dot(apart, apart)));
    }
    for (int k = 0; k < surface->profile_count; k++)
        for (int i = 0; i < 2; i++) {
            scree_along(config->start, surface->profile[k].s[i], surface->axis, apart);
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
    surface->shifts = scree_dot(config->velocity, config->velocity) > 0;
    surface->turns = scree_dot(config->spin, config->spin) > 0;
    if (config->shape == SCREE_SHAPE_OF_PLANE) surface->shifts = scree_dot(config->velocity, surface->normal[0]) != 0;
    if (surface->profile_count == 0 || !surface->turns) return;
    double spin = sqrt(scree_dot(config->spin, config->spin));
    scree_subtract(config->centre, config->start, offset);
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
    if (config->shape == SCREE_SHAPE_OF_PLANE) make_plane(config, surface);
    if (config->shape == SCREE_SHAPE_OF_BOX) make_box(dimension, config, surface);
    if (config->shape == SCREE_SHAPE_OF_CYLINDER || config->shape == SCREE_SHAPE_OF_CONE) make_round(config, surface);
    if (config->shape == SCREE_SHAPE_OF_MESH) {
        scree_status status = make_mesh(config, surface, error);
        if (status) return status;
    }
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
        if (status && error) (void)snprintf(error->field, sizeof error->field, "walls.%d.file", k);
    }
    scree_wall_set_place(c, 0);
    if (status) scree_wall_set_destroy(wall_set);
    return status;
}

void scree_wall_set_destroy(scree_wall_set **wall_set)
{
    for (int k = 0; *wall_set && k < (*wall_set)->count; k++) scree_mesh_destroy(&(*wall_set)->surface[k].mesh);
    scree_release(wall_set);
}
