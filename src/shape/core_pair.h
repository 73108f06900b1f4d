/// Closest features of two cores: convex polygons whose outlines lie a rounding outside of them, and discs, whose core
/// is their centre.
///
/// Every corner of one core has one closest point on the other, at a distance D. It counts while D is less than the sum
/// R of the two roundings, with the depth d = R - D along u = (corner - point) / D; so do the corners of the other core
/// against the first. Two cores that are apart are closest at a corner of one of them, so none is missed. Of
/// a disc only its centre is asked, which is exact: a disc has one closest point anywhere.
///     overlap     delta = sqrt(sum d^2),       gradient of it: sum d u / delta = g n
/// D is a continuous function of the pose with a continuous gradient as long as cores are apart; d^2 is one where a
/// corner comes into range, too. So delta^2 is a potential whose gradient is continuous: where edges turn through
/// parallel, a corner passes an edge or a corner meets a corner the force is.
///
/// The features are held by bodies: `side` 0 has the corners of the first core and points of the second, side 1 the
/// other way round. Places are relative to the centre of the body that has the points, so exchange of the bodies gives
/// the same bits.
///
/// Cost: two products a corner for those that are out of reach, else a product and some an edge.
#ifndef SCREE_SHAPE_CORE_PAIR_H
#define SCREE_SHAPE_CORE_PAIR_H

#include "shape/polygon.h"

#include <math.h>
#include <stddef.h>

/// A core as it lies; corners are relative to the centre of its body.
typedef struct scree_core {
    const double (*corner)[2]; ///< m
    int count;                 ///< 0 of a disc
    double bound;              ///< m, no corner is farther from the centre
    double rounding;           ///< m, from the core to the outline; the radius of a disc
} scree_core;

/// A corner of one core against the other.
typedef struct scree_feature {
    double corner[2]; ///< m, from the centre of its own body
    int edge;         ///< of the other core, on which its closest point lies; of none beside a disc
    double depth;     ///< m, d
    double normal[2]; ///< u
    double point[2];  ///< m, in the middle of the overlap, from the centre of the body with the closest point
} scree_feature;

typedef struct scree_features {
    int count[2]; ///< of each side
    scree_feature of[2][SCREE_POLYGON_CORNERS];
    bool crossed; ///< cores meet: nothing can be said
} scree_features;

