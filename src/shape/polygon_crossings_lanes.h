/// shape/polygon_crossings.h in lanes: the same decisions by the same arithmetic. What lanes do not decide for certain
/// (corners on lines, what is not a number) is left to that.
///
/// Separating edges and projections are looked at eight corners at once. Where each body has eight at most, so are the
/// sides of all corners of one to each edge of the other that the projections leave, as bits; which pairs of edges
/// cross is an operation on tables of eight by eight bits then, without a branch for a corner. Of more corners those
/// few edges are left to one corner after the other. Cost: 0.6 of one after the other (docs/performance.md).
#ifndef SCREE_SHAPE_POLYGON_CROSSINGS_LANES_H
#define SCREE_SHAPE_POLYGON_CROSSINGS_LANES_H

#include "shape/polygon_crossings.h"

/// Whether each body has as many corners as one block of lanes at most.
SCREE_INLINE bool scree_lanes_few(const scree_polygon_pair *pair)
{
    return pair->count[0] <= SCREE_CORNERS_IN_LANES && pair->count[1] <= SCREE_CORNERS_IN_LANES;
}

#if SCREE_CORNER_LANES > 0

/// Blocks of corners of one body.
enum { SCREE_PAIR_BLOCKS = SCREE_POLYGON_CORNERS / SCREE_CORNERS_IN_LANES };

/// Corners of both bodies in the coordinates of the first, eight in a block.
typedef struct scree_pair_lanes {
    polygon_lanes body[2][SCREE_PAIR_BLOCKS];
} scree_pair_lanes;

/// `few`, a constant: neither body has more corners than a block.
SCREE_INLINE int scree_lanes_blocks(bool few, int count)
{
    return few ? 1 : (count + SCREE_CORNERS_IN_LANES - 1) / SCREE_CORNERS_IN_LANES;
}

/// Corners of a block from its first on.
SCREE_INLINE int scree_lanes_count(bool few, int count, int block)
{
    const int left = count - SCREE_CORNERS_IN_LANES * block;
    return few || left < SCREE_CORNERS_IN_LANES ? left : SCREE_CORNERS_IN_LANES;
}

/// second: corners of the second body relative to its own centre; `shifted` gets them relative to the first one.
SCREE_INLINE void scree_pair_lanes_load(bool few, const scree_polygon_pair *pair, const double (*second)[2],
                                        const double apart[2], double (*shifted)[2], scree_pair_lanes *both)
{
    static const double nowhere[2] = {0, 0};
    for (int k = 0; k < scree_lanes_blocks(few, pair->count[0]); k++)
        both->body[0][k] = corner_lanes_load(scree_lanes_count(few, pair->count[0], k),
                                             pair->corner[0] + SCREE_CORNERS_IN_LANES * k, nowhere, NULL);
    for (int k = 0; k < scree_lanes_blocks(few, pair->count[1]); k++)
        both->body[1][k] =
            corner_lanes_load(scree_lanes_count(few, pair->count[1], k), second + SCREE_CORNERS_IN_LANES * k, apart,
                              shifted + SCREE_CORNERS_IN_LANES * k);
}

/// Bits of the corners to the left of the line from a to b; *certain: of those for which that is sure, either way.
SCREE_INLINE uint32_t scree_lanes_left(const double a[2], const double b[2], const polygon_lanes *c, uint32_t *certain)
{
    uint32_t left = 0, right = 0;
    CORNER_VECTOR_LOOP
    {
        const corner_lanes one = (b[0] - a[0]) * (c->y[part] - a[1]), other = (b[1] - a[1]) * (c->x[part] - a[0]);
        const corner_lanes side = one - other;
        const corner_lanes error = SCREE_SIDE_ERROR * (corner_lanes_magnitude(one) + corner_lanes_magnitude(other));
        left |= corner_lanes_above(side, error) << SCREE_CORNER_LANES * part;
        right |= corner_lanes_above(-error, side) << SCREE_CORNER_LANES * part;
    }
    *certain = left | right;
    return left;
}

/// Sides of a block of corners of the other body to an edge.
SCREE_INLINE uint32_t scree_lanes_beside(const scree_polygon_pair *pair, const scree_pair_lanes *both, int body,
                                         int edge, int block, uint32_t *certain)
{
    const double(*corner)[2] = pair->corner[body];
    return scree_lanes_left(corner[edge], corner[scree_next_corner(pair->count[body], edge)],
                            &both->body[1 - body][block], certain);
}

/// scree_edge_separates
SCREE_INLINE bool scree_lanes_separate(bool few, const scree_polygon_pair *pair, const scree_pair_lanes *both, int body,
                                       int edge)
{
    const int count = pair->count[1 - body];
    uint32_t beyond = 0;
    for (int k = 0; k < scree_lanes_blocks(few, count); k++) {
        uint32_t certain, left = scree_lanes_beside(pair, both, body, edge, k, &certain);
        beyond |= scree_corner_bits(scree_lanes_count(few, count, k)) & (left | ~certain);
    }
    return beyond == 0;
}

/// Projections of a body, by block.
typedef corner_lanes scree_projections[SCREE_PAIR_BLOCKS][SCREE_CORNER_VECTORS];

/// Projections times `sense`, which is 1 or -1; returns the largest.
SCREE_INLINE double scree_lanes_project(bool few, int count, const polygon_lanes *c, const double along[2],
                                        double sense, scree_projections projection)
{
    double reach = -INFINITY;
    for (int k = 0; k < scree_lanes_blocks(few, count); k++) {
        CORNER_VECTOR_LOOP projection[k][part] = sense * (c[k].x[part] * along[0] + c[k].y[part] * along[1]);
        const double largest = corner_lanes_largest(scree_corner_bits(scree_lanes_count(few, count, k)), projection[k]);
        reach = largest > reach ? largest : reach;
    }
    return reach;
}

