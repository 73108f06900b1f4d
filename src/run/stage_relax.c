/// Stage `relax`: time passes under gravity. Plates stand where they are; the walls of the case move or stand. Ends
/// after `duration`, or before when the unbalanced force ratio has been below `unbalanced_limit` for CALM samples since
/// the ramp or table that gravity follows came to its end.
///
/// The first such stage looks whether the bodies are where the walls of the case leave room: none may be closer to a
/// wall than its radius less the overlap that the guard allows.
#include "comm/comm.h"
#include "load/gravity.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/sample.h"
#include "run/step.h"
#include "shape/polygons.h"
#include "shape/wall_set.h"
#include "state/case_walls.h"

#include <math.h>

enum { CALM = 5 };

/// Whether the walls of the case move.
enum { WALLS_MOVE, WALLS_STAND };

typedef struct config {
    double duration;         ///< s, after which it ends in any case
    double unbalanced_limit; ///< 1, of the unbalanced force ratio, below which it ends before; auto: never
    int walls;               ///< WALLS_...
} config;
static const scree_choice wall_motions[] = {
    {"move", WALLS_MOVE, "with the velocities and spins that the case gives them"},
    {"stand", WALLS_STAND, "all of them stand where they have come to"},
    {0},
};
static const scree_key keys[] = {
    NUMBER(config, duration, "s", ABOVE("0 s"), TO("1e9 s"), .meaning = "Time after which the stage ends."),
    NUMBER(
        config, unbalanced_limit, "1", .standard = "auto", FROM("1e-9"), BELOW("1"),
        .meaning =
            "It ends before when the unbalanced force ratio stays below this, and gravity has come to the end of its "
            "ramp or table; auto: never."),
    CHOICE(config, walls, wall_motions, .standard = "move", .meaning = "What the walls of the case do."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// Whether a body has room beside a surface. Of polygons that lie on a wall the bounding circle may reach far into it:
/// what lies in it for certain has none, and a guard stops what lies too deep after all.
static bool has_room(const scree_simulation *s, int surface, size_t row)
{
    scree_vector place;
    scree_body_position(&s->state, row, place);
    const double radius = scree_body_bounding_radius(&s->state, row);
    return scree_surface_clearance(s->work.wall_set, surface, place, radius) >=
           scree_body_inner_radius(&s->state, row) * (1 - s->model.overlap_limit);
}

static scree_status refuse(const scree_simulation *s, int surface, size_t row, scree_error *error)
{
    const scree_config_wall *wall = s->work.wall_set->surface[surface].config;
    const double radius = scree_body_bounding_radius(&s->state, row);
    scree_vector place;
    scree_body_position(&s->state, row, place);
    const double clearance = scree_surface_clearance(s->work.wall_set, surface, place, radius);
    scree_error_set(error, SCREE_ERROR_INPUT,
                    "particle %u at (%.4g, %.4g, %.4g) m, radius %.4g m, is %s wall '%s': its centre is %.4g m "
                    "from it; move the wall, or change the box of the prepare stage (it begins at the origin)",
                    s->state.id[row], place[0], place[1], place[2], radius, clearance < 0 ? "behind" : "in", wall->name,
                    fabs(clearance));
    scree_error_key(error, SCREE_ERROR_INPUT, "walls.%td", wall - s->c->config.walls);
    if (error) scree_case_locate(s->c, error);
    return SCREE_ERROR_INPUT;
}

/// The first body of all, by walls and ids, that has no room is told by the process that has it.
static scree_status check_room(const scree_simulation *s, scree_error *error)
{
    const scree_state *state = &s->state;
    for (int k = 0; s->work.wall_set && k < s->work.wall_set->count; k++) {
        size_t found = 0;
        double own = -INFINITY;
        for (size_t row = 0; row < state->count; row++) {
            if (-(double)state->id[row] < own || has_room(s, k, row)) continue;
            own = -(double)state->id[row];
            found = row;
        }
        double first = own;
        scree_comm_maximum(state, &first, 1);
        if (isinf(first)) continue;
        const scree_status status = first == own ? refuse(s, k, found, error) : SCREE_OK;
        return state->part ? scree_comm_agree(status, error) : status;
    }
    return SCREE_OK;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state *state = &s->state;
    const scree_context context = scree_step_context(s);
    *scree_loading_of(state) = (scree_loading){.height = 0};
    if (s->boundary->rest) s->boundary->rest(&context);
    for (size_t row = 0; row < state->count; row++) scree_body_refer(state, row);
    scree_case_walls(state)->moving = own_config(s)->walls == WALLS_MOVE;
    return state->evaluations == 0 ? check_room(s, error) : SCREE_OK;
}

static void plan(scree_simulation *s)
{
    uint64_t expected = scree_stage_ticks(s, own_config(s)->duration), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.measure.samples * largest;
    s->plan = (scree_stage_plan){.interval = interval > 0 ? interval : largest, .expected = expected};
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    const config *stage = own_config(s);
    scree_stage_state *state = &s->state.stage;
    double unbalanced = s->sample[SCREE_SAMPLE_UNBALANCED_RATIO];
    bool calm = unbalanced < stage->unbalanced_limit && scree_gravity_is_final(&s->model, &s->state);
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

static double duration(const scree_model *model, const void *own)
{
    (void)model;
    return ((const config *)own)->duration;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    (void)wave;
    return duration(model, own);
}

static const scree_stage stage_face = {.name = "relax",
                                       .loading = true,
                                       .begin = begin,
                                       .plan = plan,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .duration = duration,
                                       .planned = planned};

static const scree_stage_numbers numbers = {
    .held = true,
    .needs_standing = "relax needs something that stands: give boundary: plates, or walls and boundary: walls"};

const scree_module scree_module_relax = {
    .name = "relax",
    .meaning =
        "Lets time pass under gravity, between plates that stand or the `walls` of the case, which move or stand.",
    .choice_of = CHOICE_OF(
        IS("stages", .meaning = "lets time pass: gravity, standing plates, walls of the case that stand or move")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
