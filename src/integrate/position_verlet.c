/// Position Verlet (Padbidri 2010, eq. 1.6): x(n+1) = 2 x(n) - x(n-1) + a(n) dt^2, kept in its identical increment form
/// v(n+1/2) = v(n-1/2) + a(n) dt, x(n+1) = x(n) + v(n+1/2) dt, which loses no digits in the difference of positions and
/// needs one pass. The stored velocity is (x(n) - x(n-1)) / dt = v(n-1/2).
/// Order: 2 for forces of positions; 1 for forces of velocities, which are evaluated half a step behind.
#include "integrate/kick.h"
#include "integrate/schemes.h"

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_kick_book(state, work, scree_kick(model, state, work, state->step_size, true));
}

const scree_integrator scree_position_verlet = {
    .name = "position_verlet",
    .meaning = "x(n+1) = 2 x(n) - x(n-1) + a dt^2 (Padbidri 2010, 1.6); velocities live at half steps; one pass",
    .first = first,
    .second = NULL,
    .velocity_lead = 0.0,
};
