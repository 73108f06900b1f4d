/// Position Verlet (Padbidri 2010, eq. 1.6): x(n+1) = 2 x(n) - x(n-1) + a(n) dt^2, kept in its identical increment form
/// v(n+1/2) = v(n-1/2) + a(n) dt, x(n+1) = x(n) + v(n+1/2) dt, which loses no digits in the difference of positions and
/// needs one pass. The stored velocity is (x(n) - x(n-1)) / dt = v(n-1/2).
/// Order: 2 for forces of positions; 1 for forces of velocities, which are evaluated half a step behind.
#include "integrate/kick.h"
#include "module/key_rows.h"

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_kick_and_drift(model, state, work, state->step_size);
}

static const scree_integrator integrator = {
    .first = first,
    .velocity_lead = 0.0,
};

const scree_module scree_module_position_verlet = {
    .name = "position_verlet",
    .meaning = "leapfrog with velocities half a step behind",
    .choice_of = CHOICE_OF(IS("integrator.scheme")),
    .integrator = &integrator,
    .spreads = true,
};
