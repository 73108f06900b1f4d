/// Overlap of two convex polygons: area, chord and point (shape/overlap.h), from their corners and nothing else.
///
/// All that is decided is on which side of an edge a corner of the other body lies (shape/side.h): which edges cross,
/// in which order the crossings follow one another, who is inside. So the outline of the overlap closes, however near
/// the polygons are to a degenerate pose. A corner exactly on the line of an edge is decided as if the first body were
/// shifted by an infinitesimal (epsilon, epsilon^2): one generic pose, for all corners and edges alike. Places of
/// crossings are rounded: along its edge a crossing is wrong by some 1e-16 R / sin(angle of the edges), the area by
/// some 1e-16 R times its outline. What is thinner than that may count as no overlap.
///
/// Coordinates are relative to the centre of the body that comes first in a fixed order of the pose (its x is less; if
/// equal, its y; if equal, its corners), so exchange gives the same bits with the opposite sign.
///
/// Method: bounding circles; the edge that separated the pair when it was last looked at (`hint`, which can only
/// reject, and only for certain); projections on the line of the centres, which leave the few edges of either that can
/// cross; of these, corners against edges. Cost: linear in the corners, plus (edges that are left)^2, which for grains
/// that touch are 2 to 4 of each, whatever the number of corners. Of pairs that move little runs know from earlier steps
/// which edges cross (polygon_hint.h).
///
/// Limits: shape/side.h, with R the bounding radius and a distance in place of coordinates.
#ifndef SCREE_SHAPE_POLYGON_PAIR_H
#define SCREE_SHAPE_POLYGON_PAIR_H

#include "shape/overlap.h"
#include "shape/polygon_crossings.h"

/// Polygons without crossings: whether one lies inside the other (then area, flags and arm[0] are set). If not, a
/// separating edge, the one with the widest gap: edge + 1 of the first, -(edge + 1) of the second, 0 if none is for
/// certain.
bool scree_polygon_uncrossed(const scree_polygon_pair *pair, const double apart[2], int *hint, scree_overlap *overlap);

/// Distance of the other body from the line of an edge, negative where it reaches behind it [m].
double scree_polygon_gap(const scree_polygon_pair *pair, int body, int edge);

/// Order of two polygons whose centres lie in one place: negative if the first comes first, 0 if they are the same.
int scree_polygon_compare(const scree_polygon *first, const scree_polygon *second);

/// The overlap of a polygon with itself: one inside the other.
bool scree_polygon_same(const scree_polygon *polygon, scree_overlap *overlap);

/// Where edge i of the first body crosses edge j of the second.
SCREE_INLINE void scree_polygon_crossing(const scree_polygon_pair *pair, int i, int j, double place[2])
{
    const double *s = pair->corner[0][i], *e = pair->corner[0][scree_next_corner(pair->count[0], i)];
    const double *a = pair->corner[1][j], *b = pair->corner[1][scree_next_corner(pair->count[1], j)];
    // The two have different signs, or one is zero, so the share is between 0 and 1.
    double from = scree_side(a, b, s), to = scree_side(a, b, e), share = from / (from - to);
    for (int k = 0; k < 2; k++) place[k] = s[k] + share * (e[k] - s[k]);
}

/// Twice the area that the way from `last` to `next` sweeps, seen from `origin`.
SCREE_INLINE double scree_outline_sweep(const double origin[2], const double last[2], const double next[2])
{
    return (last[0] - origin[0]) * (next[1] - origin[1]) - (last[1] - origin[1]) * (next[0] - origin[0]);
}

/// The next of the edges given as bits, from `edge` on, which counts.
SCREE_INLINE int scree_next_edge(uint32_t edges, int edge)
{
    uint32_t later = edges >> edge << edge;
    return __builtin_ctz(later ? later : edges);
}

/// Sweeps along the corners that lie between two crossings, from the end of edge `from` to the begin of edge `to`.
SCREE_INLINE double scree_sweep_corners(int count, const double (*corner)[2], int from, int to, const double origin[2],
                                        const double *last, const double *end)
{
    double twice = 0;
    for (int k = from; k != to;) {
        k = scree_next_corner(count, k);
        twice += scree_outline_sweep(origin, last, corner[k]);
        last = corner[k];
    }
    return twice + scree_outline_sweep(origin, last, end);
}

