/// Stage `relax`: time passes under gravity. Plates stand where they are; the walls of the case move or stand. Ends
/// after `duration`, or before when the unbalanced force ratio has been below `unbalanced_limit` for CALM samples.
///
/// The first such stage looks whether the bodies are where the walls of the case leave room: none may be closer to a
/// wall than its radius less the overlap that the guard allows.
#include "measure/imposed_gradient.h"
#include "run/sample.h"
#include "run/simulation.h"
#include "shape/container.h"
#include "state/case_walls.h"
#include "state/plates.h"

#include <math.h>
#include <string.h>

enum { CALM = 5 };

static scree_status check_room(const scree_simulation *s, scree_error *error)
{
    const scree_container *container = s->work.container;
    const scree_state *state = &s->state;
    for (int k = 0; container && k < container->count; k++) {
        size_t next = 0;
        for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;) {
            scree_vector place;
            scree_body_place(state, row, place);
            double radius = scree_body_bounding_radius(state, row);
            double clearance = scree_surface_clearance(container, k, place, radius);
            if (clearance >= radius * (1 - s->model.config->guard.overlap)) continue;
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "particle %u at (%.4g, %.4g, %.4g) m, radius %.4g m, is %s wall '%s': its centre "
                                   "is %.4g m from it; move the wall, or change the box of the prepare stage (it "
                                   "begins at the origin)",
                                   state->id[row], place[0], place[1], place[2], radius,
                                   clearance < 0 ? "behind" : "in", container->surface[k].config->name,
                                   fabs(clearance));
        }
    }
    return SCREE_OK;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state *state = &s->state;
    memset(state->stage.reference, 0, sizeof state->stage.reference);
    memset(scree_imposed(state)->prescribed, 0, sizeof scree_imposed(state)->prescribed);
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        scree_plates(state)[w].velocity = 0;
        memset(scree_plates(state)[w].tangential_velocity, 0, sizeof scree_plates(state)[w].tangential_velocity);
    }
    for (size_t row = 0; row < state->count; row++) scree_body_place(state, row, state->reference[row]);
    scree_case_walls(state)->moving = scree_stage_config(s)->walls == SCREE_WALLS_MOVE;
    return state->evaluations == 0 ? check_room(s, error) : SCREE_OK;
}

static void plan(scree_simulation *s)
{
    uint64_t expected = scree_stage_ticks(s, scree_stage_config(s)->duration), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.config->measure.samples * largest;
    s->plan = (scree_stage_plan){.interval = interval > 0 ? interval : largest, .expected = expected};
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    const scree_config_stage *stage = scree_stage_config(s);
    scree_stage_state *state = &s->state.stage;
    double unbalanced = s->sample.value[SCREE_SAMPLE_UNBALANCED_RATIO];
    bool calm = unbalanced < stage->unbalanced_limit;
    state->counter = calm ? state->counter + 1 : 0;
    bool over = s->state.step - state->first_step >= s->plan.expected;
    *done = over || state->counter >= CALM;
    if (over)
        (void)snprintf(s->reason, sizeof s->reason, "%.4g s have passed", stage->duration);
    else
        (void)snprintf(s->reason, sizeof s->reason, "unbalanced force ratio %.2g below %.2g for %d samples", unbalanced,
                       stage->unbalanced_limit, CALM);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) / (double)s->plan.expected;
}

const scree_stage scree_stage_relax = {
    .name = "relax", .loading = true, .begin = begin, .plan = plan, .finished = finished, .fraction = fraction};
