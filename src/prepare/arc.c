/// Contacts and paths: see arc.h.
#include "prepare/arc.h"

#include "base/vectors.h"

#include <math.h>
#include <string.h>

/// Of unit vectors: forces, velocities and curvatures below this count as zero.
static const double SMALL = 1e-10;
/// Round-off of normals in a packing of some hundred radii.
static const double ROUND_OFF = 1e-13;
/// Sine of the angle by which an arc has to point into a surface that is known not to hold the point.
static const double SLANT = 1e-6;
/// Sine of the angle behind the start within which a surface counts as entered there.
static const double BEHIND = 1e-9;
/// Gap over the distance of two centres below which surfaces touch: above round-off, below all gaps of chance.
static const double GAP = 1e-12;

static void scale_to_one(double a[3])
{
    double length = sqrt(scree_dot(a, a));
    for (int c = 0; c < 3; c++) a[c] /= length;
}

/// Removes the part of `a` along the unit vector `e`.
static void make_normal_to(double a[3], const double e[3])
{
    double part = scree_dot(a, e);
    for (int c = 0; c < 3; c++) a[c] -= part * e[c];
}

void scree_arc_surface_normal(const scree_arc_surface *surface, const double point[3], double normal[3])
{
    for (int c = 0; c < 3; c++) normal[c] = surface->plane ? surface->centre[c] : point[c] - surface->centre[c];
    if (!surface->plane) scale_to_one(normal);
}

/// Multipliers of up to three normals that take all of gravity from their span. False if the normals are dependent: two
/// opposite ones would squeeze the point.
static bool solve(const double (*n)[3], const int *by, int count, double *multiplier)
{
    if (count == 1) multiplier[0] = n[by[0]][2];
    if (count == 2) {
        const double *a = n[by[0]], *b = n[by[1]];
        double g = scree_dot(a, b), determinant = 1 - g * g;
        if (determinant < SCREE_ARC_EQUATOR * SCREE_ARC_EQUATOR) return false;
        multiplier[0] = (a[2] - g * b[2]) / determinant;
        multiplier[1] = (b[2] - g * a[2]) / determinant;
    }
    if (count == 3) {
        double bc[3], ca[3], ab[3];
        const double *a = n[by[0]], *b = n[by[1]], *c = n[by[2]];
        scree_cross(b, c, bc);
        scree_cross(c, a, ca);
        scree_cross(a, b, ab);
        double determinant = scree_dot(a, bc);
        if (fabs(determinant) < SCREE_ARC_EQUATOR) return false;
        multiplier[0] = bc[2] / determinant;
        multiplier[1] = ca[2] / determinant;
        multiplier[2] = ab[2] / determinant;
    }
    return true;
}

/// The arc from `point` with `velocity` on one sphere, or on two surfaces of which the first is a sphere.
static scree_arc make_arc(const scree_arc_surface *one, const scree_arc_surface *other, const double point[3],
                          const double velocity[3])
{
    scree_arc arc = {.radius = one->reach, .touch = GAP * one->reach};
    memcpy(arc.middle, one->centre, sizeof arc.middle);
    memcpy(arc.ahead, velocity, sizeof arc.ahead);
    double axis[3];
    if (other) {
        double part;
        memcpy(axis, other->centre, sizeof axis);
        if (other->plane)
            part = other->reach - scree_dot(axis, one->centre);
        else {
            for (int c = 0; c < 3; c++) axis[c] -= one->centre[c];
            double distance = sqrt(scree_dot(axis, axis));
            for (int c = 0; c < 3; c++) axis[c] /= distance;
            part = (distance * distance + (one->reach - other->reach) * (one->reach + other->reach)) / (2 * distance);
        }
        for (int c = 0; c < 3; c++) arc.middle[c] += part * axis[c];
        arc.radius = sqrt(fmax((one->reach - part) * (one->reach + part), 0));
        make_normal_to(arc.ahead, axis);
    }
    for (int c = 0; c < 3; c++) arc.along[c] = point[c] - arc.middle[c];
    if (other) make_normal_to(arc.along, axis);
    scale_to_one(arc.along);
    make_normal_to(arc.ahead, arc.along);
    scale_to_one(arc.ahead);
    return arc;
}

/// A surface is entered where a sin + b cos of the angle along the arc passes `level`; a and b over `scale` are the
/// slant and the curvature into it at the start.
typedef struct rise {
    double a, b, level, scale;
    bool touches; ///< at the start
} rise;

