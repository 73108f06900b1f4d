/// Geometry rounded: convex polygons with rounded corners and discs among them, in two dimensions, under the laws of
/// springs, by the closest features of their cores (shape/core_pair.h): each corner of either core that is in range of
/// the other, with depth d_k along u_k.
///   overlap delta = sqrt(sum d_k^2),   g n = sum d_k u_k / delta,   line of action from the wrench of the same sum
/// A corner on an edge, two corners, a disc anywhere have one feature or two alike, and delta is the depth d, or
/// d sqrt(2); a face on a face has a feature at each end of what they share. With a linear spring k the force is that
/// of a spring k at each feature, its energy k sum d_k^2 / 2. The gain g (contact/kinematics.h) is sqrt(n) for n
/// features alike. The force is continuous in the pose, where edges turn through parallel, too: delta^2 has a
/// continuous gradient. One contact, one memory, one line of action a pair.
///
/// Beside a half-plane every corner that is in range of it is a feature; beside a solid wall (shape/wall_set.h) those
/// of the wall are, too, with a rounding of 0.
///
/// Rates are those of the middle of the step: the features are found again in the pose half a step before, on the edges
/// that they have now. The reduced radius is that of the roundings (of a disc its radius), beside a wall the rounding;
/// the curvature of a contact does not follow the features, so that the law stays the same function of the overlap.
/// The reduced mass is m_eff / g^2, that of the overlap.
///
/// Cores that meet have an infinite overlap, which stops the run.
///
/// Source: features of vertices and edges, summed, with an energy: F. Alonso-Marroquin, EPL 83 (2008) 14001; what
/// differs here: docs/theory/polygons.md. Cost: some 0.1 us a touching pair of polygons of 7 corners.
#ifndef SCREE_CONTACT_ROUNDED_H
#define SCREE_CONTACT_ROUNDED_H

#include "contact/kinematics.h"
#include "module/geometry.h"
#include "shape/core_pair.h"
#include "shape/polygons.h"

static const scree_geometry_traits rounded_traits = {.levers = true, .coarse = true, .solids = true, .gains = true};

/// Circles only: kinematics have an overlap above zero where outlines meet.
SCREE_INLINE lanes_bits rounded_touches(int dimension, const bodies *first, const bodies *second)
{
    const vector apart = vector_minus(dimension, first->position, second->position);
    const lanes reach = first->radius + second->radius;
    return ~lanes_at_or_below(reach * reach, vector_dot(dimension, apart, apart));
}

/// The body as it lies.
SCREE_INLINE scree_core rounded_core(const bodies *body)
{
    return scree_core_of_row(body->state, scree_polygons_of(body->state), body->row);
}

/// Sums over the features of one side, u and moments as the force on the first body has them.
typedef struct rounded_sums {
    double square;   ///< m2, sum d^2
    double weight;   ///< m, sum d
    double along[2]; ///< m, sum d u
    double point[2]; ///< m2, sum d q, from the centre of the body with the closest points
    double moment;   ///< m2, sum d q x u, about that centre
} rounded_sums;

SCREE_INLINE void rounded_add(rounded_sums *sums, const scree_feature *f)
{
    const double d = f->depth;
    sums->square += d * d;
    sums->weight += d;
    for (int k = 0; k < 2; k++) {
        sums->along[k] += d * f->normal[k];
        sums->point[k] += d * f->point[k];
    }
    sums->moment += d * (f->point[0] * f->normal[1] - f->point[1] * f->normal[0]);
}

/// Where the resultant acts, and how strongly.
typedef struct rounded_place {
    double overlap, gain;
    double normal[2];   ///< from second to first
    double lever[2][2]; ///< m, from both centres
} rounded_place;

