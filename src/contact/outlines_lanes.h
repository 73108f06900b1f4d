/// Outlines in lanes: what two polygons share whose outlines cross twice, by the edges that cross. The arithmetic is
/// that of scree_polygon_pair_overlap, operation by operation, so the bits are the same. Only for kernels.
#ifndef SCREE_CONTACT_OUTLINES_LANES_H
#define SCREE_CONTACT_OUTLINES_LANES_H

#include "contact/outlines_share.h"

#if SCREE_LANES > 1

#include "contact/rows.h"

/// What has been found of the pairs of a group, one by one.
typedef struct outlines_found {
    const double (*posed)[2]; ///< corners, relative to the centres of their bodies
    lanes_bits twice;         ///< mask: they cross twice; of the others all is in `share`
    lanes_bits corner[2];     ///< the first of each body
    lanes_bits count[2];      ///< its corners
    lanes_bits edge[2][2];    ///< where the first goes in, and where it comes out: edge of the first, of the second
    outlines_share share;
} outlines_found;

/// A lane without a pair, or whose pair has not been found yet.
SCREE_INLINE void outlines_found_nothing(outlines_found *f, int k)
{
    f->twice[k] = 0;
    outlines_share_put(&f->share, k, NULL);
    for (int b = 0; b < 2; b++) {
        f->corner[b][k] = f->edge[0][b][k] = f->edge[1][b][k] = 0;
        f->count[b][k] = 1;
        outlines_share_body(&f->share, k, b, 1, 1);
    }
}

SCREE_INLINE lanes_bits lanes_bits_select(lanes_bits mask, lanes_bits a, lanes_bits b)
{
    return (mask & a) | (~mask & b);
}

/// scree_next_corner
SCREE_INLINE lanes_bits next_corner(lanes_bits count, lanes_bits k)
{
    return (k + 1) & (lanes_bits)(k + 1 < count);
}

typedef double row2 __attribute__((vector_size(16), aligned(8), may_alias));

/// Two corners of a body of each lane.
SCREE_INLINE columns load_corners(const double (*posed)[2], lanes_bits from, lanes_bits to)
{
    size_t place[2][SCREE_LANES];
    row4 row[SCREE_LANES];
    memcpy(place[0], &from, sizeof from);
    memcpy(place[1], &to, sizeof to);
    LANE_LOOP
    {
        const row2 one = *(const row2 *)posed[place[0][k]], other = *(const row2 *)posed[place[1][k]];
        row[k] = SHUFFLE(one, other, 0, 1, 2, 3);
    }
    return columns_of_rows(row);
}

/// An edge of a body of each lane.
typedef struct edge_lanes {
    lanes begin[2], end[2];
} edge_lanes;

SCREE_INLINE edge_lanes load_edge(const outlines_found *f, lanes_bits first, lanes_bits count, lanes_bits edge,
                                  const lanes *by)
{
    const columns c = load_corners(f->posed, first + edge, first + next_corner(count, edge));
    if (!by) return (edge_lanes){{c.c0, c.c1}, {c.c2, c.c3}};
    return (edge_lanes){{c.c0 + by[0], c.c1 + by[1]}, {c.c2 + by[0], c.c3 + by[1]}};
}

/// scree_side, where it is known not to be near zero.
SCREE_INLINE lanes side_of(const edge_lanes *e, const lanes c[2])
{
    const lanes left = (e->end[0] - e->begin[0]) * (c[1] - e->begin[1]);
    const lanes right = (e->end[1] - e->begin[1]) * (c[0] - e->begin[0]);
    return left - right;
}

/// scree_outline_sweep
SCREE_INLINE lanes outline_sweep(const lanes origin[2], const lanes last[2], const lanes next[2])
{
    return (last[0] - origin[0]) * (next[1] - origin[1]) - (last[1] - origin[1]) * (next[0] - origin[0]);
}

/// A body of each lane: its first corner, how many it has, and by how much they are shifted.
typedef struct body_lanes {
    lanes_bits corner, count;
    const lanes *by; ///< NULL: not
} body_lanes;

/// scree_sweep_corners
SCREE_INLINE lanes sweep_corners(const outlines_found *f, const body_lanes *body, lanes_bits from, lanes_bits to,
                                 const lanes origin[2], const lanes begin[2], const lanes end[2])
{
    lanes twice = lanes_all(0), last[2] = {begin[0], begin[1]};
    lanes_bits going = f->twice & (lanes_bits)(from != to);
    while (lanes_ones(going)) {
        from = next_corner(body->count, from);
        const columns c = load_corners(f->posed, body->corner + from, body->corner + from);
        lanes next[2] = {c.c0, c.c1};
        if (body->by)
            for (int i = 0; i < 2; i++) next[i] += body->by[i];
        twice += lanes_keep(going, outline_sweep(origin, last, next));
        for (int i = 0; i < 2; i++) last[i] = lanes_select(going, next[i], last[i]);
        going &= (lanes_bits)(from != to);
    }
    return twice + outline_sweep(origin, last, end);
}

