/// Two timescales, m(n+q) (Padbidri 2010, 2.4): rotations, the fast variables, go astray in a large step and come back
/// in the small ones that follow. With the tick dt a sequence is one step of n dt, then q steps of dt; m sequences make
/// up N_S = m(n+q) ticks, the large step of P. Cost: (1+q)/(n+q) of the force evaluations of small steps alone. Limits:
/// q = 0 is position_verlet with the step n dt (P's scheme I), n = 1 the same with dt (scheme III), bit for bit.
///
/// Only loading stages are integrated by sequences; before them every step is N_S dt. So all sequences of one N_S load
/// the same sample, and samples, at multiples of N_S ticks, are taken at the same times and at the end of the small
/// steps. A stage begins with the large step; the place in the sequence follows from the ticks since then.
///
/// Steps h(n) = t(n+1) - t(n) that differ: the leapfrog of position Verlet becomes
///     v(n+1/2) = v(n-1/2) + (h(n-1) + h(n))/2 a(n),     x(n+1) = x(n) + h(n) v(n+1/2),
/// whose second difference 2 ((x(n+1) - x(n))/h(n) - (x(n) - x(n-1))/h(n-1)) / (h(n-1) + h(n)) = a(n) is of first order
/// only where the step changes. But with v(n) = v(n-1/2) + h(n-1)/2 a(n) it is velocity Verlet with the steps h(n),
/// each of them of second order and symplectic for itself: the order is 2 for any sequence of steps. Order: 2 for
/// forces of positions; 1 for forces of velocities, which are evaluated half a step behind. Sequences are no longer
/// symmetric in time, so energy is not bounded by symmetry; each step conserves its own discrete energy and the ledger
/// books what a change of the step does to it (measure/energy.c).
#include "integrate/kick.h"
#include "integrate/schemes.h"

static uint64_t ticks(const scree_model *model, const scree_state *state)
{
    uint64_t sequence = model->large_multiple + model->small_steps;
    return (state->step - state->stage.first_step) % sequence == 0 ? model->large_multiple : 1;
}

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_kick_book(state, work, scree_kick(model, state, work, state->kick_size, true));
}

const scree_integrator scree_two_timescales = {
    .name = "two_timescales",
    .meaning = "position Verlet with m sequences of one large and q small steps (Padbidri 2010, 2.4)",
    .ticks = ticks,
    .first = first,
    .second = NULL,
    .velocity_lead = 0.0,
};
