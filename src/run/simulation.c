/// Stages one after the other, a step at a time.
#include "run/simulation.h"

#include "base/clock.h"
#include "base/processor.h"
#include "comm/comm.h"
#include "integrate/forced_spin.h"
#include "load/gravity.h"
#include "measure/measure.h"
#include "run/guard.h"
#include "run/own_force.h"
#include "run/ranks.h"
#include "run/sample.h"
#include "run/stability.h"
#include "run/step.h"
#include "search/neighbours.h"
#include "shape/wall_set.h"
#include "source/room.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODIES_A_THREAD 4000

scree_status scree_case_model(const scree_case *c, scree_model *model, scree_error *error)
{
    scree_status status = scree_model_build(&c->config, model, error);
    if (status) scree_case_locate(c, error);
    return status;
}

/// The walls, and whether what sources pour passes the openings between them.
static scree_status make_walls(const scree_case *c, scree_simulation *s, scree_error *error)
{
    scree_status status = scree_wall_set_create(&c->config, &s->work.wall_set, error);
    for (int64_t k = 0; k < s->model.source_count && !status; k++)
        status = scree_source_check_opening(&s->model, s->work.wall_set, k, error);
    if (status) scree_case_locate(c, error);
    return status;
}

scree_status scree_simulation_open(const scree_case *c, int threads, scree_simulation *s, scree_error *error)
{
    memset(s, 0, sizeof *s);
    s->c = c;
    scree_status status = scree_case_model(c, &s->model, error);
    if (status) return status;
    if ((status = scree_state_open(&s->state, s->model.dimension, error))) return status;
    scree_state_set_laws(&s->state, &s->model);
    s->state.stage.counter = SCREE_STAGE_NOT_BEGUN;
    s->stage_model = s->model;
    s->integrator = scree_integrator_get(s->model.scheme);
    // A thread pays from a few thousand bodies on; below, its barriers cost more than it does (docs/performance.md).
    if (threads <= 0)
        threads = (int)fmin(fmax(1, scree_processor_count() / scree_comm_neighbours()),
                            1 + (double)c->config.particles.count / BODIES_A_THREAD);
    status = scree_work_create(&s->work, &s->model, threads, error);
    if (!status) status = make_walls(c, s, error);
    if (!status) status = scree_columns_create(&c->config, &s->columns, error);
    return status ? status : scree_allocate(&s->sample, s->columns.count, sizeof *s->sample, error);
}

void scree_simulation_close(scree_simulation *s)
{
    scree_columns_destroy(&s->columns);
    scree_release(&s->sample);
    scree_own_force_list_destroy(&s->forces);
    scree_release(&s->points);
    scree_contact_table_destroy(&s->table);
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    scree_state_destroy(&s->state);
}

/// A stage before the first step, as the one that has placed the bodies, opens the energy ledger with what they hold:
/// motion, and overlaps that they were placed with.
static scree_status open_ledger(scree_simulation *s, scree_error *error)
{
    scree_state *state = &s->state;
    scree_energy energy;
    state->ledger = (scree_ledger){0};
    scree_status status = scree_neighbours_refresh(&s->stage_model, state, &s->work, error);
    if (!status) status = scree_contact_table_build(&s->stage_model, state, &s->work, &s->table, error);
    if (status) return status;
    scree_energy_measure(&s->stage_model, state, &s->table, &energy);
    state->ledger.initial =
        energy.kinetic + energy.kinetic_rotation + energy.elastic_normal + energy.elastic_tangential;
    state->ledger.gravity = energy.gravity;
    return scree_contacts_were_placed(&s->stage_model, state, &s->work, error);
}

/// Changes to the boundary of the stage that begins. What walls that go hold in their contacts goes with them; bodies
/// may be added.
static scree_status change_boundary(scree_simulation *s, scree_error *error)
{
    bool changed;
    scree_status status = SCREE_OK;
    s->table.count = 0;
    if (s->work.valid) {
        status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
        if (!status) status = scree_contacts_save(&s->state, &s->work, error);
    }
    if (!status) status = scree_boundary_begin(s->boundary, &s->stage_model, &s->state, &s->table, &changed, error);
    scree_neighbours_invalidate(&s->work);
    // Whoever looks at the contacts before the next step finds those that there are now.
    if (!status && changed) status = scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
    return status;
}

/// Whether plates of the box go before they have acted, and what bodies behind them seemed to hold with them: with
/// walls of the case alone, or nothing, bodies may be placed there, and that energy is none.
static bool plates_were_none(const scree_simulation *s)
{
    const scree_ledger *ledger = &s->state.ledger;
    return s->state.evaluations == 0 && s->boundary->open && !(fabs(ledger->plates) <= 0);
}

/// Modules that act from this stage on, or no longer.
static scree_status begin_modules(scree_simulation *s, scree_error *error)
{
    const scree_context context = scree_step_context(s);
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->begin) status = scree_modules[m]->begin(&context, error);
    if (status == SCREE_ERROR_INPUT && error) scree_case_locate(s->c, error);
    return status;
}

/// Whether the stage that the state is in is there; its kind, boundary and model.
static bool choose_stage(scree_simulation *s)
{
    if (s->state.stage.index >= s->model.stage_count) {
        s->stage = NULL;
        return false;
    }
    const scree_config_stage *config = scree_stage_config(s);
    s->stage = scree_modules[config->kind]->stage;
    s->boundary = scree_model_boundary_of(&s->model, s->state.stage.index);
    double before[3];
    memcpy(before, s->stage_model.gravity, sizeof before);
    // What contacts exert between two stages is that of the stage before.
    if (!s->stage->instant) s->stage_model = scree_model_of_stage(&s->model, config);
    memcpy(s->stage_model.gravity, before, sizeof before);
    return true;
}

