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
/// Where two outlines cross is found pair by pair, and need not be found again before one of them has moved so far that
/// it may have changed (shape/polygon_hint.h). The rest is done in lanes, one in the scalar reference. Source: R = P.
/// Roul, PhD thesis, Magdeburg 2009, 2.4. Cost: docs/performance.md.
#ifndef SCREE_CONTACT_OUTLINES_H
#define SCREE_CONTACT_OUTLINES_H

#include "contact/kinematics.h"
#include "contact/outlines_lanes.h"
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

/// Finds what the bodies in two rows share, into lane `k`. apart: from the first centre to the second.
SCREE_INLINE void outlines_find(const scree_state *state, const scree_polygons *polygons, const uint32_t row[2],
                                const double apart[2], int k, outlines_share *share)
{
    const scree_polygon polygon[2] = {scree_polygon_of_row(state, polygons, row[0]),
                                      scree_polygon_of_row(state, polygons, row[1])};
    scree_overlap overlap;
    int8_t hint = 0;
    (void)k;
    for (int b = 0; b < 2; b++)
        outlines_share_body(share, k, b, polygon[b].radius,
                            state->form ? state->form[row[b]].turning : polygon[b].bound);
    outlines_share_put(share, k, outlines_meet(polygon, apart, &hint, &overlap) ? &overlap : NULL);
}

// ---- the motion ----------------------------------------------------------------------------------------------------

/// l of R 2.31: that of a body alone beside a wall. arm: from its centre to the point.
SCREE_INLINE lanes outlines_arm_length(const lanes arm[2])
{
    return lanes_root(arm[0] * arm[0] + arm[1] * arm[1]);
}

SCREE_INLINE lanes outlines_length(const outlines_share *share)
{
    const lanes first = outlines_arm_length(share->arm[0]), second = outlines_arm_length(share->arm[1]);
    return first * second / (first + second);
}

/// Velocity of one of two crossings relative to the first centre [m/s], exactly: it stays on the outlines of both
/// bodies. velocity: of the second centre relative to the first. Mask: where it runs less far along either edge in
/// `step` than a quarter of the chord, so that its velocity says something about the step.
SCREE_INLINE lanes_bits outlines_crossing_rate(const outlines_share *share, int crossing, const lanes velocity[2],
                                               const lanes spin[2], double step, lanes rate[2])
{
    const lanes *c = share->chord;
    const lanes half[2] = {-c[1] / 2.0, c[0] / 2.0}, most = c[0] * c[0] + c[1] * c[1];
    const double sign = crossing == 0 ? -1 : 1;
    const lanes *one = share->edge[crossing][0], *other = share->edge[crossing][1];
    const lanes x[2] = {share->arm[0][0] + sign * half[0], share->arm[0][1] + sign * half[1]};
    const lanes y[2] = {share->arm[1][0] + sign * half[0], share->arm[1][1] + sign * half[1]};
    const lanes own[2] = {-spin[0] * x[1], spin[0] * x[0]};
    const lanes passing[2] = {velocity[0] - spin[1] * y[1] - own[0], velocity[1] + spin[1] * y[0] - own[1]};
    const lanes across = one[0] * other[1] - one[1] * other[0];
    const lanes share_of_one = (passing[0] * other[1] - passing[1] * other[0]) / across;
    const lanes way[2] = {share_of_one * one[0], share_of_one * one[1]};
    const lanes back[2] = {way[0] - passing[0], way[1] - passing[1]};
    for (int i = 0; i < 2; i++) rate[i] = own[i] + way[i];
    return lanes_below(16.0 * (way[0] * way[0] + way[1] * way[1]) * step * step, most) &
           lanes_below(16.0 * (back[0] * back[0] + back[1] * back[1]) * step * step, most);
}