/// Closest point of an edge from a to b to p: its squared distance.
SCREE_INLINE double scree_segment_closest(const double a[2], const double b[2], const double p[2], double point[2])
{
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {p[0] - a[0], p[1] - a[1]};
    double share = (from[0] * along[0] + from[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
    share = share > 0 ? share < 1 ? share : 1 : 0;
    point[0] = a[0] + share * along[0];
    point[1] = a[1] + share * along[1];
    const double apart[2] = {p[0] - point[0], p[1] - point[1]};
    return apart[0] * apart[0] + apart[1] * apart[1];
}

/// Fills depth, normal and point from a corner and its closest point, both from the centre of the body that has the
/// closest point; own, other: roundings of the body with the corner and of that with the point. False: out of range.
SCREE_INLINE bool scree_feature_place(const double corner[2], const double closest[2], double square, double own,
                                      double other, scree_feature *f)
{
    const double distance = sqrt(square);
    f->depth = own + other - distance;
    if (!(f->depth > 0)) return false;
    const double inverse = 1 / distance, shift = 0.5 * (other - own);
    for (int k = 0; k < 2; k++) {
        f->normal[k] = (corner[k] - closest[k]) * inverse;
        f->point[k] = 0.5 * (corner[k] + closest[k]) + shift * f->normal[k];
    }
    return true;
}

/// The point of a core nearest to p outside of it, and its edge. Returns the squared distance; 0: p is inside or on the
/// core; INFINITY: it is farther than `reach`, for certain.
SCREE_INLINE double scree_core_closest(const scree_core *core, const double p[2], double reach, double point[2],
                                       int *edge)
{
    double least = INFINITY, square = reach * reach;
    *edge = 0;
    if (core->count == 0) {
        point[0] = point[1] = 0;
        return p[0] * p[0] + p[1] * p[1];
    }
    bool inside = true;
    for (int k = 0, last = core->count - 1; k < core->count; last = k++) {
        const double *a = core->corner[last], *b = core->corner[k];
        const double along[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {p[0] - a[0], p[1] - a[1]};
        const double side = along[0] * from[1] - along[1] * from[0];
        if (side > 0) continue;
        inside = false;
        // Beyond the line of an edge by more than the reach.
        if (side * side > square * (along[0] * along[0] + along[1] * along[1])) return INFINITY;
        double place[2];
        const double here = scree_segment_closest(a, b, p, place);
        if (!(here < least)) continue;
        least = here;
        *edge = last;
        point[0] = place[0];
        point[1] = place[1];
    }
    return inside ? 0 : least;
}

/// Farthest reach of a core along `direction`, which need not be a unit vector.
SCREE_INLINE double scree_core_support(const scree_core *core, const double direction[2])
{
    double most = core->count > 0 ? -(double)INFINITY : 0;
    for (int k = 0; k < core->count; k++) {
        const double here = core->corner[k][0] * direction[0] + core->corner[k][1] * direction[1];
        most = here > most ? here : most;
    }
    return most;
}

/// Corners of `one` against `other`, whose centre is `shift` away from that of `one`.
SCREE_INLINE void scree_features_of(const scree_core *one, const scree_core *other, const double shift[2], int side,
                                    scree_features *features)
{
    const double reach = one->rounding + other->rounding, far = other->bound + reach;
    const double centre[1][2] = {{0, 0}};
    const double(*corner)[2] = one->count > 0 ? one->corner : centre;
    int count = 0;
    for (int k = 0; k < (one->count > 0 ? one->count : 1); k++) {
        const double place[2] = {corner[k][0] - shift[0], corner[k][1] - shift[1]};
        if (place[0] * place[0] + place[1] * place[1] > far * far) continue;
        scree_feature *f = &features->of[side][count];
        double point[2] = {0, 0};
        const double square = scree_core_closest(other, place, reach, point, &f->edge);
        if (!(square > 1e-24 * (reach * reach))) features->crossed = true;
        if (features->crossed) return;
        if (!(square < reach * reach) || !scree_feature_place(place, point, square, one->rounding, other->rounding, f))
            continue;
        f->corner[0] = corner[k][0];
        f->corner[1] = corner[k][1];
        count++;
    }
    features->count[side] = count;
}

/// Whether the line through the closest point of the deepest feature, across its normal, parts the cores: it does
/// wherever they are apart. one: the core that has the corner; reach: of both.
SCREE_INLINE bool scree_feature_parts(const scree_feature *f, const scree_core *one, double reach)
{
    const double back[2] = {-f->normal[0], -f->normal[1]};
    const double own = f->corner[0] * back[0] + f->corner[1] * back[1];
    return scree_core_support(one, back) - own < reach - f->depth;
}

/// Whether an edge of `one` has all of `other` outside: an exact test of cores that no corner brings together.
static inline bool scree_core_edge_parts(const scree_core *one, const scree_core *other, const double shift[2])
{
    for (int k = 0, last = one->count - 1; k < one->count; last = k++) {
        const double *a = one->corner[last], *b = one->corner[k];
        const double outward[2] = {b[1] - a[1], a[0] - b[0]};
        const double back[2] = {-outward[0], -outward[1]};
        const double gap = (shift[0] - a[0]) * outward[0] + (shift[1] - a[1]) * outward[1];
        if (gap - scree_core_support(other, back) > 0) return true;
    }
    return false;
}

/// Cores that no corner brings together: whether they cross, as two bars do.
static inline bool scree_cores_cross(const scree_core core[2], const double apart[2])
{
    const double back[2] = {-apart[0], -apart[1]};
    if (core[0].count == 0 || core[1].count == 0) return false;
    return !scree_core_edge_parts(&core[0], &core[1], apart) && !scree_core_edge_parts(&core[1], &core[0], back);
}

/// The features of two bodies, the second `apart` from the first. False: they do not touch.
SCREE_INLINE bool scree_features_find(const scree_core core[2], const double apart[2], scree_features *features)
{
    const double back[2] = {-apart[0], -apart[1]}, reach = core[0].rounding + core[1].rounding;
    const double square = apart[0] * apart[0] + apart[1] * apart[1];
    const double gap = square - (scree_core_support(&core[0], apart) + scree_core_support(&core[1], back));
    features->crossed = false;
    features->count[0] = features->count[1] = 0;
    if (gap > 0 && gap * gap > reach * reach * square) return false;
    // Of two discs the one that both orders of the pair agree on.
    const bool round[2] = {core[0].count == 0, core[1].count == 0};
    const bool order = apart[0] > 0 || (apart[0] == 0 && apart[1] > 0);
    if (round[0] ? !round[1] || order : !round[1]) scree_features_of(&core[0], &core[1], apart, 0, features);
    if (features->crossed) return true;
    if (round[1] ? !round[0] || !order : !round[0]) scree_features_of(&core[1], &core[0], back, 1, features);
    if (features->crossed) return true;
    const scree_feature *deepest = NULL;
    int side = 0;
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < features->count[s]; k++)
            if (!deepest || features->of[s][k].depth > deepest->depth) {
                deepest = &features->of[s][k];
                side = s;
            }
    features->crossed =
        deepest ? !scree_feature_parts(deepest, &core[side], reach) : !(gap > 0) && scree_cores_cross(core, apart);
    return deepest != NULL || features->crossed;
}

#endif