static rise rise_to(const scree_arc *arc, const scree_arc_surface *surface)
{
    rise to = {.scale = surface->plane ? 1 : surface->reach};
    if (surface->plane) {
        to.a = -scree_dot(surface->centre, arc->ahead);
        to.b = -scree_dot(surface->centre, arc->along);
        to.level = (scree_dot(surface->centre, arc->middle) - surface->reach) / arc->radius;
    } else {
        double way[3];
        for (int k = 0; k < 3; k++) way[k] = surface->centre[k] - arc->middle[k];
        to.a = scree_dot(way, arc->ahead);
        to.b = scree_dot(way, arc->along);
        to.level =
            (scree_dot(way, way) + (arc->radius - surface->reach) * (arc->radius + surface->reach)) / (2 * arc->radius);
    }
    to.touches = (to.level - to.b) * arc->radius < arc->touch * to.scale;
    return to;
}

/// Does the arc go into a surface that it touches: by its slant, or without one by its curvature?
static bool enters_at_once(const rise *into, double slant)
{
    slant *= into->scale;
    return into->a > slant || (into->a >= -slant && into->b < -SMALL * into->scale);
}

/// Whether the path of the holders enters no other touched surface at once, with a larger slant than this.
static bool is_free(const scree_arc_surface *touched, int count, const scree_hold *hold, double slant)
{
    for (int k = 0; k < count; k++) {
        if (k == hold->by[0] || (hold->count == 2 && k == hold->by[1])) continue;
        rise into = rise_to(&hold->path, &touched[k]);
        if (enters_at_once(&into, slant)) return false;
    }
    return true;
}

/// Makes the path of the one or two holders.
static void make_path(const scree_arc_surface *touched, const double point[3], const double velocity[3],
                      scree_hold *hold)
{
    const scree_arc_surface *one = &touched[hold->by[0]], *other = hold->count == 2 ? &touched[hold->by[1]] : NULL;
    hold->path = other && one->plane ? make_arc(other, one, point, velocity) : make_arc(one, other, point, velocity);
}

/// What the search for holders knows of a point.
typedef struct spot {
    const scree_arc_surface *touched;
    double normal[SCREE_ARC_MOST][3];
    int count;
    const double *point;
} spot;

/// Tips over into `direction`, if no touched surface is in the way.
static bool tip(const spot *at, const double direction[3], scree_hold *hold)
{
    if (scree_dot(direction, direction) < SMALL * SMALL) return false;
    make_path(at->touched, at->point, direction, hold);
    return is_free(at->touched, at->count, hold, ROUND_OFF);
}

/// Into `direction` or its opposite.
static bool tip_to_either_side(const spot *at, const double direction[3], scree_hold *hold)
{
    const double opposite[3] = {-direction[0], -direction[1], -direction[2]};
    return tip(at, direction, hold) || tip(at, opposite, hold);
}

/// From the very top of one surface: along x, or away from another that it touches, or beside that one, or along both.
static bool tip_from_one(const spot *at, scree_hold *hold)
{
    const int one = hold->by[0];
    const double *top = at->normal[one];
    double way[3] = {1, 0, 0};
    make_normal_to(way, top);
    if (tip(at, way, hold)) return true;
    for (int k = 0; k < at->count; k++) {
        memcpy(way, at->normal[k], sizeof way);
        make_normal_to(way, top);
        if (k != one && tip(at, way, hold)) return true;
    }
    for (int k = 0; k < 2 * at->count; k++) {
        hold->by[1] = k % at->count;
        hold->count = k < at->count ? 1 : 2;
        scree_cross(top, at->normal[hold->by[1]], way);
        if (hold->by[1] != one && tip_to_either_side(at, way, hold)) return true;
    }
    return false;
}

/// The point stands on the very top of its one or two holders. It tips over, or rests where it is blocked on all sides.
static void leave_the_top(const spot *at, scree_hold *hold)
{
    double along[3];
    if (hold->count == 2) scree_cross(at->normal[hold->by[0]], at->normal[hold->by[1]], along);
    bool leaves = hold->count == 1 ? tip_from_one(at, hold) : tip_to_either_side(at, along, hold);
    if (!leaves) hold->count = 3;
}