/// From the sums of both sides; apart: from the first centre to the second.
SCREE_INLINE rounded_place rounded_resultant(const rounded_sums sums[2], const double apart[2])
{
    const double along[2] = {sums[0].along[0] - sums[1].along[0], sums[0].along[1] - sums[1].along[1]};
    const double size = sqrt(along[0] * along[0] + along[1] * along[1]), weight = sums[0].weight + sums[1].weight;
    rounded_place place = {.overlap = sqrt(sums[0].square + sums[1].square)};
    place.gain = size / place.overlap;
    for (int k = 0; k < 2; k++) {
        const double base = sums[0].point[k] + sums[1].point[k];
        place.normal[k] = along[k] / size;
        place.lever[0][k] = (base + sums[0].weight * apart[k]) / weight;
        place.lever[1][k] = (base - sums[1].weight * apart[k]) / weight;
    }
    // The mean point, moved across the force until its torque is that of the features.
    double torque = 0;
    for (int s = 0; s < 2; s++) {
        // Side 0 has its points from the second centre.
        const double *lever = place.lever[1 - s];
        const double rest = sums[s].moment - (lever[0] * sums[s].along[1] - lever[1] * sums[s].along[0]);
        torque = s == 0 ? rest : torque - rest;
    }
    const double shift = torque / (size * size);
    for (int b = 0; b < 2; b++) {
        place.lever[b][0] += shift * along[1];
        place.lever[b][1] -= shift * along[0];
    }
    return place;
}

/// A place that a body carries, half a step before: `turn` is its spin times half the step.
SCREE_INLINE void rounded_before(const double place[2], double turn, double before[2])
{
    before[0] = place[0] + turn * place[1];
    before[1] = place[1] - turn * place[0];
}

/// Sums over the features of side `side` in the pose half a step before. own, other: of the body with the corners and
/// of that with the points; shift: from the first of these centres to the second, then.
SCREE_INLINE rounded_sums rounded_sums_before(const scree_features *features, int side, const scree_core *own,
                                              const scree_core *other, const double shift[2], double turn_own,
                                              double turn_other)
{
    rounded_sums sums = {0};
    for (int k = 0; k < features->count[side]; k++) {
        const scree_feature *now = &features->of[side][k];
        scree_feature f;
        double corner[2], point[2] = {0, 0}, square;
        rounded_before(now->corner, turn_own, corner);
        corner[0] -= shift[0];
        corner[1] -= shift[1];
        if (other->count == 0) {
            square = corner[0] * corner[0] + corner[1] * corner[1];
        } else {
            double a[2], b[2];
            rounded_before(other->corner[now->edge], turn_other, a);
            rounded_before(other->corner[now->edge + 1 < other->count ? now->edge + 1 : 0], turn_other, b);
            square = scree_segment_closest(a, b, corner, point);
        }
        if (scree_feature_place(corner, point, square, own->rounding, other->rounding, &f)) rounded_add(&sums, &f);
    }
    return sums;
}

/// Tilt, ways of the levers and gain of the middle of the step, from the places now and half a step before.
SCREE_INLINE void rounded_move(kinematics *m, const rounded_place *now, const rounded_place *before)
{
    const double *n = now->normal, change[2] = {n[0] - before->normal[0], n[1] - before->normal[1]};
    m->tilted.x = 2 * (change[1] * n[0] - change[0] * n[1]);
    m->moved_first =
        (vector){2 * (now->lever[0][0] - before->lever[0][0]), 2 * (now->lever[0][1] - before->lever[0][1]), 0};
    m->moved_second =
        (vector){2 * (now->lever[1][0] - before->lever[1][0]), 2 * (now->lever[1][1] - before->lever[1][1]), 0};
    m->gain_middle = before->gain;
}

/// Nothing touches.
SCREE_INLINE kinematics rounded_none(void)
{
    return (kinematics){
        .normal = {1, 0, 0}, .overlap = 0, .reduced_mass = 1, .reduced_radius = 1, .gain = 1, .gain_middle = 1};
}

/// What does not depend on velocities.
SCREE_INLINE kinematics rounded_lie(const rounded_place *place, double reduced_radius, double reduced_mass)
{
    return (kinematics){.normal = {place->normal[0], place->normal[1], 0},
                        .overlap = place->overlap,
                        .lever_first = {place->lever[0][0], place->lever[0][1], 0},
                        .lever_second = {place->lever[1][0], place->lever[1][1], 0},
                        .reduced_radius = reduced_radius,
                        .reduced_mass = reduced_mass / (place->gain * place->gain),
                        .gain = place->gain,
                        .gain_middle = place->gain};
}

