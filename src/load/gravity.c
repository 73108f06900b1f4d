/// Gravity as a load: an acceleration that stays, or follows a schedule (base/schedule.h), of the case or of a stage.
///
/// It acts in the kick (integrate/kick.h), v += h g beside h F / m, and is no term of the integer sums: there m g would
/// be rounded to the quantum of forces, bodies of different mass would not fall alike to the last bit, and the quanta
/// would depend on the weight. The kick and all who ask read model->gravity, which is g(n), of the step that the state
/// is at; this module owns what it follows.
///
/// Work. By the rule of the ledger (measure/energy.c) gravity does sum m (g(n) + g(n+1))/2 . (x(n+1) - x(n)). Summed by
/// parts that is the change of the potential P(n) = sum m g(n) . x(n) less sum m (g(n+1) - g(n)) . (x(n) + x(n+1))/2:
/// without error, and nothing to be summed while gravity stays. ledger.gravity is the potential when the ledger was
/// opened and these sums, in integers over the bodies in any order; work is P - ledger.gravity.
///
/// Cost: none while it stays; two passes over the bodies a step while it changes, some 3 ns a body each.
#include "load/gravity.h"

#include "base/integer_sum.h"
#include "case/config.h"
#include "comm/comm.h"
#include "measure/measure.h"

#include <math.h>
#include <string.h>

void scree_gravity_find(const scree_model *model, const scree_state *state, uint64_t ticks, double gravity[3])
{
    const scree_stage_state *stage = &state->stage;
    const scree_schedule *own = model->stages[stage->index].gravity;
    double since = (double)(state->step - stage->first_step + ticks) * state->tick;
    for (int k = 0; k < 3; k++)
        gravity[k] = scree_config_is_open(own)
                         ? scree_schedule_at(&model->gravity_of_case[k], stage->first_time + since)
                         : scree_schedule_at(&own[k], since);
}

bool scree_gravity_is_final(const scree_model *model, const scree_state *state)
{
    const scree_stage_state *stage = &state->stage;
    const scree_schedule *own = model->stages[stage->index].gravity;
    const bool open = scree_config_is_open(own);
    const double since = (double)(state->step - stage->first_step) * state->tick + (open ? stage->first_time : 0);
    bool final = true;
    for (int k = 0; k < 3; k++) {
        const scree_schedule *s = open ? &model->gravity_of_case[k] : &own[k];
        double last = -INFINITY;
        if (s->form == SCREE_SCHEDULE_RAMP || s->form == SCREE_SCHEDULE_SMOOTH) last = s->begin + s->duration;
        if (s->form == SCREE_SCHEDULE_TABLE) last = s->row[(s->count - 1) * scree_schedule_stride(s->columns)];
        final = final && since >= last;
    }
    return final;
}

/// sum m by . x over the bodies that are here [J].
static double moment(const scree_state *state, const double by[3])
{
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t row = 0; row < state->count; row++) {
            scree_vector position;
            scree_body_position(state, row, position);
            scree_integer_sum_add(&sum, state->row[row].mass * scree_dot(by, position));
        }
    return scree_integer_sum_total(&sum);
}

void scree_gravity_enter(scree_model *model, scree_state *state, bool told)
{
    static const scree_contact_table none = {0};
    scree_energy before, after;
    double gravity[3];
    scree_gravity_find(model, state, 0, gravity);
    told = told && memcmp(gravity, model->gravity, sizeof gravity) != 0;
    if (told) scree_energy_measure(model, state, &none, &before);
    memcpy(model->gravity, gravity, sizeof gravity);
    if (!told) return;
    scree_energy_measure(model, state, &none, &after);
    state->ledger.gravity += (after.gravity - before.gravity) -
                             ((after.kinetic + after.kinetic_rotation) - (before.kinetic + before.kinetic_rotation));
}

/// Half of the sum by parts, at the positions that the bodies have.
static void tell_half(const scree_context *c, const double next[3])
{
    double change[3];
    scree_subtract(next, c->gravity, change);
    if (scree_dot(change, change) > 0) c->state->ledger.gravity += 0.5 * moment(c->state, change);
}

/// At x(n).
static scree_status decide(const scree_context *c, scree_error *error)
{
    double next[3];
    (void)error;
    scree_gravity_find(c->model, c->state, c->work->ticks, next);
    tell_half(c, next);
    return SCREE_OK;
}

/// At x(n+1), before a periodic cell puts bodies back; from here on g(n+1) acts.
static scree_status follow(const scree_context *c, scree_error *error)
{
    double next[3];
    (void)error;
    scree_gravity_find(c->model, c->state, 0, next);
    tell_half(c, next);

    memcpy(c->gravity, next, sizeof next);
    return SCREE_OK;
}

/// Whether it may change in the stage.
static bool in_use(const scree_context *c)
{
    const scree_schedule *own = c->model->stages[c->state->stage.index].gravity;
    const scree_schedule *gravity = scree_config_is_open(own) ? c->model->gravity_of_case : own;
    for (int k = 0; k < 3; k++)
        if (!scree_schedule_is_constant(&gravity[k])) return true;
    return false;
}

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = decide}, {SCREE_PHASE_FOLLOW, .run = follow}};

const scree_module scree_module_gravity = {
    .name = "gravity",
    .meaning = "gravity of the case or of a stage, which may follow a schedule",
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
};
