/// The outline of a sample, segment by segment: see outline.h.
/// Areas and lengths are sums in integers.
/// Which plate a run of unloaded edges faces: the active one of bottom and top to which its two end discs are nearer.
#include "measure/outline.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/integer_sum.h"

#include <math.h>
#include <string.h>

static double distance_to(const scree_wall *wall, const double x[2])
{
    return wall->normal[0] * x[0] + wall->normal[1] * x[1] - wall->position;
}

/// The plate that two discs face; -1 when neither bottom nor top is active.
static int facing_plate(const scree_state *state, const double a[2], const double b[2])
{
    int nearest = -1;
    double least = INFINITY;
    for (int w = SCREE_WALL_BOTTOM; w <= SCREE_WALL_TOP; w++) {
        const scree_wall *wall = &scree_plates(state)[w];
        double distance = distance_to(wall, a) + distance_to(wall, b);
        if (!wall->active || !(distance < least)) continue;
        nearest = w;
        least = distance;
    }
    return nearest;
}

/// Foot of the perpendicular from x on a wall. Its coordinate along an axis-parallel normal is the wall's own, to the
/// bit.
static void foot_on(const scree_wall *wall, const double x[2], double foot[2])
{
    double along = -wall->normal[1] * x[0] + wall->normal[0] * x[1];
    foot[0] = wall->position * wall->normal[0] - along * wall->normal[1];
    foot[1] = wall->position * wall->normal[1] + along * wall->normal[0];
}

static void emit(scree_outline_visitor *visit, void *user, scree_outline_kind kind, int wall, const double from[2],
                 const double to[2], size_t first, size_t second)
{
    scree_outline_segment segment = {
        .kind = kind, .from = {from[0], from[1]}, .to = {to[0], to[1]}, .first = first, .second = second, .wall = wall};
    visit(user, &segment);
}

void scree_outline_visit_run(const scree_state *state, scree_outline_visitor *visit, void *user, size_t k)
{
    const scree_loop *loop = scree_loop_of(state);
    size_t end = k;
    while (!loop->loaded[end]) end = scree_loop_next(loop, end);
    double a[2], b[2], foot_a[2], foot_b[2];
    scree_loop_position(state, k, a);
    scree_loop_position(state, end, b);
    int wall = facing_plate(state, a, b);
    if (wall < 0) {
        emit(visit, user, SCREE_OUTLINE_BARE, wall, a, b, k, end);
        return;
    }
    foot_on(&scree_plates(state)[wall], a, foot_a);
    foot_on(&scree_plates(state)[wall], b, foot_b);
    emit(visit, user, SCREE_OUTLINE_END, wall, a, foot_a, k, k);
    emit(visit, user, SCREE_OUTLINE_BARE, wall, foot_a, foot_b, k, end);
    emit(visit, user, SCREE_OUTLINE_END, wall, foot_b, b, end, end);
}

void scree_outline_visit(const scree_state *state, scree_outline_visitor *visit, void *user)
{
    scree_outline_walk(state, visit, user);
}

typedef struct area_sum {
    bool begun;
    double origin[2];
    scree_integer_sum sum[3]; ///< area; moments
} area_sum;

/// Triangle of the segment and the first point (shoelace), with its centre of area.
static void add_area(void *user, const scree_outline_segment *segment)
{
    area_sum *sum = user;
    if (!sum->begun) {
        sum->begun = true;
        sum->origin[0] = segment->from[0];
        sum->origin[1] = segment->from[1];
    }
    double a[2] = {segment->from[0] - sum->origin[0], segment->from[1] - sum->origin[1]};
    double b[2] = {segment->to[0] - sum->origin[0], segment->to[1] - sum->origin[1]};
    double area = (a[0] * b[1] - a[1] * b[0]) / 2;
    scree_integer_sum_add(&sum->sum[0], area);
    for (int i = 0; i < 2; i++) scree_integer_sum_add(&sum->sum[1 + i], area * (a[i] + b[i]) / 3);
}

double scree_outline_area(const scree_state *state, double centre[2])
{
    area_sum sum = {0};
    while (scree_integer_sum_next(sum.sum, 3)) scree_outline_visit(state, add_area, &sum);
    double area = scree_integer_sum_total(&sum.sum[0]);
    for (int i = 0; i < 2; i++)
        centre[i] = area > 0 ? sum.origin[i] + scree_integer_sum_total(&sum.sum[1 + i]) / area : 0;
    return area;
}

typedef struct plate_length {
    int wall;
    double *term;
    size_t count;
} plate_length;

static void add_plate_length(void *user, const scree_outline_segment *segment)
{
    plate_length *sum = user;
    if (segment->kind != SCREE_OUTLINE_BARE || segment->wall != sum->wall) return;
    sum->term[sum->count++] = hypot(segment->to[0] - segment->from[0], segment->to[1] - segment->from[1]);
}

/// Servos ask for it in every step: the outline is walked once.
double scree_outline_plate_length(const scree_state *state, int wall)
{
    plate_length sum = {.wall = wall, .term = scree_loop_of(state)->term};
    scree_outline_visit(state, add_plate_length, &sum);
    return scree_integer_sum_of(sum.term, sum.count);
}
