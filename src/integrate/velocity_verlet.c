/// Velocity Verlet (Swope, Andersen, Berens and Wilson 1982): half a kick, drift, forces, half a kick. Stored
/// velocities belong to the same instant as positions; contact forces see v(n+1/2), as in every code that uses this
/// scheme for grains. Order: 2 for forces of positions; 1 for forces of velocities. Costs one pass over the bodies more
/// than position Verlet, with which it shares its trajectory when started alike (tests/unit/test_integrate.c).
#include "integrate/kick.h"
#include "module/key_rows.h"

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_kick_and_drift(model, state, work, 0.5 * state->step_size);
}

static void second(const scree_model *model, scree_state *state, scree_work *work)
{
    (void)scree_kick(model, state, work, 0.5 * state->step_size, false);
}

static const scree_integrator integrator = {
    .first = first,
    .second = second,
    .velocity_lead = 0.5,
};

const scree_module scree_module_velocity_verlet = {
    .name = "velocity_verlet",
    .meaning = "velocities and positions at the same time",
    .choice_of = CHOICE_OF(IS("integrator.scheme")),
    .integrator = &integrator,
    .spreads = true,
};
