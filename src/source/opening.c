/// Openings between walls below a source.
///
/// Two solid walls with corners have an opening between them where they are nearest to each other: the places come from
/// all corners and edges, which for convex polygons that do not meet is exact (one of the two places is a corner). That
/// nothing overlaps is seen by an edge of one of them that has all of the other on its outside. Below the narrowest
/// place a disc as wide as the narrowest grain must find room without passing another wall: joints in a plate and gaps
/// in a rough base are no openings. Cost: pairs of walls times their corners.
#include "source/room.h"

#include "base/vectors.h"
#include "shape/core_pair.h"

#include <math.h>

enum { MOST_STEPS = 100000 }; ///< on the way down from an opening

/// Openings of fewer of the largest diameters are warned of: arches span them.
static const double CLOGS = 3;

/// A wall in the plane that can have an opening beside it.
static bool has_corners(const scree_surface *surface)
{
    return surface->stands && surface->corner_count > 0;
}

static void corner_of(const scree_surface *surface, int k, double at[2])
{
    for (int i = 0; i < 2; i++) at[i] = surface->centre[i] + surface->posed[k % surface->corner_count][i];
}

/// From low to high along x (0) or y (1).
static void extent(const scree_surface *surface, int along, double ends[2])
{
    ends[0] = INFINITY, ends[1] = -INFINITY;
    for (int k = 0; k < surface->corner_count; k++) {
        double at[2];
        corner_of(surface, k, at);
        ends[0] = fmin(ends[0], at[along]);
        ends[1] = fmax(ends[1], at[along]);
    }
}

/// Whether an edge of `one` has all of `other` on its outside.
static bool is_beside(const scree_surface *one, const scree_surface *other)
{
    for (int k = 0; k < one->corner_count; k++) {
        double a[2], b[2], c[2];
        bool outside = true;
        corner_of(one, k, a);
        corner_of(one, k + 1, b);
        for (int i = 0; i < other->corner_count && outside; i++) {
            corner_of(other, i, c);
            outside = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0;
        }
        if (outside) return true;
    }
    return false;
}

/// Nearest places of two walls: a corner of `one` and a place on an edge of `other`, when nearer than `nearest` [m].
static void near_corners(const scree_surface *one, const scree_surface *other, double *nearest, double at[2],
                         double there[2])
{
    for (int k = 0; k < one->corner_count; k++)
        for (int e = 0; e < other->corner_count; e++) {
            double c[2], a[2], b[2], foot[2];
            corner_of(one, k, c);
            corner_of(other, e, a);
            corner_of(other, e + 1, b);
            const double away = sqrt(scree_segment_closest(a, b, c, foot));
            if (away >= *nearest) continue;
            *nearest = away;
            for (int i = 0; i < 2; i++) at[i] = c[i], there[i] = foot[i];
        }
}

/// The opening between walls a and b, which is rather level and has nothing in it; false: there is none.
static bool find_between(const scree_wall_set *set, int a, int b, scree_source_opening *o)
{
    const scree_surface *one = &set->surface[a], *other = &set->surface[b];
    double nearest = INFINITY, from[2], to[2];
    if (!is_beside(one, other) && !is_beside(other, one)) return false;
    near_corners(one, other, &nearest, from, to);
    near_corners(other, one, &nearest, to, from);
    if (!(nearest > 0) || fabs(to[0] - from[0]) < fabs(to[1] - from[1])) return false;
    for (int part = 1; part < 4; part++) {
        const scree_vector at = {from[0] + 0.25 * part * (to[0] - from[0]), from[1] + 0.25 * part * (to[1] - from[1])};
        for (int k = 0; k < set->count; k++)
            if (scree_surface_clearance(set, k, at, nearest) < 0) return false;
    }
    const bool left = from[0] < to[0];
    *o = (scree_source_opening){.wall = {left ? a : b, left ? b : a},
                                .width = nearest,
                                .middle = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])}};
    return true;
}

/// Whether a disc finds room below the opening without passing another wall.
static bool leads_down(const scree_wall_set *set, const scree_source_opening *o, double radius)
{
    double one[2], other[2];
    extent(&set->surface[o->wall[0]], 1, one);
    extent(&set->surface[o->wall[1]], 1, other);
    const double lowest = fmin(one[0], other[0]) - 2 * radius;
    for (int step = 0; step < MOST_STEPS; step++) {
        const scree_vector at = {o->middle[0], o->middle[1] - 0.5 * radius * step};
        double least = INFINITY;
        if (at[1] < lowest) return false;
        for (int k = 0; k < set->count; k++) {
            const double clearance = scree_surface_clearance(set, k, at, radius);
            if (clearance < 0 && k != o->wall[0] && k != o->wall[1]) return false;
            least = fmin(least, clearance);
        }
        if (least >= radius) return true;
    }
    return false;
}

