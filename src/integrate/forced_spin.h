/// A body whose spin is prescribed (P 4.2).
#ifndef SCREE_INTEGRATE_FORCED_SPIN_H
#define SCREE_INTEGRATE_FORCED_SPIN_H

#include "state/state.h"

/// State of the module `forced_spin`.
typedef struct scree_forced_spin {
    int64_t active; ///< 0: there is none
    int64_t id;
    scree_vector spin;   ///< rad/s, at n - 1/2
    scree_vector torque; ///< N m, by its contacts at n
} scree_forced_spin;

static inline scree_forced_spin *scree_forced(const scree_state *state)
{
    return state->own[SCREE_SLOT_forced_spin];
}

/// From now on the body with this id turns as prescribed. Its rotational energy passes to the ledger, and back with the
/// end; the end of none is harmless.
void scree_forced_spin_begin(scree_state *state, uint32_t id);
void scree_forced_spin_end(scree_state *state);

/// Sets the spin [rad/s] of the coming step. Call before the integrator's `first`.
void scree_forced_spin_set(scree_state *state, const scree_vector spin);

/// Takes the torque of the contacts off the body, and accumulates the work of the step. Call when the sums are
/// complete.
void scree_forced_spin_settle(scree_state *state);

#endif
