/// Closest points of the walls of a case, and their motion.
#include "shape/wall_set.h"

#include "base/vectors.h"
#include "case/wall_motion.h"

#include <string.h>

// ---- motion ------------------------------------------------------------------------------------------------------

/// The outline as it lies; one that does not turn keeps its bits.
static void pose_outline(scree_surface *surface)
{
    const double *r = surface->rotation, *about = surface->config->centre;
    const double from[2] = {surface->middle[0] - about[0], surface->middle[1] - about[1]};
    for (int i = 0; i < 2; i++)
        surface->centre[i] = surface->turns ? surface->hub[i] + r[3 * i] * from[0] + r[3 * i + 1] * from[1]
                                            : surface->middle[i] + surface->shift[i];
    if (surface->turns)
        scree_polygon_turn(surface->corner_count, (const double(*)[2])surface->corner, r[0], r[3], surface->posed);
    else
        memcpy(surface->posed, surface->corner, sizeof surface->posed);
}

void scree_wall_set_place(scree_wall_set *wall_set, const scree_case_wall_set *walls, double time, double step)
{
    wall_set->time = time;
    for (int k = 0; k < wall_set->count; k++) {
        scree_surface *surface = &wall_set->surface[k];
        const scree_config_wall *config = surface->config;
        double axis[3] = {config->spin[0], config->spin[1], config->spin[2]};
        double angle = scree_normalise(axis) * time, sine = sin(angle), rest = 1 - cos(angle);
        const double generator[9] = {0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0};
        for (int i = 0; i < 9; i++) {
            double square = axis[i / 3] * axis[i % 3] - (i % 4 == 0 ? scree_dot(axis, axis) : 0);
            surface->rotation[i] = (i % 4 == 0 ? 1 : 0) + sine * generator[i] + rest * square;
        }
        scree_wall_shift(config, walls ? walls->load[k].travel : 0, time, surface->shift);
        scree_wall_velocity(config, walls ? walls->load[k].speed : 0, time, step, surface->velocity);
        scree_along(config->centre, 1, surface->shift, surface->hub);
        if (surface->corner_count > 0) pose_outline(surface);
    }
}

void scree_wall_set_list(scree_wall_set *wall_set)
{
    for (int k = 0; k < wall_set->count; k++)
        memcpy(wall_set->surface[k].listed, wall_set->surface[k].shift, sizeof wall_set->surface[k].listed);
}

double scree_wall_set_way(const scree_wall_set *wall_set, double time, double margin)
{
    double longest = 0;
    for (int k = 0; k < wall_set->count; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        const double *v = surface->velocity, *w = surface->config->spin;
        double speed = surface->shifts && surface->steady ? sqrt(scree_dot(v, v)) : 0, gone[3] = {0};
        if (surface->turns) speed += sqrt(scree_dot(w, w)) * (surface->reach + margin);
        if (!surface->steady) scree_subtract(surface->shift, surface->listed, gone);
        longest = fmax(longest, speed * fabs(time) + sqrt(scree_dot(gone, gone)));
    }
    return longest;
}

double scree_wall_set_speed(const scree_wall_set *wall_set)
{
    double largest = 0;
    for (int k = 0; k < wall_set->count; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        const double *v = surface->velocity, *w = surface->config->spin;
        largest = fmax(largest, sqrt(scree_dot(v, v)) + sqrt(scree_dot(w, w)) * surface->reach);
    }
    return largest;
}

/// From where a body is to where it is in the frame of the wall at time zero.
static void enter_frame(const scree_surface *surface, const double place[3], double inner[3])
{
    memcpy(inner, place, 3 * sizeof *inner);
    if (surface->shifts) scree_subtract(inner, surface->shift, inner);
    if (!surface->turns) return;
    double lever[3];
    scree_subtract(inner, surface->config->centre, lever);
    const double *r = surface->rotation;
    for (int i = 0; i < 3; i++)
        inner[i] = surface->config->centre[i] + r[i] * lever[0] + r[3 + i] * lever[1] + r[6 + i] * lever[2];
}

static void leave_frame(const scree_surface *surface, double direction[3])
{
    if (!surface->turns) return;
    const double old[3] = {direction[0], direction[1], direction[2]};
    for (int i = 0; i < 3; i++) direction[i] = scree_dot(&surface->rotation[3 * i], old);
}

// ---- shapes ------------------------------------------------------------------------------------------------------

static void closest_on_plane(const scree_surface *surface, size_t k, const double place[3],
                             scree_closest_point *closest)
{
    memcpy(closest->normal, surface->normal[k], sizeof closest->normal);
    closest->distance = scree_dot(surface->normal[k], place) - surface->offset[k];
    closest->minimum = true;
}