/// Whether another wall than these stands below the opening: one that the line straight down from it meets.
static bool stands_below(const scree_wall_set *set, const scree_source_opening *o)
{
    double size = 0, x[2], y[2];
    for (int k = 0; k < set->count; k++) size = fmax(size, set->surface[k].reach + fabs(o->middle[1]));
    for (int k = 0; k < set->count; k++) {
        const scree_surface *surface = &set->surface[k];
        if (k == o->wall[0] || k == o->wall[1]) continue;
        if (surface->corner_count == 0) {
            const scree_vector deep = {o->middle[0], o->middle[1] - 1e3 * size};
            if (scree_surface_is_flat(surface) && scree_surface_clearance(set, k, deep, size) < 0) return true;
            continue;
        }
        extent(surface, 0, x);
        extent(surface, 1, y);
        if (x[0] <= o->middle[0] && x[1] >= o->middle[0] && y[1] < o->middle[1]) return true;
    }
    return false;
}

/// Whether all of the source lies above the opening, and neither to the left nor to the right of its walls.
static bool pours_on(const scree_model *model, const scree_wall_set *set, int64_t index, const scree_source_opening *o)
{
    const scree_config_source *source = &model->sources[index];
    scree_source_place place;
    scree_vector at;
    double left[2], right[2];
    scree_modules[source->kind]->source->place(source->own, &place);
    extent(&set->surface[o->wall[0]], 0, left);
    extent(&set->surface[o->wall[1]], 0, right);
    for (size_t k = 0; scree_source_probe(&place, 1, k, at); k++)
        if (at[1] <= o->middle[1] || at[0] < fmin(left[0], right[0]) || at[0] > fmax(left[1], right[1])) return false;
    return true;
}

bool scree_source_find_opening(const scree_model *model, const scree_wall_set *set, int64_t index, double narrowest,
                               scree_source_opening *opening)
{
    opening->width = 0;
    if (model->dimension != 2 || !set) return false;
    for (int a = 0; a < set->count; a++)
        for (int b = 0; b < a; b++) {
            scree_source_opening o;
            if (!has_corners(&set->surface[a]) || !has_corners(&set->surface[b])) continue;
            if (!find_between(set, a, b, &o) || o.width <= opening->width) continue;
            if (pours_on(model, set, index, &o) && leads_down(set, &o, 0.5 * narrowest)) *opening = o;
        }
    if (opening->width > 0) opening->above = stands_below(set, opening);
    return opening->width > 0;
}

static const char *name_of(const scree_wall_set *set, int wall)
{
    return set->surface[wall].config->name;
}

scree_status scree_source_check_opening(const scree_model *model, const scree_wall_set *set, int64_t index,
                                        scree_error *error)
{
    const double narrowest = scree_source_grains_of(model, &model->sources[index]).narrowest;
    scree_source_opening o;
    if (!scree_source_find_opening(model, set, index, narrowest, &o) || o.width >= narrowest || !o.above)
        return SCREE_OK;
    const int wall = o.wall[0] > o.wall[1] ? o.wall[0] : o.wall[1], other = o.wall[0] + o.wall[1] - wall;
    scree_status status = scree_error_set(
        error, SCREE_ERROR_INPUT,
        "between this wall, '%s', and wall '%s' is an opening of %.4g m below source '%s', and the narrowest particle "
        "is %.4g m wide: none passes; make the opening wider, or take smaller particles",
        name_of(set, wall), name_of(set, other), o.width, model->sources[index].name, narrowest);
    return scree_error_key(error, status, "walls.%d", wall);
}

/// Says that a source pours like a point.
static void warn_of_length(const scree_model *model, int64_t index, scree_log *log)
{
    const scree_config_source *source = &model->sources[index];
    scree_source_place place;
    double length = 0;
    scree_modules[source->kind]->source->place(source->own, &place);
    for (int e = 0; e < place.edges; e++) length = fmax(length, scree_length(place.edge[e]));
    if (place.edges > 0 && length < 2 * model->radius_min)
        scree_log_write(log, SCREE_LOG_WARNING,
                        "source '%s' is %.4g m long, less than its smallest particle, %.4g m: it pours like a point; "
                        "make it longer, or take source: point with a `spread`",
                        source->name, length, 2 * model->radius_min);
}

void scree_source_warn(const scree_model *model, const scree_wall_set *set, scree_log *log)
{
    for (int64_t k = 0; k < model->source_count; k++) {
        const double narrowest = scree_source_grains_of(model, &model->sources[k]).narrowest;
        const double largest = 2 * model->radius_max;
        scree_source_opening o;
        warn_of_length(model, k, log);
        if (!scree_source_find_opening(model, set, k, narrowest, &o) || o.width >= CLOGS * largest) continue;
        scree_log_write(log, SCREE_LOG_WARNING,
                        "the opening of %.4g m between walls '%s' and '%s', below source '%s', %s: the largest "
                        "particles have a diameter of %.4g m; make it %g of them wide or more (%.4g m)",
                        o.width, name_of(set, o.wall[0]), name_of(set, o.wall[1]), model->sources[k].name,
                        o.width < narrowest ? "lets no particle pass" : "may clog", largest, CLOGS, CLOGS * largest);
    }
}