/// The turn of the normal [rad] and the ways of the point from both centres [m] in a step. velocity: of the second
/// centre relative to the first.
SCREE_INLINE void outlines_move(kinematics *m, const outlines_share *share, const lanes velocity[2],
                                const lanes spin[2], double step)
{
    const lanes *c = share->chord, *first = share->arm[0], *second = share->arm[1];
    lanes rate[2][2];
    lanes_bits known = share->meet & share->twice;
    for (int k = 0; k < 2; k++) known &= outlines_crossing_rate(share, k, velocity, spin, step, rate[k]);
    // The chord turns as the line between the crossings does.
    const lanes way[2] = {rate[1][0] - rate[0][0], rate[1][1] - rate[0][1]};
    const lanes turn = step * (-c[1] * way[1] - c[0] * way[0]) / (c[0] * c[0] + c[1] * c[1]);
    const lanes x = step * 0.5 * (rate[0][0] + rate[1][0]), y = step * 0.5 * (rate[0][1] + rate[1][1]);
    m->tilted.x = lanes_select(known, turn, 0.5 * step * (spin[0] + spin[1]));
    m->moved_first.x = lanes_select(known, x, -step * spin[0] * first[1]);
    m->moved_first.y = lanes_select(known, y, step * spin[0] * first[0]);
    m->moved_second.x = lanes_select(known, x - step * velocity[0], -step * spin[1] * second[1]);
    m->moved_second.y = lanes_select(known, y - step * velocity[1], step * spin[1] * second[0]);
}

/// What does not depend on velocities. length: l.
SCREE_INLINE kinematics outlines_place(const outlines_share *share, lanes length)
{
    const lanes *c = share->chord, one = lanes_all(1), none = lanes_all(0);
    const lanes_bits usable = share->meet & ~share->useless, useless = share->meet & share->useless;
    const lanes chord = lanes_select(usable, lanes_root(c[0] * c[0] + c[1] * c[1]), one);
    kinematics m = {.normal = {lanes_select(usable, -c[0] / chord, one), lanes_keep(usable, -c[1] / chord), none},
                    .chord = chord,
                    .length = lanes_select(usable, length, one),
                    .lever_first = {lanes_keep(usable, share->arm[0][0]), lanes_keep(usable, share->arm[0][1]), none},
                    .lever_second = {lanes_keep(usable, share->arm[1][0]), lanes_keep(usable, share->arm[1][1]), none}};
    m.overlap = lanes_select(useless, lanes_all(INFINITY), share->area / m.length);
    m.area = lanes_select(useless, lanes_all(INFINITY), share->area);
    return m;
}

/// Velocities of n - 1/2, for the work that a force at its own pose has done. velocity: of the second centre relative
/// to the first. The line between the centres is that from lever to lever, also where nothing is shared.
SCREE_INLINE void outlines_pass(kinematics *m, const lanes velocity[2], const lanes spin[2])
{
    m->passing = (vector){.x = -velocity[0], .y = -velocity[1]};
    m->spin_first = spin[0];
    m->spin_second = spin[1];
}

/// r^2 / I of a body [1/kg]: what its turning adds to the mobility of the point.
SCREE_INLINE lanes outlines_turning(const bodies *body, lanes turning, const lanes arm[2])
{
    return 2.0 * (arm[0] * arm[0] + arm[1] * arm[1]) / (body->mass * turning * turning);
}

/// Where nothing is shared there are no rates.
SCREE_INLINE void outlines_keep(kinematics *m, lanes_bits meet)
{
    m->arm_first = lanes_keep(meet, m->arm_first);
    m->arm_second = lanes_keep(meet, m->arm_second);
    m->approach = lanes_keep(meet, m->approach);
    m->slip.x = lanes_keep(meet, m->slip.x);
    m->roll.x = lanes_keep(meet, m->roll.x);
    m->tilted.x = lanes_keep(meet, m->tilted.x);
    m->dashpot_approach = lanes_keep(meet, m->dashpot_approach);
    m->dashpot_slip.x = lanes_keep(meet, m->dashpot_slip.x);
    m->dashpot_roll.x = lanes_keep(meet, m->dashpot_roll.x);
}

