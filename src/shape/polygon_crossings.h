/// Which edges of two convex polygons cross, and what tells beforehand that none does: the decisions of
/// shape/polygon_pair.h.
#ifndef SCREE_SHAPE_POLYGON_CROSSINGS_H
#define SCREE_SHAPE_POLYGON_CROSSINGS_H

#include "base/inline.h"
#include "shape/polygon.h"
#include "shape/side.h"

#include <stdint.h>

/// Two polygons in the coordinates of the first.
typedef struct scree_polygon_pair {
    int count[2];
    const double (*corner[2])[2];
    double bound[2];
} scree_polygon_pair;

static inline int scree_next_corner(int count, int k)
{
    return k + 1 < count ? k + 1 : 0;
}

/// A bit for each corner that is there.
SCREE_INLINE uint32_t scree_corner_bits(int count)
{
    return UINT32_MAX >> (32 - count);
}

/// The bit of the next corner, at the place of each corner.
SCREE_INLINE uint32_t scree_bits_of_next(uint32_t bits, int count)
{
    return bits >> 1 | (bits & 1) << (count - 1);
}

/// Edges with an end among the corners given as bits; an edge has the number of its first end.
SCREE_INLINE uint32_t scree_edges_at(uint32_t corners, int count)
{
    return corners | scree_bits_of_next(corners, count);
}

/// Both ends of the edges given as bits.
SCREE_INLINE uint32_t scree_ends_of(uint32_t edges, int count)
{
    return (edges | edges << 1 | edges >> (count - 1)) & scree_corner_bits(count);
}

/// Crossings by the edge of the first body: the edge of the second, where the first outline goes in and where it comes
/// out.
typedef struct scree_crossings {
    uint32_t entering, leaving; ///< edges of the first body, as bits
    uint8_t in[SCREE_POLYGON_CORNERS], out[SCREE_POLYGON_CORNERS];
} scree_crossings;

/// Side of corner c of the other body to the edge a b, decided. `second`: the edge belongs to the second body.
SCREE_INLINE bool scree_is_left(const double a[2], const double b[2], const double c[2], bool second)
{
    double side = scree_side(a, b, c);
    if (side != 0) return side > 0;
    bool sinks = b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
    return sinks == second;
}

/// Whether edge `edge` of body `body` has all corners of the other one strictly on its outer side, for certain.
SCREE_INLINE bool scree_edge_separates(const scree_polygon_pair *pair, int body, int edge)
{
    const double *a = pair->corner[body][edge];
    const double *b = pair->corner[body][scree_next_corner(pair->count[body], edge)];
    int outside = 1;
    for (int k = 0; k < pair->count[1 - body]; k++) outside &= scree_is_right(a, b, pair->corner[1 - body][k]);
    return outside;
}

/// Larger than the error of a projection on the line of the centres.
SCREE_INLINE double scree_projection_margin(const scree_polygon_pair *pair, const double apart[2])
{
    double extent = fabs(apart[0]) + fabs(apart[1]);
    return 0x1p-49 * extent * (pair->bound[0] + pair->bound[1] + extent);
}

/// Corners as bits that the projections on the line of the centres leave; false: they separate the bodies.
SCREE_INLINE bool scree_polygon_select(const scree_polygon_pair *pair, const double apart[2], uint32_t near[2])
{
    double projection[2][SCREE_POLYGON_CORNERS], reach = 0, least = 0;
    for (int b = 0; b < 2; b++)
        for (int k = 0; k < pair->count[b]; k++) {
            double p = pair->corner[b][k][0] * apart[0] + pair->corner[b][k][1] * apart[1];
            projection[b][k] = p;
            if (b == 0 && (k == 0 || p > reach)) reach = p;
            if (b == 1 && (k == 0 || p < least)) least = p;
        }
    const double margin = scree_projection_margin(pair, apart);
    if (reach < least - margin) return false;
    near[0] = near[1] = 0;
    for (int k = 0; k < pair->count[0]; k++) near[0] |= (uint32_t) !(projection[0][k] < least - margin) << k;
    for (int k = 0; k < pair->count[1]; k++) near[1] |= (uint32_t) !(projection[1][k] > reach + margin) << k;
    return true;
}

/// Finds the edges that cross. An edge of a convex body crosses another such body twice at most, first in, then out.
SCREE_INLINE void scree_polygon_cross(const scree_polygon_pair *pair, const uint32_t near[2],
                                      scree_crossings *crossings)
{
    const double(*p)[2] = pair->corner[0], (*q)[2] = pair->corner[1];
    int n = pair->count[0], m = pair->count[1];
    const uint32_t p_edges = scree_edges_at(near[0], n), q_edges = scree_edges_at(near[1], m);
    const uint32_t p_ends = scree_ends_of(p_edges, n);
    crossings->entering = crossings->leaving = 0;
    for (uint32_t js = q_edges; js; js &= js - 1) {
        int j = __builtin_ctz(js);
        const double *a = q[j], *b = q[scree_next_corner(m, j)];
        uint32_t left = 0;
        for (uint32_t is = p_ends; is; is &= is - 1) {
            int i = __builtin_ctz(is);
            left |= (uint32_t)scree_is_left(a, b, p[i], true) << i;
        }
        // Edges whose ends lie on different sides of the line of edge j cross it if its ends do so, too.
        for (uint32_t is = (left ^ scree_bits_of_next(left, n)) & p_edges; is; is &= is - 1) {
            int i = __builtin_ctz(is);
            const double *s = p[i], *e = p[scree_next_corner(n, i)];
            if (scree_is_left(s, e, a, false) == scree_is_left(s, e, b, false)) continue;
            bool leaves = left >> i & 1;
            (leaves ? crossings->out : crossings->in)[i] = (uint8_t)j;
            *(leaves ? &crossings->leaving : &crossings->entering) |= (uint32_t)1 << i;
        }
    }
}

/// The same, and before it whether an edge (`edge` as scree_polygon_uncrossed tells it, or 0) or the line of the
/// centres has the bodies on different sides, for certain: false.
SCREE_INLINE bool scree_polygon_look(const scree_polygon_pair *pair, const double apart[2], int edge,
                                     scree_crossings *crossings)
{
    uint32_t near[2];
    if (edge != 0 && scree_edge_separates(pair, edge < 0, (edge < 0 ? -edge : edge) - 1)) return false;
    if (!scree_polygon_select(pair, apart, near)) return false;
    scree_polygon_cross(pair, near, crossings);
    return true;
}

#endif
