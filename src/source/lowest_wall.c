/// The lowest wall below the sources: planes by their equation, all others by the triangles (in 2D lines) that they are
/// drawn with.
#include "source/lowest_wall.h"

#include "base/vectors.h"
#include "module/source.h"
#include "module/table.h"

#include <math.h>

/// Where the plumb line through `at` meets a plane whose side for grains is the upper one [m]; NAN: nowhere.
static double level_of_plane(const scree_surface *plane, int up, const scree_vector at)
{
    static const scree_vector stays = {0};
    const double *n = plane->normal[0], *shift = plane->shifts ? plane->shift : stays;
    scree_vector beside;
    scree_subtract(at, shift, beside);
    beside[up] = 0;
    return n[up] > 0 ? shift[up] + (plane->offset[0] - scree_dot(n, beside)) / n[up] : NAN;
}

/// Where it meets a line in the plane; NAN: nowhere, or it lies in it.
static double level_of_line(const double corner[9], const scree_vector at)
{
    const double *a = corner, *b = corner + 3;
    if ((a[0] - at[0]) * (b[0] - at[0]) > 0 || a[0] == b[0]) return NAN;
    return a[1] + (at[0] - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

/// Where it meets a triangle: by the shares of the corners, which are areas seen from above.
static double level_of_triangle(const double corner[9], const scree_vector at)
{
    double share[3], whole = 0, level = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = corner + 3 * ((k + 1) % 3), *b = corner + 3 * ((k + 2) % 3);
        share[k] = (a[0] - at[0]) * (b[1] - at[1]) - (a[1] - at[1]) * (b[0] - at[0]);
        whole += share[k];
    }
    for (int k = 0; k < 3; k++) {
        if (!(share[k] / whole >= 0)) return NAN;
        level += share[k] / whole * corner[3 * k + 2];
    }
    return level;
}

/// The wall that the plumb line from `at` meets last; -1: none.
static int lowest_below(const scree_wall_set *set, const scree_wall_triangles *drawn, const scree_vector at)
{
    const int up = set->dimension - 1;
    int wall = -1;
    double lowest = at[up];
    for (int k = 0; k < set->count; k++) {
        const double level = set->surface[k].endless ? level_of_plane(&set->surface[k], up, at) : NAN;
        if (level < lowest) lowest = level, wall = k;
    }
    for (size_t k = 0; k < drawn->count; k++) {
        if (set->surface[drawn->wall[k]].endless) continue;
        const double level = up == 1 ? level_of_line(drawn->corner[k], at) : level_of_triangle(drawn->corner[k], at);
        if (level < lowest) lowest = level, wall = drawn->wall[k];
    }
    return wall;
}

scree_status scree_source_lowest_wall(const scree_model *model, const scree_wall_set *wall_set, int *wall,
                                      scree_error *error)
{
    static const double none[3] = {0};
    scree_wall_triangles drawn = {0};
    *wall = -1;
    if (!wall_set) return SCREE_OK;
    scree_status status = scree_wall_set_triangles(wall_set, none, none, &drawn, error);
    for (int64_t k = 0; k < model->source_count && !status; k++) {
        scree_source_place place;
        scree_modules[model->sources[k].kind]->source->place(model->sources[k].own, &place);
        for (int e = 0; e < place.edges; e++) scree_along(place.origin, 0.5, place.edge[e], place.origin);
        const int here = lowest_below(wall_set, &drawn, place.origin);
        if (k > 0 && here != *wall) {
            *wall = -1;
            break;
        }
        *wall = here;
    }
    scree_wall_triangles_destroy(&drawn);
    return status;
}
