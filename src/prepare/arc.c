/// Contacts and paths: see arc.h.
#include "prepare/arc.h"

#include "base/vectors.h"

#include <math.h>
#include <string.h>

/// Of unit vectors: forces and velocities below this count as zero.
static const double SMALL = 1e-10;
/// Sine of the angle behind the start within which a surface counts as entered there.
static const double BEHIND = 1e-9;

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

/// Multipliers of up to three normals that take all of gravity from their span. False if the normals are dependent.
static bool solve(const double (*n)[3], const int *by, int count, double *multiplier)
{
    if (count == 1) multiplier[0] = n[by[0]][2];
    if (count == 2) {
        const double *a = n[by[0]], *b = n[by[1]];
        double g = scree_dot(a, b), determinant = 1 - g * g;
        if (determinant < SMALL * SMALL) return false;
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
        if (fabs(determinant) < SMALL) return false;
        multiplier[0] = bc[2] / determinant;
        multiplier[1] = ca[2] / determinant;
        multiplier[2] = ab[2] / determinant;
    }
    return true;
}

/// Whether these normals hold the point: multipliers >= 0, and the velocity that is left enters no other surface.
static bool holds(const double (*normal)[3], int count, scree_hold *hold)
{
    double multiplier[3];
    if (!solve(normal, hold->by, hold->count, multiplier)) return false;
    memcpy(hold->velocity, (const double[3]){0, 0, -1}, sizeof hold->velocity);
    for (int k = 0; k < hold->count; k++) {
        if (multiplier[k] < -SMALL) return false;
        for (int c = 0; c < 3; c++) hold->velocity[c] += multiplier[k] * normal[hold->by[k]][c];
    }
    if (hold->count == 3) memset(hold->velocity, 0, sizeof hold->velocity);
    for (int k = 0; k < count; k++) {
        bool holding = false;
        for (int h = 0; h < hold->count; h++) holding = holding || hold->by[h] == k;
        if (!holding && scree_dot(normal[k], hold->velocity) < -SMALL) return false;
    }
    return true;
}

/// On the very top of its one or two surfaces the point stands but does not rest: it goes along x, or along both.
static void leave_the_top(const double (*normal)[3], scree_hold *hold)
{
    if (hold->count == 3 || scree_dot(hold->velocity, hold->velocity) > SMALL * SMALL) return;
    if (hold->count == 1) {
        memcpy(hold->velocity, (const double[3]){1, 0, 0}, sizeof hold->velocity);
        make_normal_to(hold->velocity, normal[hold->by[0]]);
    } else
        scree_cross(normal[hold->by[0]], normal[hold->by[1]], hold->velocity);
}

scree_hold scree_hold_find(const double (*normal)[3], int count)
{
    scree_hold hold = {0};
    if (holds(normal, count, &hold)) return hold;
    // The projection is unique: the first set that holds is the one. Sets of few first: they need no stronger normals.
    for (hold.count = 1; hold.count <= 3; hold.count++)
        for (hold.by[0] = 0; hold.by[0] < count; hold.by[0]++)
            for (hold.by[1] = hold.count > 1 ? hold.by[0] + 1 : count - 1; hold.by[1] < count; hold.by[1]++)
                for (hold.by[2] = hold.count > 2 ? hold.by[1] + 1 : count - 1; hold.by[2] < count; hold.by[2]++)
                    if (holds(normal, count, &hold)) {
                        leave_the_top(normal, &hold);
                        return hold;
                    }
    // Round-off alone leads here: as good as at rest.
    return (scree_hold){.count = 3, .by = {0, count > 1, count > 2 ? 2 : 0}};
}

scree_arc scree_arc_make(const scree_arc_surface *one, const scree_arc_surface *other, const double point[3],
                         const double velocity[3])
{
    scree_arc arc = {.radius = one->reach};
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

double scree_arc_parting(const scree_arc_surface *one, const scree_arc_surface *other, double cosine)
{
    // The multiplier goes as n_one,z - cosine n_other,z, and n_z = (z - centre) / radius on a sphere, 0 on a wall.
    if (one->plane) return -1;
    if (!other || other->plane) return one->centre[2];
    double slope = 1 / one->reach - cosine / other->reach;
    if (slope <= 0) return -1;
    return (one->centre[2] / one->reach - cosine * other->centre[2] / other->reach) / slope;
}

bool scree_arc_enters(const scree_arc *arc, const scree_arc_surface *surface, double *measure, double point[3])
{
    double a, b, c;
    if (surface->plane) {
        a = -scree_dot(surface->centre, arc->ahead);
        b = -scree_dot(surface->centre, arc->along);
        c = (scree_dot(surface->centre, arc->middle) - surface->reach) / arc->radius;
    } else {
        double way[3];
        for (int k = 0; k < 3; k++) way[k] = surface->centre[k] - arc->middle[k];
        a = scree_dot(way, arc->ahead);
        b = scree_dot(way, arc->along);
        c = (scree_dot(way, way) + (arc->radius - surface->reach) * (arc->radius + surface->reach)) / (2 * arc->radius);
    }
    double square = a * a + b * b, rest = square - c * c;
    if (!(rest > 0)) return false;
    double root = sqrt(rest), sine = (a * c - b * root) / square, cosine = (b * c + a * root) / square;
    if (sine < -BEHIND || (sine < 0 && cosine < 0)) return false;
    sine = fmax(sine, 0);
    *measure = cosine > 0 ? sine : 2 - sine;
    for (int k = 0; k < 3; k++)
        point[k] = arc->middle[k] + arc->radius * (cosine * arc->along[k] + sine * arc->ahead[k]);
    return true;
}