/// Area, chord and line of two polygons whose outlines cross. The outline of the overlap is, for each piece, corners of
/// the first from where it goes in to where it comes out, then corners of the second up to the next piece.
SCREE_INLINE void scree_polygon_assemble(const scree_polygon_pair *pair, const scree_crossings *crossings,
                                         scree_overlap *overlap)
{
    double end[2 * SCREE_POLYGON_CORNERS][2], twice = 0;
    int pieces = 0, edge[2 * SCREE_POLYGON_CORNERS];
    for (uint32_t rest = crossings->entering; rest; rest &= rest - 1, pieces++) {
        int i = __builtin_ctz(rest), o = scree_next_edge(crossings->leaving, i);
        scree_polygon_crossing(pair, i, crossings->in[i], end[2 * pieces]);
        scree_polygon_crossing(pair, o, crossings->out[o], end[2 * pieces + 1]);
        edge[2 * pieces] = i;
        edge[2 * pieces + 1] = o;
    }
    for (int k = 0; k < pieces; k++) {
        int next = k + 1 < pieces ? k + 1 : 0;
        const double *in = end[2 * k], *out = end[2 * k + 1];
        twice += scree_sweep_corners(pair->count[0], pair->corner[0], edge[2 * k], edge[2 * k + 1], end[0], in, out);
        twice += scree_sweep_corners(pair->count[1], pair->corner[1], crossings->out[edge[2 * k + 1]],
                                     crossings->in[edge[2 * next]], end[0], out, end[2 * next]);
    }
    for (int k = 0; k < 2; k++) {
        const int i = edge[k], j = (k == 0 ? crossings->in : crossings->out)[i];
        const double *s = pair->corner[0][i], *e = pair->corner[0][scree_next_corner(pair->count[0], i)];
        const double *a = pair->corner[1][j], *b = pair->corner[1][scree_next_corner(pair->count[1], j)];
        for (int c = 0; c < 2; c++) {
            overlap->edge[k][0][c] = e[c] - s[c];
            overlap->edge[k][1][c] = b[c] - a[c];
        }
    }
    overlap->area = twice / 2;
    scree_overlap_find_line(overlap, pieces, (const double(*)[2])end, false);
}

/// The overlap of two polygons, the centre of the second `apart` [m] from that of the first. False: none, `overlap` is
/// not set. hint: in and out, an edge of these two bodies as scree_polygon_uncrossed tells it, or 0; the result does
/// not depend on it. A pose that is not a number counts as inside, so that it is noticed.
SCREE_INLINE bool scree_polygon_pair_overlap(const scree_polygon *first, const scree_polygon *second,
                                             const double apart[2], int *hint, scree_overlap *overlap)
{
    double reach = first->bound + second->bound;
    if (apart[0] * apart[0] + apart[1] * apart[1] > reach * reach * (1 + 0x1p-40)) return false;
    bool later = apart[0] < 0 || (apart[0] == 0 && apart[1] < 0);
    if (apart[0] == 0 && apart[1] == 0) {
        int order = scree_polygon_compare(first, second);
        if (order == 0) return scree_polygon_same(first, overlap);
        later = order > 0;
    }
    const scree_polygon *body[2] = {later ? second : first, later ? first : second};
    const double way[2] = {later ? -apart[0] : apart[0], later ? -apart[1] : apart[1]};
    double shifted[SCREE_POLYGON_CORNERS][2];
    const scree_polygon_pair pair = {{body[0]->count, body[1]->count},
                                     {body[0]->corner, (const double(*)[2])shifted},
                                     {body[0]->bound, body[1]->bound}};
    int edge = later ? -*hint : *hint;
    scree_crossings crossings;
    for (int k = 0; k < body[1]->count; k++)
        for (int i = 0; i < 2; i++) shifted[k][i] = body[1]->corner[k][i] + way[i];
    if (!scree_polygon_look(&pair, way, edge, &crossings)) return false;
    overlap->flags = 0;
    if (__builtin_popcount(crossings.entering) != __builtin_popcount(crossings.leaving)) crossings.entering = 0;
    if (crossings.entering == 0) {
        bool inside = scree_polygon_uncrossed(&pair, way, &edge, overlap);
        *hint = later ? -edge : edge;
        if (!inside) return false;
    } else {
        *hint = 0;
        scree_polygon_assemble(&pair, &crossings, overlap);
        if (overlap->area <= 0) return false;
    }
    const double radius[2] = {body[0]->radius, body[1]->radius};
    scree_overlap_finish(overlap, way, radius, pair.bound);
    if (later) scree_overlap_exchange(overlap);
    return true;
}

#endif
