/// Geometry outlines: convex polygons and discs among them, in two dimensions, by the area that two bodies share
/// (shape/overlap.h): its chord c, the gradient of the area A, has the normal and the line of action; forces act at the
/// point of contact, anywhere on the bodies, so this geometry has levers.
///   normal n = -c / |c|,   depth d = A / l,   l = r_1 r_2 / (r_1 + r_2)   (R 2.30, 2.31; r: from centre to point)
///   dA/dt = |c| d',        d' the approach of the two bodies at the point
/// Beside a wall l = r_1: a half-plane has no centre, and of a solid wall (shape/wall_set.h) r_2 is taken as infinite.
/// R's own walls are particles, whose l depends on the size of the plate.
///
/// Rates of the middle of the step need the turn of the normal and the way of the point in the step. With two
/// crossings, each lies on an edge of either body and moves with both: velocities of two lines give that of where they
/// cross. With more, or where edges are nearly parallel and the crossing runs along them, the point is taken to turn
/// with each body and the normal with their mean spin.
///
/// What no law can use (one body inside the other, a point near a centre: shape/overlap.h, flags) has an infinite
/// overlap, which stops the run.
///
/// Pairs are looked at one by one: bounding circles, the edge that kept them apart last (`hint` of the first body,
/// which can only reject), then the overlap itself. Source: R = P. Roul, PhD thesis, Magdeburg 2009, 2.4. Cost: some
/// 0.1 us a touching pair of polygons of 7 corners.
#ifndef SCREE_CONTACT_OUTLINES_H
#define SCREE_CONTACT_OUTLINES_H

#include "contact/kinematics.h"
#include "module/geometry.h"
#include "shape/disc_overlap.h"
#include "shape/half_plane_overlap.h"
#include "shape/polygon_pair.h"
#include "shape/polygons.h"

static const scree_geometry_traits outlines_traits = {.levers = true, .coarse = true, .areas = true, .solids = true};

/// Circles only: kinematics have an overlap above zero where outlines meet.
SCREE_INLINE lanes_bits outlines_touches(int dimension, const bodies *first, const bodies *second)
{
    const vector apart = vector_minus(dimension, first->position, second->position);
    const lanes reach = first->radius + second->radius;
    return ~lanes_at_or_below(reach * reach, vector_dot(dimension, apart, apart));
}

/// The body as it lies.
SCREE_INLINE scree_polygon outlines_polygon(const bodies *body)
{
    return scree_polygon_of_row(body->state, scree_polygons_of(body->state), body->row);
}

/// False: the outlines do not meet.
SCREE_INLINE bool outlines_meet(const scree_polygon polygon[2], const double apart[2], int8_t *hint,
                                scree_overlap *overlap)
{
    const bool round[2] = {polygon[0].count == 0, polygon[1].count == 0};
    if (!round[0] && !round[1]) {
        int edge = hint ? *hint : 0;
        const bool meet = scree_polygon_pair_overlap(&polygon[0], &polygon[1], apart, &edge, overlap);
        if (hint) *hint = (int8_t)edge;
        return meet;
    }
    const double radius[2] = {polygon[0].radius, polygon[1].radius};
    if (round[0] && round[1]) return scree_disc_overlap(radius, apart, overlap);
    if (round[0]) return scree_disc_overlap_polygon(radius[0], &polygon[1], apart, overlap);
    const double back[2] = {-apart[0], -apart[1]};
    if (!scree_disc_overlap_polygon(radius[1], &polygon[0], back, overlap)) return false;
    scree_overlap_exchange(overlap);
    return true;
}