/// Whether gravity has no part along the path of the one or two holders, nearly opposite ones too.
static bool is_on_top(const spot *at, const scree_hold *hold, const double velocity[3])
{
    double along[3];
    if (hold->count == 1) return scree_dot(velocity, velocity) <= SMALL * SMALL;
    scree_cross(at->normal[hold->by[0]], at->normal[hold->by[1]], along);
    return along[2] * along[2] <= SMALL * SMALL * scree_dot(along, along);
}

/// Whether these surfaces hold the point: multipliers >= 0, and the path that is left enters no other surface.
static bool holds(const spot *at, double tolerance, double slant, scree_hold *hold)
{
    double multiplier[3], velocity[3] = {0, 0, -1};
    bool walls = hold->count > 0;
    for (int k = 0; k < hold->count; k++) walls = walls && at->touched[hold->by[k]].plane;
    // Side walls by themselves hold nothing.
    if (walls || !solve(at->normal, hold->by, hold->count, multiplier)) return false;
    for (int k = 0; k < hold->count; k++) {
        if (multiplier[k] < -tolerance) return false;
        for (int c = 0; c < 3; c++) velocity[c] += multiplier[k] * at->normal[hold->by[k]][c];
    }
    if (hold->count == 3) return true;
    if (hold->count == 0) {
        for (int k = 0; k < at->count; k++)
            if (at->normal[k][2] > SCREE_ARC_EQUATOR) return false;
        return true;
    }
    if (is_on_top(at, hold, velocity)) {
        leave_the_top(at, hold);
        return true;
    }
    make_path(at->touched, at->point, velocity, hold);
    return is_free(at->touched, at->count, hold, slant);
}

/// The first set that holds. Sets of few first: they need no stronger normals.
static bool find_holders(const spot *at, double tolerance, double slant, scree_hold *hold)
{
    const int count = at->count;
    *hold = (scree_hold){.count = 0};
    if (holds(at, tolerance, slant, hold)) return true;
    for (int size = 1; size <= 3; size++)
        for (int i = 0; i < count; i++)
            for (int j = size > 1 ? i + 1 : count - 1; j < count; j++)
                for (int k = size > 2 ? j + 1 : count - 1; k < count; k++) {
                    *hold = (scree_hold){.count = size, .by = {i, j, k}};
                    if (holds(at, tolerance, slant, hold)) return true;
                }
    return false;
}

scree_hold scree_hold_find(const scree_arc_surface *touched, int count, const double point[3])
{
    spot at = {.touched = touched, .count = count, .point = point};
    for (int k = 0; k < count; k++) scree_arc_surface_normal(&touched[k], point, at.normal[k]);
    scree_hold hold;
    if (find_holders(&at, ROUND_OFF, ROUND_OFF, &hold) || find_holders(&at, SMALL, SLANT, &hold)) return hold;
    // Round-off alone leads here: as good as at rest.
    return (scree_hold){.count = 3};
}

double scree_arc_parting(const scree_arc_surface *one, const scree_arc_surface *other, double cosine)
{
    // The multiplier goes as n_one,z - cosine n_other,z, and n_z = (z - centre) / radius on a sphere, 0 on a wall.
    if (one->plane) return -1;
    if (!other || other->plane) return one->centre[2];
    double slope = 1 / one->reach - cosine / other->reach;
    if (slope <= 0) return -1;
    return (one->centre[2] / one->reach - cosine * other->centre[2] / other->reach) / slope;
}

bool scree_arc_enters(const scree_arc *arc, const scree_arc_surface *surface, bool released, double *measure,
                      double point[3])
{
    rise to = rise_to(arc, surface);
    double square = to.a * to.a + to.b * to.b, rest = square - to.level * to.level, root = sqrt(fmax(rest, 0));
    double sine = (to.a * to.level - to.b * root) / square, cosine = (to.b * to.level + to.a * root) / square;
    bool now = to.touches && (released ? to.a > SLANT * to.scale : enters_at_once(&to, ROUND_OFF));
    // What the arc leaves at the start it can only come back to: bent into it.
    if (to.touches && !now && (to.a >= 0 || to.b > -SMALL * to.scale)) return false;
    if (!to.touches && (!(rest > 0) || sine < -BEHIND || (sine < 0 && cosine < 0))) return false;
    if (now) {
        sine = 0;
        cosine = 1;
    }
    sine = fmax(sine, 0);
    *measure = cosine > 0 ? sine : 2 - sine;
    for (int k = 0; k < 3; k++)
        point[k] = arc->middle[k] + arc->radius * (cosine * arc->along[k] + sine * arc->ahead[k]);
    return true;
}