SCREE_INLINE kinematics outlines_motion(int dimension, const outlines_share *share, const bodies *first,
                                        const bodies *second, double step)
{
    const lanes apart[2] = {second->position.x - first->position.x, second->position.y - first->position.y};
    const lanes velocity[2] = {second->velocity.x - first->velocity.x, second->velocity.y - first->velocity.y};
    const lanes spin[2] = {first->spin.x, second->spin.x}, *radius = share->radius;
    kinematics m = outlines_place(share, outlines_length(share));
    m.lever_second.x = lanes_select(share->meet, m.lever_second.x, -apart[0]);
    m.lever_second.y = lanes_select(share->meet, m.lever_second.y, -apart[1]);
    m.rest_length = m.reduced_radius = radius[0] * radius[1] / (radius[0] + radius[1]);
    m.reduced_mass = first->mass * second->mass / (first->mass + second->mass);
    m.reduced_mass_along = 1.0 / (1.0 / m.reduced_mass + (outlines_turning(first, share->turning[0], share->arm[0]) +
                                                          outlines_turning(second, share->turning[1], share->arm[1])));
    outlines_pass(&m, velocity, spin);
    if (step > 0) outlines_move(&m, share, velocity, spin, step);
    kinematics_from_levers(dimension, &m, first, second, step);
    outlines_keep(&m, share->meet);
    return m;
}

SCREE_INLINE lanes outlines_reach(const bodies *body)
{
    return body->radius;
}

#if SCREE_LANES > 1

/// What they share has been found, or where they cross.
SCREE_INLINE kinematics outlines_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const lanes apart[2] = {second->position.x - first->position.x, second->position.y - first->position.y};
    const lanes bound[2] = {first->radius, second->radius};
    outlines_share share;
    outlines_work_out(first->found, apart, bound, &share);
    return outlines_motion(dimension, &share, first, second, step);
}

#else

SCREE_INLINE kinematics outlines_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const double apart[2] = {second->position.x - first->position.x, second->position.y - first->position.y};
    const uint32_t row[2] = {(uint32_t)first->row, (uint32_t)second->row};
    outlines_share share;
    outlines_find(first->state, scree_polygons_of(first->state), row, apart, 0, &share);
    return outlines_motion(dimension, &share, first, second, step);
}

// ---- walls ---------------------------------------------------------------------------------------------------------

/// The body as it lies.
SCREE_INLINE scree_polygon outlines_polygon(const bodies *body)
{
    return scree_polygon_of_row(body->state, scree_polygons_of(body->state), body->row);
}

/// Beside a wall, whose radius and mass are infinite. overlap: NULL, nothing is shared.
SCREE_INLINE kinematics outlines_past_wall(const bodies *body, double radius, const scree_overlap *overlap, double step)
{
    const double velocity[2] = {-body->velocity.x, -body->velocity.y}, spin[2] = {body->spin.x, 0};
    const double turning = body->state->form ? body->state->form[body->row].turning : body->radius;
    outlines_share share;
    outlines_share_put(&share, 0, overlap);
    kinematics m = outlines_place(&share, outlines_arm_length(share.arm[0]));
    m.rest_length = m.reduced_radius = radius;
    m.reduced_mass = m.reduced_mass_along = body->mass;
    outlines_pass(&m, velocity, spin);
    if (!overlap || overlap->flags) return m;
    m.reduced_mass_along = 1 / (1 / body->mass + outlines_turning(body, turning, share.arm[0]));
    if (step > 0) outlines_move(&m, &share, velocity, spin, step);
    return m;
}

/// The velocity of the body is that in the frame of the wall.
SCREE_INLINE kinematics outlines_beside(const bodies *body, const double normal[3], double distance, double step)
{
    const scree_polygon polygon = outlines_polygon(body);
    scree_overlap overlap;
    const bool meet = polygon.count == 0 ? scree_disc_half_plane_overlap(polygon.radius, normal, distance, &overlap)
                                         : scree_polygon_half_plane_overlap(&polygon, normal, distance, &overlap);
    kinematics m = outlines_past_wall(body, polygon.radius, meet ? &overlap : NULL, step);
    m.normal = (vector){normal[0], normal[1], normal[2]};
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
    return outlines_past_wall(body, polygon[0].radius, meet ? &overlap : NULL, step);
}

#endif

#endif
