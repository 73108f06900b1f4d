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
/// accumulates what a change of the step does to it (measure/energy.c).
#include "integrate/two_timescales.h"

#include "case/check.h"
#include "integrate/kick.h"
#include "module/key_rows.h"

typedef scree_two_timescales_config config;
static const scree_key keys[] = {
    INTEGER(config, repeats, .standard = "5", FROM("1"), TO("1e6"), .when = "scheme=two_timescales",
            .meaning = "m of m(n+q): sequences in N_S = m(n+q) small steps. N_S steps are the step before loading, and "
                       "the unit of boundary.every."),
    INTEGER(config, large_multiple, .standard = "5", FROM("1"), TO("1e6"), .when = "scheme=two_timescales",
            .meaning = "n of m(n+q): the large step of a sequence, in small steps."),
    INTEGER(config, small_steps, .standard = "5", FROM("0"), TO("1e6"), .when = "scheme=two_timescales",
            .meaning = "q of m(n+q): small steps after each large one."),
};

static const config *own_config(const void *own)
{
    return scree_config_own(&scree_module_two_timescales, "integrator", own);
}

static scree_steps steps(const void *own)
{
    const config *c = own_config(own);
    uint64_t multiple = (uint64_t)c->large_multiple, small = (uint64_t)c->small_steps;
    return (scree_steps){.largest = (uint64_t)c->repeats * (multiple + small), .multiple = multiple, .small = small};
}

/// What reckons with a kick of the size of the last step cannot stand steps of two sizes.
static void rules(scree_reader *reader, const scree_config *whole)
{
    const char *const path = "integrator.scheme";
    for (int64_t i = 0; i < whole->stage_count; i++) {
        const scree_boundary *boundary = scree_config_held_by(whole, i);
        if (!boundary || !boundary->equal_steps) continue;
        scree_rule_refuse(reader, path, scree_rule_choices(reader, path, ", ", scree_scheme_has_equal_steps),
                          "the boundary of stages.%lld imposes velocities and needs equal steps", (long long)i);
        return;
    }
}

static uint64_t ticks(const scree_model *model, const scree_state *state)
{
    uint64_t sequence = model->large_multiple + model->small_steps;
    return (state->step - state->stage.first_step) % sequence == 0 ? model->large_multiple : 1;
}

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_kick_and_drift(model, state, work, state->kick_size);
}

static const scree_integrator integrator = {.steps = steps, .ticks = ticks, .first = first, .velocity_lead = 0.0};

const scree_module scree_module_two_timescales = {
    .name = "two_timescales",
    .meaning =
        "leapfrog of positions that repeats one large and several small steps while loading (Padbidri 2010, 2.4)",
    .choice_of = CHOICE_OF(IS("integrator.scheme")),
    .keys = (const scree_keys[]){KEYS_OF("integrator", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .integrator = &integrator,
    .spreads = true,
};
