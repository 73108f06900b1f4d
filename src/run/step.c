/// The step. Between two steps the state holds x(n), the scheme's velocity and the force sums at n; a restart begins
/// here.
#include "run/step.h"
#include "state/case_walls.h"

#include "boundary/periodic.h"
#include "boundary/plates.h"
#include "integrate/forced_spin.h"
#include "measure/measure.h"
#include "run/guard.h"
#include "search/neighbours.h"

/// The size of the step from n to n + 1, in ticks; where it differs from the last one, the ledger is told.
static uint64_t choose_step(scree_simulation *s)
{
    double before = s->state.step_size;
    uint64_t ticks = scree_integrator_choose_step(s->integrator, &s->stage_model, &s->state, s->stage->loading);
    if (s->state.step_size != before && s->work.ledger)
        scree_energy_change_step(&s->stage_model, &s->state, before, s->state.step_size);
    return ticks;
}

scree_status scree_step(scree_simulation *s, scree_error *error)
{
    const scree_model *model = &s->stage_model;
    scree_state *state = &s->state;
    scree_work *work = &s->work;
    scree_status status;

    (void)scree_team_size_follow(&work->size, work->team, work->threads);
    if (scree_model_foresees(model) && (status = scree_state_foresee(state, error))) return status;
    uint64_t ticks = choose_step(s);
    // Boundaries decide their velocities from the stresses at n, then everything moves to n + 1.
    if (s->stage->control) s->stage->control(s);
    scree_plates_move(state);
    s->integrator->first(model, state, work);
    scree_boundary_finish_work(s->boundary, state);
    if ((status = scree_periodic_move(model, state, work, error))) return status;
    state->step += ticks;
    if (scree_case_walls(state)->moving) scree_case_walls(state)->ticks += ticks;
    state->evaluations++;

    // Forces at n + 1: contacts of bodies and plates, then the pressure and what else the boundary applies.
    if ((status = scree_neighbours_refresh(model, state, work, error))) return status;
    if ((status = scree_boundary_prepare(s->boundary, model, state, error))) return status;
    scree_contact_set_quanta(model, state, scree_boundary_bound(s->boundary, model, state));
    scree_contact_forces(model, state, work);
    scree_periodic_settle(state, work);
    work->next_kick = scree_integrator_next_kick(s->integrator, model, state, s->stage->loading);
    scree_boundary_forces(s->boundary, model, state, work);
    scree_forced_spin_settle(state);

    if (s->integrator->second) s->integrator->second(model, state, work);
    return scree_guard_step(s, error);
}
