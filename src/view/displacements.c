/// Displacements of grains as arrows.
///
/// All grains of a smooth field move alike: arrows two diameters long in a row of grains one diameter apart lie upon
/// one another. So the plane is cut into squares, and the grain that is nearest to the middle of a square has the
/// arrow.
#include "view/displacements.h"

#include "base/memory.h"
#include "view/scale.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>

enum { MOST_ARROWS = 700, MOST_SQUARES = 1000 }; // these along a side, however far a grain lies away
#define LEAST_GAP 2.0                            /* mean diameters from arrow to arrow */

/// Squares that hold the grains with an arrow.
typedef struct net {
    double low[2], side; ///< m
    size_t size[2];
    size_t *nearest; ///< a square: number of the grain + 1; 0: it is empty
} net;

static bool has_arrow(const scree_snapshot *s, const double *const arrow[2], size_t k)
{
    return scree_snapshot_is_grain(s, k) && isfinite(arrow[0][k]) && isfinite(arrow[1][k]);
}

/// Square of a place, and its distance to the middle of it [m].
static size_t square_of(const net *n, double x, double y, double *distance)
{
    const double part[2] = {(x - n->low[0]) / n->side, (y - n->low[1]) / n->side};
    const size_t i = (size_t)part[0], j = (size_t)part[1];
    *distance = n->side * hypot(part[0] - (double)i - 0.5, part[1] - (double)j - 0.5);
    return j * n->size[0] + i;
}

static size_t fill_net(net *n, const scree_snapshot *s, const double *const arrow[2])
{
    size_t full = 0;
    for (size_t k = 0; k < n->size[0] * n->size[1]; k++) n->nearest[k] = 0;
    for (size_t k = 0; k < s->count; k++) {
        double here, there = INFINITY;
        if (!has_arrow(s, arrow, k)) continue;
        const size_t square = square_of(n, s->x[k], s->y[k], &here), other = n->nearest[square];
        full += other == 0;
        if (other > 0) (void)square_of(n, s->x[other - 1], s->y[other - 1], &there);
        if (here < there) n->nearest[square] = k + 1;
    }
    return full;
}

/// Takes away the arrows of all grains but one a square; squares grow until no more than MOST_ARROWS are left.
static scree_status thin(const scree_snapshot *s, double *arrow[2], scree_error *error)
{
    const double *const seen[2] = {arrow[0], arrow[1]};
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, radius = 0;
    size_t grains = 0;
    for (size_t k = 0; k < s->count; k++) {
        if (!has_arrow(s, seen, k)) continue;
        const double place[2] = {s->x[k], s->y[k]};
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = fmin(low[axis], place[axis]);
            high[axis] = fmax(high[axis], place[axis]);
        }
        radius += (s->radius[k] - radius) / (double)++grains;
    }
    if (grains == 0 || !(radius > 0))
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no grain whose displacement is known");
    net n = {.low = {low[0], low[1]}, .side = LEAST_GAP * 2 * radius};
    n.side = fmax(n.side, fmax(high[0] - low[0], high[1] - low[1]) / MOST_SQUARES);
    for (int axis = 0; axis < 2; axis++) n.size[axis] = 1 + (size_t)((high[axis] - low[axis]) / n.side);
    scree_status status = scree_allocate(&n.nearest, n.size[0] * n.size[1], sizeof *n.nearest, error);
    while (!status && fill_net(&n, s, seen) > MOST_ARROWS) {
        n.side *= 1.05;
        for (int axis = 0; axis < 2; axis++) n.size[axis] = 1 + (size_t)((high[axis] - low[axis]) / n.side);
    }
    for (size_t k = 0; k < s->count && !status; k++) {
        double ignored;
        const bool kept = has_arrow(s, seen, k) && n.nearest[square_of(&n, s->x[k], s->y[k], &ignored)] == k + 1;
        if (!kept) arrow[0][k] = arrow[1][k] = NAN;
    }
    scree_release(&n.nearest);
    return status;
}

/// Displacements of the bodies of a snapshot, NAN of those that are not in the later state. Both are in order of ids.
static void take(const scree_snapshot *from, const scree_average_sample *moved, double *arrow[2])
{
    size_t at = 0;
    for (size_t k = 0; k < from->count; k++) {
        while (at < moved->bodies && moved->grain[at].id < from->id[k]) at++;
        const scree_average_grain *grain = &moved->grain[at];
        const bool known = at < moved->bodies && grain->id == from->id[k] && grain->moved;
        for (int axis = 0; axis < 2; axis++) arrow[axis][k] = known ? grain->displacement[axis] : NAN;
    }
}

scree_status scree_displacements_draw(const char *path, const scree_snapshot *from, const scree_average_sample *moved,
                                      const double *shown, scree_error *error)
{
    char title[160], begin[40], end[40];
    double *room = NULL;
    if (from->dimension != 2)
        return scree_error_set(error, SCREE_ERROR_INPUT, "displacements are drawn of plane samples");
    scree_status status = scree_allocate(&room, 2 * from->count, sizeof *room, error);
    if (status) return status;
    double *arrow[2] = {room, room + from->count};
    take(from, moved, arrow);
    status = thin(from, arrow, error);
    scree_number_text(begin, sizeof begin, from->time, 4);
    scree_number_text(end, sizeof end, moved->time, 4);
    (void)snprintf(title, sizeof title, "Displacements of the grains from t = %s s to %s s", begin, end);
    const scree_scene scene = {
        .title = title, .arrow_x = arrow[0], .arrow_y = arrow[1], .plates = true, .shown = shown};
    if (!status) status = scree_scene_draw(path, from, &scene, error);
    scree_release(&room);
    return status;
}