/// Corners whose projection is not below a limit.
SCREE_INLINE uint32_t scree_lanes_not_below(bool few, int count, scree_projections projection, double limit)
{
    const corner_lanes all = limit - (corner_lanes){0};
    uint32_t below = 0;
    for (int k = 0; k < scree_lanes_blocks(few, count); k++)
        CORNER_VECTOR_LOOP below |= corner_lanes_above(all, projection[k][part])
                                    << (SCREE_CORNERS_IN_LANES * k + SCREE_CORNER_LANES * part);
    return scree_corner_bits(count) & ~below;
}

/// scree_polygon_select, but for rounding where one body begins behind the other. Projections of the second body are
/// taken with the opposite sign, so that the largest counts of either.
SCREE_INLINE bool scree_lanes_select(bool few, const scree_polygon_pair *pair, const scree_pair_lanes *both,
                                     const double apart[2], uint32_t near[2])
{
    const int *count = pair->count;
    scree_projections first, second;
    const double reach = scree_lanes_project(few, count[0], both->body[0], apart, 1, first);
    const double back = scree_lanes_project(few, count[1], both->body[1], apart, -1, second);
    const double margin = scree_projection_margin(pair, apart);
    near[0] = scree_lanes_not_below(few, count[0], first, -back - margin);
    near[1] = scree_lanes_not_below(few, count[1], second, -reach - margin);
    // What is not a number lies on no side, and counts as near.
    return (near[0] | near[1]) != 0;
}

/// Which edges of a body have their ends on different sides of the edges `by` of the other one: a byte an edge of the
/// other one, a bit an edge of the body. *left: those whose first ends lie to the left. ends: of the edges that count;
/// false: not for certain.
SCREE_INLINE bool scree_lanes_split(const scree_polygon_pair *pair, const scree_pair_lanes *both, int body,
                                    uint32_t ends, uint32_t by, uint64_t *split, uint64_t *left)
{
    uint32_t decided = ends;
    *split = *left = 0;
    for (uint32_t rest = by; rest; rest &= rest - 1) {
        const int k = __builtin_ctz(rest);
        uint32_t certain, now = ends & scree_lanes_beside(pair, both, 1 - body, k, 0, &certain);
        decided &= certain;
        *split |= (uint64_t)(now ^ scree_bits_of_next(now, pair->count[body])) << 8 * k;
        *left |= (uint64_t)now << 8 * k;
    }
    return decided == ends;
}

/// Crossings from a table with a byte an edge of the first body, a bit an edge of the second: edges of the first.
SCREE_INLINE uint32_t scree_lanes_list(uint64_t table, uint8_t edge_of_second[SCREE_POLYGON_CORNERS])
{
    uint32_t edges = 0;
    for (; table; table &= table - 1) {
        const int at = __builtin_ctzll(table);
        edge_of_second[at / 8] = (uint8_t)(at % 8);
        edges |= (uint32_t)1 << at / 8;
    }
    return edges;
}

/// scree_polygon_cross of two blocks; false: not for certain.
SCREE_INLINE bool scree_lanes_cross(const scree_polygon_pair *pair, const scree_pair_lanes *both,
                                    const uint32_t near[2], scree_crossings *crossings)
{
    uint32_t edges[2], ends[2];
    for (int b = 0; b < 2; b++) {
        edges[b] = scree_edges_at(near[b], pair->count[b]);
        ends[b] = scree_ends_of(edges[b], pair->count[b]);
    }
    uint64_t of_first, of_second, left, unused;
    if (!scree_lanes_split(pair, both, 0, ends[0], edges[1], &of_first, &left)) return false;
    if (!scree_lanes_split(pair, both, 1, ends[1], edges[0], &of_second, &unused)) return false;
    const uint64_t cross = of_second & corner_bits_transposed(of_first), leaves = corner_bits_transposed(left);
    crossings->entering = scree_lanes_list(cross & ~leaves, crossings->in);
    crossings->leaving = scree_lanes_list(cross & leaves, crossings->out);
    return true;
}

/// scree_polygon_look
SCREE_INLINE bool scree_lanes_look(bool few, const scree_polygon_pair *pair, const scree_pair_lanes *both,
                                   const double apart[2], int edge, scree_crossings *crossings)
{
    uint32_t near[2];
    if (edge != 0 && scree_lanes_separate(few, pair, both, edge < 0, (edge < 0 ? -edge : edge) - 1)) return false;
    if (!scree_lanes_select(few, pair, both, apart, near)) return false;
    if (!few || !scree_lanes_cross(pair, both, near, crossings)) scree_polygon_cross(pair, near, crossings);
    return true;
}

#endif

/// Brings the corners of the second body, relative to its own centre, into the coordinates of the first (`shifted`,
/// which are those of the pair), and looks (scree_polygon_look). few: a constant, scree_lanes_few.
SCREE_INLINE bool scree_pair_look(bool few, const scree_polygon_pair *pair, const double (*second)[2],
                                  const double apart[2], int edge, double (*shifted)[2], scree_crossings *crossings)
{
#if SCREE_CORNER_LANES > 0
    scree_pair_lanes both;
    scree_pair_lanes_load(few, pair, second, apart, shifted, &both);
    return scree_lanes_look(few, pair, &both, apart, edge, crossings);
#else
    (void)few;
    for (int k = 0; k < pair->count[1]; k++)
        for (int i = 0; i < 2; i++) shifted[k][i] = second[k][i] + apart[i];
    return scree_polygon_look(pair, apart, edge, crossings);
#endif
}

#endif
