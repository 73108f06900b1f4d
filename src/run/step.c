/// The step. Between two steps the state holds x(n), the scheme's velocity and the force sums at n; a restart begins
/// here.
#include "run/step.h"

#include "boundary/cell.h"
#include "boundary/plates.h"
#include "run/guard.h"
#include "search/neighbours.h"

scree_status scree_step(scree_simulation *s, scree_error *error)
{
    const scree_model *model = &s->stage_model;
    scree_state *state = &s->state;
    scree_work *work = &s->work;
    scree_status status;

    // Boundaries decide their velocities from the stresses at n, then everything moves to n + 1.
    if (s->stage->control) s->stage->control(s);
    scree_plates_move(state);
    s->integrator->first(model, state, work);
    scree_boundary_finish_work(s->boundary, state);
    if ((status = scree_cell_move(model, state, work, error))) return status;
    state->step++;

    // Forces at n + 1: contacts of bodies and plates, then the pressure and what else the boundary applies.
    if ((status = scree_neighbours_refresh(model, state, work, error))) return status;
    if ((status = scree_boundary_prepare(s->boundary, model, state, error))) return status;
    scree_contact_set_quanta(model, state, scree_boundary_bound(s->boundary, model, state));
    scree_contact_forces(model, state, work);
    scree_cell_settle(state, work);
    scree_boundary_forces(s->boundary, model, state, work);

    if (s->integrator->second) s->integrator->second(model, state, work);
    return scree_guard_step(s, error);
}