/// Two outlines; velocity: of the second centre relative to the first. Rates are not set.
SCREE_INLINE kinematics rounded_pair(const scree_core core[2], const double apart[2], const double velocity[2],
                                     const double spin[2], double reduced_radius, double reduced_mass, double step)
{
    scree_features features;
    if (!scree_features_find(core, apart, &features)) return rounded_none();
    if (features.crossed) {
        kinematics m = rounded_none();
        m.overlap = INFINITY;
        return m;
    }
    rounded_sums sums[2] = {{0}};
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < features.count[s]; k++) rounded_add(&sums[s], &features.of[s][k]);
    const rounded_place now = rounded_resultant(sums, apart);
    kinematics m = rounded_lie(&now, reduced_radius, reduced_mass);
    if (!(step > 0)) return m;
    const double half = 0.5 * step, turn[2] = {half * spin[0], half * spin[1]};
    const double there[2] = {apart[0] - half * velocity[0], apart[1] - half * velocity[1]};
    const double back[2] = {-there[0], -there[1]};
    sums[0] = rounded_sums_before(&features, 0, &core[0], &core[1], there, turn[0], turn[1]);
    sums[1] = rounded_sums_before(&features, 1, &core[1], &core[0], back, turn[1], turn[0]);
    if (!(sums[0].weight + sums[1].weight > 0)) return m; // they have just met
    const rounded_place before = rounded_resultant(sums, there);
    rounded_move(&m, &now, &before);
    return m;
}

SCREE_INLINE kinematics rounded_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const scree_core core[2] = {rounded_core(first), rounded_core(second)};
    const double apart[2] = {second->position.x - first->position.x, second->position.y - first->position.y};
    const double velocity[2] = {second->velocity.x - first->velocity.x, second->velocity.y - first->velocity.y};
    const double spin[2] = {first->spin.x, second->spin.x};
    kinematics m = rounded_pair(core, apart, velocity, spin,
                                core[0].rounding * core[1].rounding / (core[0].rounding + core[1].rounding),
                                first->mass * second->mass / (first->mass + second->mass), step);
    kinematics_from_levers(dimension, &m, first, second, step);
    kinematics_gain(dimension, &m);
    return m;
}

/// Sums over the corners in range of a half-plane, whose distance is `distance` from the centre, with u towards it, as
/// features have it whose points lie from the first centre; turn: half a step back.
SCREE_INLINE rounded_sums rounded_plane_sums(const scree_core *core, const double normal[3], double distance,
                                             double turn)
{
    const double centre[1][2] = {{0, 0}};
    const double(*corner)[2] = core->count > 0 ? core->corner : centre;
    rounded_sums sums = {0};
    for (int k = 0; k < (core->count > 0 ? core->count : 1); k++) {
        double place[2];
        rounded_before(corner[k], turn, place);
        const double height = distance + (normal[0] * place[0] + normal[1] * place[1]);
        scree_feature f = {.depth = core->rounding - height, .normal = {-normal[0], -normal[1]}};
        if (!(f.depth > 0)) continue;
        for (int i = 0; i < 2; i++) f.point[i] = place[i] - 0.5 * (height + core->rounding) * normal[i];
        rounded_add(&sums, &f);
    }
    return sums;
}

/// The velocity of the body is that in the frame of the wall.
SCREE_INLINE kinematics rounded_beside(const bodies *body, const double normal[3], double distance, double step)
{
    const scree_core core = rounded_core(body);
    const double none[2] = {0, 0}, half = 0.5 * step;
    rounded_sums sums[2] = {{0}, rounded_plane_sums(&core, normal, distance, 0)};
    if (!(sums[1].weight > 0)) return rounded_none();
    const rounded_place now = rounded_resultant(sums, none);
    kinematics m = rounded_lie(&now, core.rounding, body->mass);
    if (!(step > 0)) return m;
    const double closing = body->velocity.x * normal[0] + body->velocity.y * normal[1];
    sums[1] = rounded_plane_sums(&core, normal, distance - half * closing, half * body->spin.x);
    if (!(sums[1].weight > 0)) return m;
    const rounded_place before = rounded_resultant(sums, none);
    rounded_move(&m, &now, &before);
    return m;
}

/// Beside a solid wall, whose centroid lies `apart` from the centre of the body. The velocity of the body is that in
/// the frame of the wall.
SCREE_INLINE kinematics rounded_against(const bodies *body, const scree_polygon *wall, const double apart[2],
                                        double step)
{
    const scree_core core[2] = {rounded_core(body),
                                {.corner = wall->corner, .count = wall->count, .bound = wall->bound, .rounding = 0}};
    const double velocity[2] = {-body->velocity.x, -body->velocity.y}, spin[2] = {body->spin.x, 0};
    return rounded_pair(core, apart, velocity, spin, core[0].rounding, body->mass, step);
}

SCREE_INLINE lanes rounded_reach(const bodies *body)
{
    return body->radius;
}

#endif