/// Of parts all do it together, of the whole process 0 alone.
static scree_status begin_stage(scree_simulation *s, scree_error *error)
{
    scree_stage_state *stage = &s->state.stage;
    stage->first_time = scree_state_time(&s->state);
    stage->first_step = s->state.step;
    stage->first_evaluations = s->state.evaluations;
    stage->counter = 0;
    scree_forced_spin_end(&s->state);
    scree_gravity_enter(&s->stage_model, &s->state, scree_state_total(&s->state) > 0);
    scree_status status = s->stage->begin ? s->stage->begin(s, error) : SCREE_OK;
    if (status) return status;
    if (!s->stage->instant) {
        status = change_boundary(s, error);
        if (!status && plates_were_none(s)) status = open_ledger(s, error);
    } else if (scree_modules[scree_stage_config(s)->kind]->numbers->places || s->state.evaluations == 0)
        status = open_ledger(s, error);
    if (!status && !s->stage->instant) status = begin_modules(s, error);
    return status;
}

scree_status scree_stage_enter(scree_simulation *s, bool restart, scree_error *error)
{
    if (!choose_stage(s)) return SCREE_OK;
    if (!restart || s->state.stage.counter == SCREE_STAGE_NOT_BEGUN) {
        s->state.spent.stage = s->state.spent.processor = 0;
        scree_status status = scree_ranks_gather_for_begin(s, error);
        if (!status && scree_ranks_acts(s)) status = begin_stage(s, error);
        status = scree_comm_agree(status, error);
        if (!status) status = scree_ranks_begun(s, error);
        if (status) return status;
        if (!s->stage->instant) scree_stability_ask(s, true);
    }
    scree_gravity_enter(&s->stage_model, &s->state, false);
    if (s->stage->plan) s->stage->plan(s);
    scree_step_compile(s);
    return SCREE_OK;
}

static void end_stage(scree_simulation *s)
{
    s->stage_ended = true;
    s->state.stage.counter = SCREE_STAGE_ENDED;
}

static void leave_stage(scree_simulation *s)
{
    s->state.stage.index++;
    s->state.stage.counter = SCREE_STAGE_NOT_BEGUN;
}

/// The columns that are not measured in parts, by process 0.
static scree_status measure_whole(scree_simulation *s, const char *names, scree_error *error)
{
    char what[80];
    (void)snprintf(what, sizeof what, "samples of %s", names);
    scree_status status = scree_ranks_gather_contacts(s, what, error);
    const scree_context context = scree_step_context(s);
    if (!status && scree_ranks_acts(s)) status = scree_columns_measure(&s->columns, &context, false, s->sample, error);
    status = scree_comm_agree(status, error);
    scree_comm_share(s->sample, s->columns.count * sizeof *s->sample);
    return status ? status : scree_ranks_return(s, error);
}

/// In parts, but for columns that need the whole.
static scree_status take_sample(scree_simulation *s, scree_error *error)
{
    char names[64] = "";
    scree_status status = SCREE_OK;
    const bool whole = s->state.part && scree_columns_want_whole(&s->columns, names, sizeof names);
    if (whole) status = measure_whole(s, names, error);
    if (s->state.part && !whole)
        s->samples_in_parts++;
    else
        s->samples_of_wholes++;
    return status ? status : scree_sample_take(s, error);
}

/// What contacts there are behind a stage that takes no steps; where the ledger was opened it is known.
static scree_status table_contacts(scree_simulation *s, scree_error *error)
{
    if (!s->state.part && s->state.evaluations == 0) return SCREE_OK;
    scree_status status = scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
    if (!status) status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    return status;
}

/// Begins the next stage; a loading stage is sampled at zero strain.
static scree_status begin_next(scree_simulation *s, scree_error *error)
{
    scree_status status = scree_stage_enter(s, false, error);
    if (status) return status;
    if (!s->stage) return SCREE_OK;
    if (s->stage->instant) {
        end_stage(s);
        return table_contacts(s, error);
    }
    if (!s->stage->loading) return SCREE_OK;
    s->sampled = true;
    return take_sample(s, error);
}

/// A step by parts; what stops it is told of the whole state.
static scree_status take_step(scree_simulation *s, scree_error *error)
{
    const double begin = scree_clock();
    scree_status status = scree_step(s, error);
    s->in_steps += scree_clock() - begin;
    if (status != SCREE_ERROR_GUARD || !s->state.part || !s->work.flags) return status;
    status = scree_ranks_gather(s, "guards", error);
    if (!status) status = scree_ranks_acts(s) ? scree_guard_step(s, error) : SCREE_ERROR_GUARD;
    return scree_comm_agree(status, error);
}

scree_status scree_simulation_step(scree_simulation *s, scree_error *error)
{
    s->sampled = s->stage_ended = false;
    if (s->state.stage.counter == SCREE_STAGE_ENDED) leave_stage(s);
    if (s->state.stage.counter == SCREE_STAGE_NOT_BEGUN) return begin_next(s, error);
    s->whole = true;
    scree_status status = scree_stability_check(s, error);
    if (status) return status;
    s->whole = false;
    if ((status = take_step(s, error))) return status;
    uint64_t done = s->state.step - s->state.stage.first_step;
    const bool due = done % s->plan.interval == 0 || done == s->plan.expected;
    if (due && (status = take_sample(s, error))) return status;
    s->sampled = due;
    scree_stability_ask(s, false);
    if (!due) return SCREE_OK;
    bool finished = false;
    if ((status = s->stage->finished(s, &finished, error))) return status;
    if (finished) end_stage(s);
    return SCREE_OK;
}