/// The turn of the normal [rad] and the ways of the point from both centres [m] in a step. velocity: of the second
/// centre relative to the first.
SCREE_INLINE void outlines_move(kinematics *m, const scree_overlap *overlap, const double velocity[2],
                                const double spin[2], double step)
{
    double rate[2][2];
    const double *c = overlap->chord;
    if (scree_overlap_end_rates(overlap, velocity, spin, step, rate)) {
        // The chord turns as the line between the crossings does.
        const double way[2] = {rate[1][0] - rate[0][0], rate[1][1] - rate[0][1]};
        m->tilted.x = step * (-c[1] * way[1] - c[0] * way[0]) / (c[0] * c[0] + c[1] * c[1]);
        m->moved_first.x = step * 0.5 * (rate[0][0] + rate[1][0]);
        m->moved_first.y = step * 0.5 * (rate[0][1] + rate[1][1]);
        m->moved_second.x = m->moved_first.x - step * velocity[0];
        m->moved_second.y = m->moved_first.y - step * velocity[1];
        return;
    }
    m->tilted.x = 0.5 * step * (spin[0] + spin[1]);
    m->moved_first.x = -step * spin[0] * overlap->arm[0][1];
    m->moved_first.y = step * spin[0] * overlap->arm[0][0];
    m->moved_second.x = -step * spin[1] * overlap->arm[1][1];
    m->moved_second.y = step * spin[1] * overlap->arm[1][0];
}

/// What does not depend on velocities.
SCREE_INLINE kinematics outlines_place(const scree_overlap *overlap, double length)
{
    const double *c = overlap->chord, chord = sqrt(c[0] * c[0] + c[1] * c[1]);
    kinematics m = {.normal = {-c[0] / chord, -c[1] / chord, 0},
                    .overlap = overlap->area / length,
                    .area = overlap->area,
                    .chord = chord,
                    .length = length,
                    .lever_first = {overlap->arm[0][0], overlap->arm[0][1], 0},
                    .lever_second = {overlap->arm[1][0], overlap->arm[1][1], 0}};
    if (overlap->flags) {
        m = (kinematics){.normal = {1, 0, 0}, .overlap = INFINITY, .area = INFINITY, .chord = 1, .length = 1};
        m.lever_first.x = m.lever_second.x = 0;
    }
    return m;
}

/// Velocities of n - 1/2, for the work that a force at its own pose has done. velocity: of the second centre relative
/// to the first. The line between the centres is that from lever to lever, also where nothing is shared.
SCREE_INLINE void outlines_pass(kinematics *m, const double velocity[2], const double spin[2])
{
    m->passing = (vector){-velocity[0], -velocity[1], 0};
    m->spin_first = spin[0];
    m->spin_second = spin[1];
}

/// r^2 / I of a body [1/kg]: what its turning adds to the mobility of the point.
SCREE_INLINE double outlines_turning(const bodies *body, const double arm[2])
{
    const double turning = body->state->form ? body->state->form[body->row].turning : body->radius;
    return 2 * (arm[0] * arm[0] + arm[1] * arm[1]) / (body->mass * turning * turning);
}

SCREE_INLINE kinematics outlines_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const scree_polygon polygon[2] = {outlines_polygon(first), outlines_polygon(second)};
    const double apart[2] = {second->position.x - first->position.x, second->position.y - first->position.y};
    const double velocity[2] = {second->velocity.x - first->velocity.x, second->velocity.y - first->velocity.y};
    const double spin[2] = {first->spin.x, second->spin.x};
    scree_overlap overlap;
    if (!outlines_meet(polygon, apart, first->hint, &overlap)) {
        kinematics none = {.normal = {1, 0, 0}, .overlap = 0, .chord = 1, .length = 1, .reduced_mass = 1};
        none.reduced_mass_along = none.rest_length = none.reduced_radius = 1;
        none.lever_second = (vector){-apart[0], -apart[1], 0};
        outlines_pass(&none, velocity, spin);
        return none;
    }
    kinematics m = outlines_place(&overlap, scree_overlap_length(&overlap));
    m.rest_length = m.reduced_radius = polygon[0].radius * polygon[1].radius / (polygon[0].radius + polygon[1].radius);
    m.reduced_mass = first->mass * second->mass / (first->mass + second->mass);
    m.reduced_mass_along =
        1 / (1 / m.reduced_mass + (outlines_turning(first, overlap.arm[0]) + outlines_turning(second, overlap.arm[1])));
    outlines_pass(&m, velocity, spin);
    if (step > 0) outlines_move(&m, &overlap, velocity, spin, step);
    kinematics_from_levers(dimension, &m, first, second, step);
    return m;
}

