#include "shape/polygon_hint.h"

#include "shape/polygon_pair.h"

#include <float.h>

/// Larger than what rounding changes, over the lever and over the room.
#define ROUNDED       0x1p-40
#define ROUNDED_SHARE 0x1p-20

/// D, of a pose and the one that is kept.
static double difference(const scree_polygon_pose *pose, const scree_pair_hint *hint)
{
    const double lever = scree_polygon_lever(pose->polygon[0]->bound, pose->polygon[1]->bound);
    double shifted = 0, turned = 0;
    for (int k = 0; k < 2; k++) {
        shifted += fabs(pose->apart[k] - (double)hint->pose[k]);
        turned += fabs(pose->angle[k] - (double)hint->pose[2 + k]);
    }
    return shifted + lever * turned;
}

/// Keeps a pose with `room` [m]; returns what is left of it, 0 if nothing, and next to nothing where it holds for this
/// pose alone.
static float keep(const scree_polygon_pose *pose, double room, scree_pair_hint *hint)
{
    const double lever = scree_polygon_lever(pose->polygon[0]->bound, pose->polygon[1]->bound);
    for (int k = 0; k < 2; k++) {
        hint->pose[k] = (float)pose->apart[k];
        hint->pose[2 + k] = (float)pose->angle[k];
    }
    if (pose->fixed) return room > ROUNDED * lever ? FLT_MIN : 0;
    const double left = (room - ROUNDED * lever - difference(pose, hint)) * (1 - ROUNDED_SHARE);
    return left > FLT_MIN ? (float)left : 0;
}

static double lesser(double a, double b)
{
    return b < a ? b : a;
}

/// Two crossings are those of any pose in which no corner of the ends of edges that may cross has come to the line of
/// such an edge of the other body, and no other corner to where, along the line of the centres, the other body begins.
static double room_beside_lines(const scree_polygon_pair *pair, int body, uint32_t edges, uint32_t corners)
{
    double least = INFINITY; // squared
    for (; edges; edges &= edges - 1) {
        const int k = __builtin_ctz(edges);
        const double *a = pair->corner[body][k], *b = pair->corner[body][scree_next_corner(pair->count[body], k)];
        const double u[2] = {b[0] - a[0], b[1] - a[1]};
        double side = INFINITY;
        for (uint32_t rest = corners; rest; rest &= rest - 1) {
            const double *c = pair->corner[1 - body][__builtin_ctz(rest)];
            side = lesser(side, fabs(u[0] * (c[1] - a[1]) - u[1] * (c[0] - a[0])));
        }
        least = lesser(least, side * side / (u[0] * u[0] + u[1] * u[1]));
    }
    return sqrt(least);
}

/// How far along `way` a body ends (sense 1) or begins (-1) there, times the sense, and how far those of its corners do
/// that are not `near`; both times the length of `way`.
static void reach_along(const scree_polygon_pair *pair, int body, const double way[2], double sense, uint32_t near,
                        double *all, double *others)
{
    *all = *others = INFINITY;
    for (int k = 0; k < pair->count[body]; k++) {
        const double *c = pair->corner[body][k], back = -sense * (c[0] * way[0] + c[1] * way[1]);
        *all = lesser(*all, back);
        if (!(near >> k & 1)) *others = lesser(*others, back);
    }
    *all = -*all;
    *others = -*others;
}

static double length_of(const double way[2])
{
    return sqrt(way[0] * way[0] + way[1] * way[1]);
}

static double room_of_crossings(const scree_polygon_pair *pair, const double way[2], const uint32_t near[2])
{
    double all[2], others[2];
    uint32_t edges[2], ends[2];
    for (int b = 0; b < 2; b++) {
        edges[b] = scree_edges_at(near[b], pair->count[b]);
        ends[b] = scree_ends_of(edges[b], pair->count[b]);
        reach_along(pair, b, way, b == 0 ? 1 : -1, near[b], &all[b], &others[b]);
    }
    const double behind = lesser(-all[1] - others[0], -all[0] - others[1]) / length_of(way);
    return lesser(behind,
                  lesser(room_beside_lines(pair, 0, edges[0], ends[1]), room_beside_lines(pair, 1, edges[1], ends[0])));
}

