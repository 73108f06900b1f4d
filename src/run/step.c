/// The step. Between two steps the state holds x(n), the scheme's velocity and the force sums at n; a restart begins
/// here.
///
/// It is a list of passes, by phase (module/pass.h): in each phase those of the core, which stand here, then those of
/// the modules in use by their place in the table, then those of the boundary of the stage.
#include "run/step.h"

#include "comm/comm.h"
#include "comm/parts.h"
#include "measure/measure.h"
#include "run/guard.h"
#include "run/ranks.h"
#include "search/neighbours.h"

#include <assert.h>

/// Chooses the step from n to n + 1; where its size differs from the last one, the ledger is told.
static scree_status choose_step(const scree_context *c, scree_error *error)
{
    scree_simulation *s = c->simulation;
    double before = s->state.step_size;
    (void)error;
    (void)scree_thread_pool_size_follow(&c->work->size, c->work->pool, c->work->threads);
    c->work->ticks = scree_integrator_choose_step(s->integrator, c->model, c->state, s->stage->loading);
    if (s->state.step_size != before)
        scree_energy_change_step(c->model, c->state, before, s->state.step_size);
    return SCREE_OK;
}

static scree_status control(const scree_context *c, scree_error *error)
{
    (void)error;
    if (c->simulation->stage->control) c->simulation->stage->control(c->simulation);
    return SCREE_OK;
}

static scree_status control_whole(const scree_context *c, bool *wanted, scree_error *error)
{
    const scree_simulation *s = c->simulation;
    (void)error;
    *wanted = s->stage->control_whole && s->stage->control_whole(s);
    return SCREE_OK;
}

static scree_status first_half(const scree_context *c, scree_error *error)
{
    (void)error;
    c->simulation->integrator->first(c->model, c->state, c->work);
    return SCREE_OK;
}

static scree_status advance_clock(const scree_context *c, scree_error *error)
{
    (void)error;
    c->state->step += c->work->ticks;
    c->state->evaluations++;
    return SCREE_OK;
}

static scree_status refresh_neighbours(const scree_context *c, scree_error *error)
{
    return scree_neighbours_refresh(c->model, c->state, c->work, error);
}

/// Room for what a law that looks ahead needs.
static scree_status look_ahead(const scree_context *c, scree_error *error)
{
    return scree_model_predicts(c->model) ? scree_state_predict(c->state, error) : SCREE_OK;
}

/// What kernels sum beside forces and torques, for the modules that are in use.
static scree_status ask_for_moments(const scree_context *c, scree_error *error)
{
    return scree_state_ask_for_moments(c->state, c->simulation->moments, error);
}

/// Largest force of the loads of this step on one body [N].
static double bound_of_loads(const scree_context *c)
{
    double bound = c->boundary->bound ? c->boundary->bound(c) : 0;
    const scree_simulation *s = c->simulation;
    for (size_t k = 0; k < s->bound_count; k++) bound = fmax(bound, s->bounds[k](c));
    if (s->bounds_differ) scree_comm_maximum(c->state, &bound, 1);
    return bound;
}

static scree_status contact_forces(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_contact_set_quanta(c->model, c->state, bound_of_loads(c));
    scree_contact_forces(c->model, c->state, c->work);
    return SCREE_OK;
}

/// Loads and their bounds may ask how long their forces will act.
static scree_status predict_kick(const scree_context *c, scree_error *error)
{
    const scree_simulation *s = c->simulation;
    (void)error;
    c->work->next_kick = scree_integrator_next_kick(s->integrator, c->model, c->state, s->stage->loading);
    return SCREE_OK;
}

static scree_status second_half(const scree_context *c, scree_error *error)
{
    (void)error;
    if (c->simulation->integrator->second) c->simulation->integrator->second(c->model, c->state, c->work);
    return SCREE_OK;
}

static scree_status guard(const scree_context *c, scree_error *error)
{
    scree_guard_join(c->state, c->work, c->simulation->flags_late);
    // Which body it is, and where, is told of the whole state.
    if (c->state->part) return c->work->flags ? SCREE_ERROR_GUARD : SCREE_OK;
    return scree_guard_step(c->simulation, error);
}