/// What a wall as the second body does not add to: its radius and mass are infinite. overlap: NULL, nothing is shared.
SCREE_INLINE void outlines_past_wall(kinematics *m, const bodies *body, double radius, const scree_overlap *overlap,
                                     double step)
{
    const double velocity[2] = {-body->velocity.x, -body->velocity.y}, spin[2] = {body->spin.x, 0};
    m->rest_length = m->reduced_radius = radius;
    m->reduced_mass = m->reduced_mass_along = body->mass;
    outlines_pass(m, velocity, spin);
    if (!overlap || overlap->flags) return;
    m->reduced_mass_along = 1 / (1 / body->mass + outlines_turning(body, overlap->arm[0]));
    if (step > 0) outlines_move(m, overlap, velocity, spin, step);
}

/// The velocity of the body is that in the frame of the wall.
SCREE_INLINE kinematics outlines_beside(const bodies *body, const double normal[3], double distance, double step)
{
    const scree_polygon polygon = outlines_polygon(body);
    scree_overlap overlap;
    const bool meet = polygon.count == 0 ? scree_disc_half_plane_overlap(polygon.radius, normal, distance, &overlap)
                                         : scree_polygon_half_plane_overlap(&polygon, normal, distance, &overlap);
    kinematics m = {.overlap = 0, .chord = 1, .length = 1};
    if (meet) m = outlines_place(&overlap, scree_overlap_wall_length(&overlap));
    m.normal = (vector){normal[0], normal[1], normal[2]};
    outlines_past_wall(&m, body, polygon.radius, meet ? &overlap : NULL, step);
    m.tilted.x = 0; // the normal is that of the wall
    return m;
}

/// Edge of `wall` that the centre of the other body is farthest beyond, from 1 on: most likely it keeps them apart.
SCREE_INLINE int outlines_facing_edge(const scree_polygon *wall, const double apart[2])
{
    double farthest = 0;
    int facing = 0;
    for (int k = 0; k < wall->count; k++) {
        const double *a = wall->corner[k], *b = wall->corner[scree_next_corner(wall->count, k)];
        const double way[2] = {b[0] - a[0], b[1] - a[1]};
        const double out = -way[1] * (apart[0] + a[0]) + way[0] * (apart[1] + a[1]);
        const double square = out > 0 ? out * out / (way[0] * way[0] + way[1] * way[1]) : 0;
        if (square > farthest) {
            farthest = square;
            facing = k + 1;
        }
    }
    return facing;
}

/// Beside a solid wall, whose centroid lies `apart` from the centre of the body. The velocity of the body is that in
/// the frame of the wall.
SCREE_INLINE kinematics outlines_against(const bodies *body, const scree_polygon *wall, const double apart[2],
                                         double step)
{
    const scree_polygon polygon[2] = {outlines_polygon(body), *wall};
    scree_overlap overlap;
    int8_t hint = (int8_t)-outlines_facing_edge(wall, apart);
    const bool meet = outlines_meet(polygon, apart, &hint, &overlap);
    kinematics m = {.normal = {1, 0, 0}, .overlap = 0, .chord = 1, .length = 1};
    if (meet) m = outlines_place(&overlap, scree_overlap_wall_length(&overlap));
    outlines_past_wall(&m, body, polygon[0].radius, meet ? &overlap : NULL, step);
    return m;
}

SCREE_INLINE lanes outlines_reach(const bodies *body)
{
    return body->radius;
}

#endif