/// Whether `edge` (scree_polygon_uncrossed) has them on different sides.
static bool lie_apart(const scree_polygon_pose *pose, const scree_polygon_pair *pair, int edge, scree_pair_hint *hint)
{
    const int body = edge < 0, number = (edge < 0 ? -edge : edge) - 1;
    if (edge == 0 || !scree_edge_separates(pair, body, number)) return false;
    hint->edge[0] = (int8_t)edge;
    hint->room = -keep(pose, scree_polygon_gap(pair, body, number), hint);
    return true;
}

/// The same of the line of the centres.
static bool lie_apart_along(const scree_polygon_pose *pose, const scree_polygon_pair *pair, uint32_t near[2],
                            scree_pair_hint *hint)
{
    double all[2], others;
    if (scree_polygon_select(pair, pose->apart, near)) return false;
    for (int b = 0; b < 2; b++) reach_along(pair, b, pose->apart, b == 0 ? 1 : -1, 0, &all[b], &others);
    hint->room = -keep(pose, (-all[0] - all[1]) / length_of(pose->apart), hint);
    return true;
}

/// Their bounding circles do.
static bool are_out_of_reach(const scree_polygon_pose *pose, scree_pair_hint *hint)
{
    const double first = pose->polygon[0]->bound, second = pose->polygon[1]->bound;
    const double gap = length_of(pose->apart) - (first + second);
    if (!(gap > ROUNDED * scree_polygon_lever(first, second))) return false;
    hint->room = -keep(pose, gap, hint);
    return true;
}

static bool find_crossings(const scree_polygon_pose *pose, const scree_polygon_pair *pair, const uint32_t near[2],
                           scree_pair_hint *hint)
{
    scree_crossings crossings;
    scree_polygon_cross(pair, near, &crossings);
    const int in = __builtin_popcount(crossings.entering), out = __builtin_popcount(crossings.leaving);
    if (in == 1 && out == 1) {
        const int i = __builtin_ctz(crossings.entering), o = __builtin_ctz(crossings.leaving);
        const int edge[4] = {i, crossings.in[i], o, crossings.out[o]};
        hint->room = keep(pose, room_of_crossings(pair, pose->apart, near), hint);
        for (int k = 0; k < 4 && hint->room > 0; k++) hint->edge[k] = (int8_t)edge[k];
        return true;
    }
    if (in == out && in > 0) return true;
    scree_overlap inside;
    int edge = 0;
    return scree_polygon_uncrossed(pair, pose->apart, &edge, &inside) || !lie_apart(pose, pair, edge, hint);
}

bool scree_pair_hint_renew(const scree_polygon_pose *pose, scree_pair_hint *hint)
{
    const scree_polygon *first = pose->polygon[0], *second = pose->polygon[1];
    const int edge = hint->room > 0 ? 0 : hint->edge[0];
    double shifted[SCREE_POLYGON_CORNERS][2];
    const scree_polygon_pair pair = {
        {first->count, second->count}, {first->corner, (const double(*)[2])shifted}, {first->bound, second->bound}};
    uint32_t near[2];
    *hint = (scree_pair_hint){.room = 0};
    if (pose->apart[0] == 0 && pose->apart[1] == 0) return true;
    if (are_out_of_reach(pose, hint)) return false;
    if (first->count == 0 || second->count == 0) return true;
    for (int k = 0; k < second->count; k++)
        for (int i = 0; i < 2; i++) shifted[k][i] = second->corner[k][i] + pose->apart[i];
    if (lie_apart(pose, &pair, edge, hint) || lie_apart_along(pose, &pair, near, hint)) return false;
    return find_crossings(pose, &pair, near, hint);
}