static const scree_pass core[] = {
    {SCREE_PHASE_DECIDE, .run = look_ahead},
    {SCREE_PHASE_DECIDE, .run = ask_for_moments},
    {SCREE_PHASE_DECIDE, .run = choose_step},
    {SCREE_PHASE_DECIDE, .run = control, .whole = control_whole},
    {SCREE_PHASE_FIRST_HALF, .run = first_half},
    {SCREE_PHASE_FOLLOW, .run = advance_clock},
    {SCREE_PHASE_SEARCH, .run = refresh_neighbours},
    {SCREE_PHASE_CONTACTS, .run = predict_kick},
    {SCREE_PHASE_CONTACTS, .run = contact_forces},
    {SCREE_PHASE_SECOND_HALF, .run = second_half},
    {SCREE_PHASE_GUARD, .run = guard},
};

/// Appends those of `passes` that belong to a phase.
static void append(scree_simulation *s, scree_phase phase, const scree_pass *passes, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (passes[k].phase == phase) {
            assert(s->pass_count < SCREE_PASSES);
            s->passes[s->pass_count++] = passes[k];
        }
}

/// What modules in use say of themselves.
static void note_traits(scree_simulation *s, const scree_module *module)
{
    s->moments = s->moments || module->reads_moments;
    s->bounds_differ = s->bounds_differ || module->bound_differs;
    s->flags_late = s->flags_late || module->flags_late;
}

void scree_step_compile(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    s->pass_count = s->bound_count = 0;
    s->moments = s->flags_late = false;
    s->bounds_differ = s->boundary->bound_differs;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        if (scree_modules[m]->bound) s->bounds[s->bound_count++] = scree_modules[m]->bound;
        if (!scree_modules[m]->in_use || scree_modules[m]->in_use(&context)) note_traits(s, scree_modules[m]);
    }
    for (scree_phase phase = 0; phase < SCREE_PHASE_COUNT; phase++) {
        append(s, phase, core, sizeof core / sizeof *core);
        for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
            const scree_module *module = scree_modules[m];
            if (!module->in_use || module->in_use(&context)) append(s, phase, module->passes, module->pass_count);
        }
        append(s, phase, s->boundary->passes, s->boundary->pass_count);
    }
}

/// The module that has a pass which may want the whole sample.
static const char *name_of(const scree_pass *pass)
{
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->pass_count; k++)
            if (scree_modules[m]->passes[k].whole == pass->whole) return scree_modules[m]->name;
    return "a boundary";
}

/// A pass that wants the whole sample in this step has it, in process 0 alone.
static scree_status run_pass(scree_simulation *s, const scree_pass *pass, const scree_context *c, scree_error *error)
{
    bool whole = false;
    scree_status status = pass->whole && s->state.part ? pass->whole(c, &whole, error) : SCREE_OK;
    if (!status && whole) status = scree_ranks_gather(s, name_of(pass), error);
    if (!status && (!whole || scree_ranks_acts(s))) status = pass->run(c, error);
    if (whole) status = scree_comm_agree(status, error);
    return !status && whole ? scree_ranks_spread(s, error) : status;
}

scree_status scree_step(scree_simulation *s, scree_error *error)
{
    const scree_context context = scree_step_context(s);
    scree_status status = SCREE_OK;
    const bool part = s->state.part;
    if (part) scree_parts_begin_step(&s->work);
    for (size_t k = 0; k < s->pass_count && !status; k++) status = run_pass(s, &s->passes[k], &context, error);
    if (!status && part) scree_parts_end_step(&s->state, &s->work);
    return status;
}

scree_status scree_step_phase(scree_simulation *s, scree_phase phase, scree_error *error)
{
    const scree_context context = scree_step_context(s);
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < s->pass_count && !status; k++)
        if (s->passes[k].phase == phase) status = s->passes[k].run(&context, error);
    return status;
}
