/// Walls as triangles, for scenes and ParaView.
#include "shape/wall_set.h"

#include "base/vectors.h"

#include <string.h>

enum { FACETS = 96, MOST_FLAT = SCREE_POLYGON_CORNERS };

/// Adds a triangle given in the frame of the wall.
static void add(scree_wall_triangles *triangles, const scree_surface *surface, int wall, const double *const corner[3])
{
    double *to = triangles->corner[triangles->count];
    triangles->wall[triangles->count++] = wall;
    for (int c = 0; c < 3; c++) {
        double lever[3];
        scree_subtract(corner[c], surface->config->centre, lever);
        for (int i = 0; i < 3; i++)
            to[3 * c + i] = surface->hub[i] + (surface->turns ? scree_dot(&surface->rotation[3 * i], lever) : lever[i]);
        // A wall that moves in itself stays where it is in the picture.
        for (int i = 0; i < 3 && !surface->shifts; i++) to[3 * c + i] -= surface->shift[i];
    }
}

static void add_square(scree_wall_triangles *triangles, const scree_surface *surface, int wall,
                       const double corner[4][3])
{
    add(triangles, surface, wall, (const double *const[3]){corner[0], corner[1], corner[2]});
    add(triangles, surface, wall, (const double *const[3]){corner[0], corner[2], corner[3]});
}

/// Half of how far the part of a plane that is shown reaches in a direction: as far as the bodies, and a little
/// further.
static double half_width(const double size[3], const double direction[3])
{
    const double beyond = 0.1 * sqrt(scree_dot(size, size));
    return 0.5 * (fabs(direction[0]) * size[0] + fabs(direction[1]) * size[1] + fabs(direction[2]) * size[2]) + beyond;
}

/// A plane: a rectangle beside the bodies; in 2D a line.
static void add_plane(scree_wall_triangles *triangles, const scree_surface *surface, int wall, int dimension,
                      const double low[3], const double high[3])
{
    const double *n = surface->normal[0];
    double middle[3], foot[3], size[3], along_plane[3] = {-n[1], n[0], 0}, across[3], corner[4][3];
    scree_subtract(high, low, size);
    scree_along(low, 0.5, size, middle);
    scree_along(middle, surface->offset[0] - scree_dot(n, middle), n, foot);
    if (!(scree_normalise(along_plane) > 0)) along_plane[0] = 1;
    scree_cross(n, along_plane, across);
    const double half = half_width(size, along_plane), other = half_width(size, across);
    for (int c = 0; c < 4; c++) {
        scree_along(foot, c == 1 || c == 2 ? half : -half, along_plane, corner[c]);
        scree_along(corner[c], c >= 2 ? other : -other, across, corner[c]);
    }
    if (dimension == 3) {
        add_square(triangles, surface, wall, (const double(*)[3])corner);
        return;
    }
    for (int c = 0; c < 2; c++) scree_along(foot, c ? half : -half, along_plane, corner[c]);
    add(triangles, surface, wall, (const double *const[3]){corner[0], corner[1], corner[1]});
}

static void add_box(scree_wall_triangles *triangles, const scree_surface *surface, int wall, int dimension)
{
    const double *end[2] = {surface->lower, surface->upper};
    for (int side = 0; side < 2 * dimension; side++) {
        int axis = side / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
        double corner[4][3];
        if (dimension == 2) {
            a = 1 - axis;
            b = 2;
        }
        for (int c = 0; c < 4; c++) {
            corner[c][axis] = end[side % 2][axis];
            corner[c][a] = end[c == 1 || c == 2][a];
            corner[c][b] = dimension == 2 ? 0 : end[c >= 2][b];
        }
        if (dimension == 3)
            add_square(triangles, surface, wall, (const double(*)[3])corner);
        else
            add(triangles, surface, wall, (const double *const[3]){corner[0], corner[1], corner[1]});
    }
}

static void add_outline(scree_wall_triangles *triangles, const scree_surface *surface, int wall)
{
    const double *m = surface->middle;
    for (int k = 0; k < surface->corner_count; k++) {
        const double *a = surface->corner[k], *b = surface->corner[k + 1 < surface->corner_count ? k + 1 : 0];
        const double from[3] = {m[0] + a[0], m[1] + a[1], 0}, to[3] = {m[0] + b[0], m[1] + b[1], 0};
        add(triangles, surface, wall, (const double *const[3]){from, to, to});
    }
}

static void add_round(scree_wall_triangles *triangles, const scree_surface *surface, int wall)
{
    const double *axis = surface->axis;
    double side[2][3] = {{axis[1], -axis[0], 0}, {0}};
    if (!(scree_normalise(side[0]) > 0)) side[0][0] = 1;
    scree_cross(axis, side[0], side[1]);
    for (int k = 0; k < surface->profile_count; k++)
        for (int f = 0; f < FACETS; f++) {
            const scree_profile *line = &surface->profile[k];
            double corner[4][3];
            for (int c = 0; c < 4; c++) {
                int end = c == 1 || c == 2;
                double angle = 2 * M_PI * (f + (c >= 2)) / FACETS;
                scree_along(surface->start, line->s[end], axis, corner[c]);
                scree_along(corner[c], line->r[end] * cos(angle), side[0], corner[c]);
                scree_along(corner[c], line->r[end] * sin(angle), side[1], corner[c]);
            }
            add_square(triangles, surface, wall, (const double(*)[3])corner);
        }
}

static void add_mesh(scree_wall_triangles *triangles, const scree_surface *surface, int wall)
{
    const scree_mesh *mesh = &surface->mesh;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *corner = mesh->triangle[t];
        add(triangles, surface, wall,
            (const double *const[3]){mesh->vertex[corner[0]], mesh->vertex[corner[1]], mesh->vertex[corner[2]]});
    }
}

scree_status scree_wall_set_triangles(const scree_wall_set *wall_set, const double low[3], const double high[3],
                                      scree_wall_triangles *triangles, scree_error *error)
{
    size_t room = 0;
    *triangles = (scree_wall_triangles){0};
    for (int k = 0; wall_set && k < wall_set->count; k++)
        room += wall_set->surface[k].mesh.triangle_count + (size_t)wall_set->surface[k].profile_count * 2 * FACETS +
                MOST_FLAT;
    scree_status status = scree_allocate(&triangles->corner, room, sizeof *triangles->corner, error);
    if (!status) status = scree_allocate(&triangles->wall, room, sizeof *triangles->wall, error);
    for (int k = 0; !status && wall_set && k < wall_set->count; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        if (surface->endless) add_plane(triangles, surface, k, wall_set->dimension, low, high);
        if (surface->cornered) add_box(triangles, surface, k, wall_set->dimension);
        if (surface->kind == SCREE_SURFACE_OUTLINE) add_outline(triangles, surface, k);
        add_mesh(triangles, surface, k);
        add_round(triangles, surface, k);
    }
    if (status) scree_wall_triangles_destroy(triangles);
    return status;
}

void scree_wall_triangles_destroy(scree_wall_triangles *triangles)
{
    scree_release(&triangles->corner);
    scree_release(&triangles->wall);
    triangles->count = 0;
}
