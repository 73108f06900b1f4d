/// Outlines of a sample: see outlines.h. Corners do not change, and each process has those of all bodies (polygons.h);
/// so it is told how the bodies of the others lie, and turns them as they do.
#include "shape/outlines.h"

#include "comm/parts.h"
#include "comm/traffic.h"
#include "shape/polygons.h"

#include <stdlib.h>

/// How a grain lies.
typedef struct lying {
    uint64_t id;
    double angle;    ///< rad
    double radius;   ///< m, bounding
    double rounding; ///< m
    scree_corners of;
} lying;

static int compare(const void *a, const void *b)
{
    const lying *p = a, *q = b;
    return p->id < q->id ? -1 : p->id > q->id;
}

/// All grains, in the order of their ids. angle: of each row.
static scree_status gather(const scree_state *state, const double *angle, lying **list, size_t *count,
                           scree_error *error)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    size_t id = 0;
    *count = 0;
    scree_status status = scree_allocate(list, scree_grain_count(state) + 1, sizeof **list, error);
    for (uint32_t row; !status && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;)
        if (scree_body_is_grain(state, row))
            (*list)[(*count)++] = (lying){.id = state->id[row],
                                          .angle = angle[row],
                                          .radius = scree_body_bounding_radius(state, row),
                                          .rounding = scree_rounding_of_row(polygons, row),
                                          .of = polygons->of[row]};
    if (status || !state->part) return status;
    const scree_traffic_purpose before = scree_traffic_for(SCREE_TRAFFIC_PLACES);
    status = scree_parts_collect(state, list, count, sizeof **list, error);
    (void)scree_traffic_for(before);
    if (!status) qsort(*list, *count, sizeof **list, compare);
    return status;
}

/// Turns the corners of all of the list.
static scree_status turn(const scree_polygons *polygons, const lying *list, size_t count, double (*posed)[2],
                         scree_error *error)
{
    double *angle = NULL;
    scree_corners *of = NULL;
    scree_status status = scree_allocate(&angle, count + 1, sizeof *angle, error);
    if (!status) status = scree_allocate(&of, count + 1, sizeof *of, error);
    for (size_t k = 0; k < count && !status; k++) {
        angle[k] = list[k].angle;
        of[k] = list[k].of;
    }
    if (!status)
        scree_polygons_turn(&(scree_pose){
            .count = count, .angle = angle, .of = of, .corner = (const double(*)[2])polygons->corner, .posed = posed});
    scree_release(&angle);
    scree_release(&of);
    return status;
}

static scree_core core_of(const lying *grain, double (*posed)[2])
{
    if (grain->of.count == 0) return (scree_core){.rounding = grain->radius};
    return (scree_core){.corner = (const double(*)[2])posed + grain->of.first,
                        .count = (int)grain->of.count,
                        .bound = grain->radius - grain->rounding,
                        .rounding = grain->rounding};
}

/// Outlines of bodies that lie by these angles.
static scree_status find(const scree_state *state, const double *angle_of, scree_outlines *outlines, scree_error *error)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    lying *list = NULL;
    size_t count = 0;
    *outlines = (scree_outlines){0};
    if (!polygons || !polygons->of) return SCREE_OK;
    scree_status status = gather(state, angle_of, &list, &count, error);
    if (!status) status = scree_allocate(&outlines->corner, polygons->count + 1, sizeof *outlines->corner, error);
    if (!status) status = scree_allocate(&outlines->core, count + 1, sizeof *outlines->core, error);
    if (!status) status = turn(polygons, list, count, outlines->corner, error);
    for (size_t k = 0; k < count && !status; k++) outlines->core[k] = core_of(&list[k], outlines->corner);
    scree_release(&list);
    if (status) scree_outlines_destroy(outlines);
    return status;
}

scree_status scree_outlines_find(const scree_state *state, scree_outlines *outlines, scree_error *error)
{
    return find(state, state->angle, outlines, error);
}

scree_status scree_outlines_find_reference(const scree_state *state, scree_outlines *outlines, scree_error *error)
{
    return find(state, state->reference_angle, outlines, error);
}

void scree_outlines_destroy(scree_outlines *outlines)
{
    scree_release(&outlines->core);
    scree_release(&outlines->corner);
}