/// scree_overlap_finish: what cannot be used.
SCREE_INLINE lanes_bits is_useless(const lanes arm[2], lanes radius, lanes bound)
{
    const lanes square = arm[0] * arm[0] + arm[1] * arm[1];
    const lanes near = SCREE_OVERLAP_NEAR * radius, far = bound * (1 + 1e-9);
    return ~lanes_at_or_below(near * near, square) | ~lanes_at_or_below(square, far * far);
}

/// What those share that cross twice, the first body being that which comes first in the order of the pose.
/// way: from the first centre to the second.
SCREE_INLINE void cross_twice(const outlines_found *f, const body_lanes body[2], lanes_bits edge[2][2],
                              const lanes way[2], const lanes radius[2], const lanes bound[2], outlines_share *s)
{
    lanes end[2][2];
    for (int k = 0; k < 2; k++) {
        const edge_lanes one = load_edge(f, body[0].corner, body[0].count, edge[k][0], NULL);
        const edge_lanes other = load_edge(f, body[1].corner, body[1].count, edge[k][1], way);
        const lanes from = side_of(&other, one.begin), to = side_of(&other, one.end), share = from / (from - to);
        for (int i = 0; i < 2; i++) {
            s->edge[k][0][i] = one.end[i] - one.begin[i];
            s->edge[k][1][i] = other.end[i] - other.begin[i];
            end[k][i] = one.begin[i] + share * s->edge[k][0][i];
        }
    }
    lanes twice = lanes_all(0);
    twice += sweep_corners(f, &body[0], edge[0][0], edge[1][0], end[0], end[0], end[1]);
    twice += sweep_corners(f, &body[1], edge[1][1], edge[0][1], end[0], end[1], end[0]);
    s->area = twice / 2.0;
    s->meet = f->twice & ~lanes_at_or_below(s->area, lanes_all(0));
    s->chord[0] = lanes_all(0) + (end[1][1] - end[0][1]);
    s->chord[1] = -(lanes_all(0) + (end[1][0] - end[0][0]));
    for (int i = 0; i < 2; i++) {
        s->arm[0][i] = (end[0][i] + end[1][i]) / 2.0;
        s->arm[1][i] = s->arm[0][i] - way[i];
    }
    s->twice = f->twice;
    s->useless = is_useless(s->arm[0], radius[0], bound[0]) | is_useless(s->arm[1], radius[1], bound[1]);
}

/// Exchanges two numbers of the lanes of a mask.
SCREE_INLINE void exchange_lanes(lanes_bits mask, lanes *a, lanes *b)
{
    const lanes kept = *a;
    *a = lanes_select(mask, *b, kept);
    *b = lanes_select(mask, kept, *b);
}

/// scree_overlap_exchange
SCREE_INLINE void exchange_share(lanes_bits mask, outlines_share *s)
{
    for (int i = 0; i < 2; i++) {
        exchange_lanes(mask, &s->edge[0][0][i], &s->edge[1][1][i]);
        exchange_lanes(mask, &s->edge[0][1][i], &s->edge[1][0][i]);
        exchange_lanes(mask, &s->arm[0][i], &s->arm[1][i]);
        s->chord[i] = lanes_select(mask, -s->chord[i], s->chord[i]);
    }
}

/// Two crossings are worked out and put to the rest. apart: from the first centre to the second; given: bounding radii.
SCREE_INLINE void outlines_work_out(const outlines_found *f, const lanes apart[2], const lanes given[2],
                                    outlines_share *s)
{
    if (!lanes_ones(f->twice)) { // among discs alone there are no corners
        *s = f->share;
        return;
    }
    const lanes_bits later = lanes_below(apart[0], lanes_all(0)) |
                             (~lanes_differ(apart[0], lanes_all(0)) & lanes_below(apart[1], lanes_all(0)));
    lanes way[2], radius[2] = {f->share.radius[0], f->share.radius[1]}, bound[2] = {given[0], given[1]};
    lanes_bits edge[2][2];
    exchange_lanes(later, &radius[0], &radius[1]);
    exchange_lanes(later, &bound[0], &bound[1]);
    for (int i = 0; i < 2; i++) {
        way[i] = lanes_select(later, -apart[i], apart[i]);
        for (int b = 0; b < 2; b++) edge[i][b] = lanes_bits_select(later, f->edge[1 - i][1 - b], f->edge[i][b]);
    }
    const body_lanes body[2] = {{lanes_bits_select(later, f->corner[1], f->corner[0]),
                                 lanes_bits_select(later, f->count[1], f->count[0]), NULL},
                                {lanes_bits_select(later, f->corner[0], f->corner[1]),
                                 lanes_bits_select(later, f->count[0], f->count[1]), way}};
    cross_twice(f, body, edge, way, radius, bound, s);
    exchange_share(later, s);
    outlines_share_keep(f->twice, s, &f->share);
}

#endif

#endif