/// A solid box: its nearest face, edge or corner; inside it the nearest face.
static void closest_on_solid_box(int dimension, const scree_surface *box, const double place[3],
                                 scree_closest_point *closest)
{
    double nearest = -INFINITY;
    int face = 0;
    *closest = (scree_closest_point){.minimum = true};
    for (int i = 0; i < dimension; i++) {
        double below = box->lower[i] - place[i], above = place[i] - box->upper[i], out = fmax(below, above);
        closest->normal[i] = out > 0 ? (below > above ? -out : out) : 0;
        if (out > nearest) {
            nearest = out;
            face = below > above ? 2 * i : 2 * i + 1;
        }
    }
    closest->distance = scree_normalise(closest->normal);
    if (nearest > 0) return;
    closest->distance = nearest;
    closest->normal[face / 2] = face % 2 ? 1 : -1;
}

/// A solid polygon: its nearest edge or corner; inside it the nearest edge.
static void closest_on_outline(const scree_surface *surface, const double place[3], scree_closest_point *closest)
{
    const double p[2] = {place[0] - surface->middle[0], place[1] - surface->middle[1]};
    double nearest = INFINITY, deepest = -INFINITY, out[2] = {0}, in[2] = {0};
    for (int k = 0; k < surface->corner_count; k++) {
        const double *a = surface->corner[k], *b = surface->corner[k + 1 < surface->corner_count ? k + 1 : 0];
        const double along[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(along[0], along[1]);
        const double normal[2] = {along[1] / length, -along[0] / length}, from[2] = {p[0] - a[0], p[1] - a[1]};
        const double height = from[0] * normal[0] + from[1] * normal[1];
        const double share = (from[0] * along[0] + from[1] * along[1]) / (length * length);
        const double end = fmin(fmax(share, 0), 1);
        const double apart[2] = {from[0] - end * along[0], from[1] - end * along[1]};
        const bool foot = share >= 0 && share <= 1;
        const double distance = foot ? fabs(height) : hypot(apart[0], apart[1]);
        if (distance < nearest) {
            nearest = distance;
            for (int i = 0; i < 2; i++) out[i] = foot || !(distance > 0) ? normal[i] : apart[i] / distance;
        }
        if (height > deepest) {
            deepest = height;
            memcpy(in, normal, sizeof in);
        }
    }
    const bool outside = deepest > 0;
    *closest = (scree_closest_point){.distance = outside ? nearest : deepest, .minimum = true};
    memcpy(closest->normal, outside ? out : in, sizeof out);
}

/// A point (s, r) against a line of the half-plane. *inner: its foot lies on the line. The normal of the line is taken
/// there, at an end the direction from it.
static double profile_distance(const scree_profile *line, double s, double r, double normal[2], bool *inner)
{
    double ds = line->s[1] - line->s[0], dr = line->r[1] - line->r[0];
    double t = ((s - line->s[0]) * ds + (r - line->r[0]) * dr) / (ds * ds + dr * dr);
    *inner = t >= 0 && t <= 1;
    memcpy(normal, line->normal, 2 * sizeof *normal);
    if (*inner) return (s - line->s[0]) * normal[0] + (r - line->r[0]) * normal[1];
    int end = t > 1;
    double from[2] = {s - line->s[end], r - line->r[end]}, distance = hypot(from[0], from[1]);
    for (int i = 0; i < 2 && distance > 0; i++) normal[i] = from[i] / distance;
    return distance;
}

/// A solid of revolution seen from outside: its nearest line; inside it the nearest by depth.
static double solid_profile(const scree_surface *surface, double s, double r, double normal[2])
{
    double nearest = INFINITY, deepest = -INFINITY, found[2][2] = {{0}};
    bool outside = false;
    for (int k = 0; k < surface->profile_count; k++) {
        const scree_profile *line = &surface->profile[k];
        double direction[2], distance;
        bool inner;
        double height = (s - line->s[0]) * line->normal[0] + (r - line->r[0]) * line->normal[1];
        distance = profile_distance(line, s, r, direction, &inner);
        outside = outside || height > 0;
        if (fabs(distance) < nearest && (!inner || distance > 0)) {
            nearest = fabs(distance);
            memcpy(found[0], direction, sizeof direction);
        }
        if (height > deepest) {
            deepest = height;
            memcpy(found[1], line->normal, sizeof line->normal);
        }
    }
    memcpy(normal, found[outside ? 0 : 1], 2 * sizeof *normal);
    return outside ? nearest : deepest;
}

static void closest_on_round(const scree_surface *surface, size_t primitive, const double place[3],
                             scree_closest_point *closest)
{
    double from[3], radial[3], normal[2];
    bool inner = true, solid = surface->solid;
    scree_subtract(place, surface->start, from);
    double s = scree_dot(from, surface->axis);
    scree_along(from, -s, surface->axis, radial);
    double r = scree_normalise(radial);
    // On the axis every direction is as good as another.
    if (!(r > 0)) {
        int least = 0;
        for (int i = 1; i < 3; i++)
            if (fabs(surface->axis[i]) < fabs(surface->axis[least])) least = i;
        const double unit[3] = {least == 0, least == 1, least == 2};
        scree_cross(surface->axis, unit, radial);
        (void)scree_normalise(radial);
    }
    closest->distance = solid ? solid_profile(surface, s, r, normal)
                              : profile_distance(&surface->profile[primitive], s, r, normal, &inner);
    closest->minimum = solid || inner || surface->profile[primitive].free_ends;
    for (int i = 0; i < 3; i++) closest->normal[i] = normal[0] * surface->axis[i] + normal[1] * radial[i];
}

void scree_primitive_closest_point(const scree_wall_set *wall_set, size_t primitive, const scree_vector place,
                                   scree_closest_point *closest)
{
    const scree_surface *surface = &wall_set->surface[scree_primitive_surface(wall_set, primitive)];
    double inner[3];
    primitive -= surface->first;
    enter_frame(surface, place, inner);
    if (surface->kind == SCREE_SURFACE_MESH)
        scree_mesh_closest_point(&surface->mesh, primitive, inner, closest);
    else if (surface->kind == SCREE_SURFACE_PROFILE)
        closest_on_round(surface, primitive, inner, closest);
    else if (surface->kind == SCREE_SURFACE_BOX)
        closest_on_solid_box(wall_set->dimension, surface, inner, closest);
    else if (surface->kind == SCREE_SURFACE_OUTLINE)
        closest_on_outline(surface, inner, closest);
    else
        closest_on_plane(surface, primitive, inner, closest);
    leave_frame(surface, closest->normal);
}

bool scree_closest_point_touches(const scree_wall_set *wall_set, size_t primitive, const scree_closest_point *closest,
                                 double radius)
{
    const scree_surface *surface = &wall_set->surface[scree_primitive_surface(wall_set, primitive)];
    return closest->minimum && !(closest->distance >= radius) && (surface->endless || !(closest->distance <= -radius));
}

// ---- search ------------------------------------------------------------------------------------------------------

/// What a search in the mesh of one wall passes on.
typedef struct numbered {
    size_t first;
    scree_status (*found)(void *context, size_t primitive);
    void *context;
} numbered;

static scree_status pass_on(void *context, size_t primitive)
{
    const numbered *n = context;
    return n->found(n->context, n->first + primitive);
}

scree_status scree_wall_set_near(const scree_wall_set *wall_set, const scree_vector place, double reach,
                                 scree_status (*found)(void *context, size_t primitive), void *context)
{
    scree_status status = SCREE_OK;
    for (int k = 0; k < wall_set->count && !status; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        double inner[3];
        if (surface->kind == SCREE_SURFACE_MESH) {
            numbered pass = {surface->first, found, context};
            enter_frame(surface, place, inner);
            status = scree_mesh_near(&surface->mesh, inner, reach, pass_on, &pass);
            continue;
        }
        // Elements that are not minima now may become some before the next search.
        for (size_t e = surface->first; e < surface->first + surface->count && !status; e++) {
            scree_closest_point closest;
            scree_primitive_closest_point(wall_set, e, place, &closest);
            if (!(closest.distance >= reach)) status = found(context, e);
        }
    }
    return status;
}

// ---- clearance ---------------------------------------------------------------------------------------------------

/// What a search for the closest point of one mesh passes on.
typedef struct nearest_point {
    const scree_mesh *mesh;
    const double *place;
    double distance;
} nearest_point;

static scree_status lower_distance(void *context, size_t primitive)
{
    nearest_point *n = context;
    n->distance = fmin(n->distance, scree_mesh_distance(n->mesh, primitive, n->place));
    return SCREE_OK;
}

double scree_surface_clearance(const scree_wall_set *wall_set, int k, const scree_vector place, double reach)
{
    const scree_surface *surface = &wall_set->surface[k];
    double least = INFINITY, inner[3];
    enter_frame(surface, place, inner);
    if (surface->kind == SCREE_SURFACE_MESH) {
        nearest_point nearest = {&surface->mesh, inner, INFINITY};
        return scree_mesh_near(&surface->mesh, inner, reach, lower_distance, &nearest) ? NAN : nearest.distance;
    }
    for (size_t e = surface->first; e < surface->first + surface->count; e++) {
        scree_closest_point closest;
        scree_primitive_closest_point(wall_set, e, place, &closest);
        // Behind the end of a closed round wall its lines go on.
        if (!closest.minimum && surface->convex) {
            const scree_profile *line = &surface->profile[e - surface->first];
            double from[3], radial[3];
            scree_subtract(inner, surface->start, from);
            double s = scree_dot(from, surface->axis);
            scree_along(from, -s, surface->axis, radial);
            closest.distance =
                (s - line->s[0]) * line->normal[0] + (sqrt(scree_dot(radial, radial)) - line->r[0]) * line->normal[1];
        }
        least = fmin(least, closest.distance);
    }
    return least;
}
