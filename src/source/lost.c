/// Grains that have fallen past everything that stands: a pile that has spread past its plate. Those that are below the
/// floor with all of their bounding circle stop the run, or are taken out (measure/removal.h).
#include "comm/comm.h"
#include "measure/removal.h"
#include "shape/wall_set.h"
#include "source/pour.h"
#include "state/plates.h"

#include <math.h>

/// Level below which nothing stands [m]: that of the lowest point of walls and of bodies whose velocity is prescribed;
/// -INFINITY where a plane has no end, or nothing stands.
static scree_status find_floor(const scree_context *c, double *floor, scree_error *error)
{
    static const double none[3] = {0};
    const scree_state *state = c->state;
    const int up = state->dimension - 1;
    scree_wall_triangles walls = {0};
    *floor = INFINITY;
    for (int k = 0; c->work->wall_set && k < c->work->wall_set->count; k++)
        if (c->work->wall_set->surface[k].endless) *floor = -INFINITY;
    for (int w = 0; w < 2 * state->dimension; w++)
        if (scree_plates(state)[w].active) *floor = -INFINITY;
    if (*floor < 0) return SCREE_OK;
    scree_status status = scree_wall_set_triangles(c->work->wall_set, none, none, &walls, error);
    for (size_t k = 0; k < walls.count && !status; k++)
        for (int corner = 0; corner < 3; corner++) *floor = fmin(*floor, walls.corner[k][3 * corner + up]);
    for (size_t row = 0; row < state->count && !status; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        if (scree_body_held(state, row) >> up & 1)
            *floor = fmin(*floor, place[up] - scree_body_bounding_radius(state, row));
    }
    double depth = -*floor;
    scree_comm_maximum(state, &depth, 1);
    *floor = depth == -INFINITY ? -INFINITY : -depth;
    scree_wall_triangles_destroy(&walls);
    return status;
}

static bool is_lost(const scree_state *state, size_t row, double floor)
{
    scree_vector place;
    scree_body_position(state, row, place);
    return place[state->dimension - 1] + scree_body_bounding_radius(state, row) < floor;
}

scree_status scree_pour_loses(const scree_context *c, bool *loses, scree_error *error)
{
    double floor;
    int64_t count = 0;
    scree_status status = find_floor(c, &floor, error);
    if (status) return status;
    for (size_t row = 0; row < c->state->count; row++) count += is_lost(c->state, row, floor);
    scree_comm_add(c->state, &count, 1);
    *loses = count > 0;
    return SCREE_OK;
}

static scree_status stop_lost(const scree_context *c, uint32_t row, scree_error *error)
{
    scree_vector place;
    scree_body_position(c->state, row, place);
    return scree_error_set(
        error, SCREE_ERROR_GUARD,
        "step %llu: particle %u, at (%.4g, %.4g, %.4g) m, has fallen past everything that stands: the "
        "pile has spread past its plate; make the plate wider, pour fewer particles, or give "
        "stages.%lld.past: take_out",
        (unsigned long long)c->state->step, c->state->id[row], place[0], place[1], place[2],
        (long long)c->state->stage.index);
}

scree_status scree_pour_look_for_lost(const scree_context *c, const scree_pour_config *stage, scree_error *error)
{
    double floor;
    uint32_t *ids = NULL;
    size_t count = 0, id = 0;
    scree_status status = find_floor(c, &floor, error);
    if (!status) status = scree_allocate(&ids, c->state->count + 1, sizeof *ids, error);
    for (uint32_t row; !status && (row = scree_next_by_id(c->state, &id)) != SCREE_NO_ROW;) {
        if (!is_lost(c->state, row, floor)) continue;
        ids[count++] = c->state->id[row];
        if (stage->past == SCREE_PAST_STOP) status = stop_lost(c, row, error);
    }
    if (!status && count > 0) {
        status = scree_bodies_remove(c->model, c->state, c->work, ids, count, error);
        scree_births_of(c->state)->lost += count;
    }
    scree_release(&ids);
    return status;
}
