/// Held pairs of which the law says that they break, or that they are broken and have parted (law_force.settle).
///
/// A bond that breaks at n is replaced at n by the contact that its two bodies then have: at the same rest, without
/// tension, its tangential spring no longer than friction allows. Sums, moments and virial take the difference, as
/// integers that are opposite for the two bodies. So the forces at n, which a restart has, are those of the broken one.
///
/// Energy. The kinetic energy of the ledger, sum 1/2 m v(n-1/2) . v(n+1/2) (measure/energy.c), falls by half of what
/// the force that goes would have worked in the step before; the rest of what the springs lose is fracture:
///   E - E' - 1/2 [(f_n - f_n') d' - (f_t - f_t') . s] dt                      E: of both springs; primes: broken
/// with the rates d', s of the middle of that step (kinematics.h), so that the balance stays as closed as it was.
#ifndef SCREE_CONTACT_SETTLE_H
#define SCREE_CONTACT_SETTLE_H

#include "contact/contact.h"
#include "contact/single.h"

/// One of them, with what it exerted while it stood.
typedef struct contact_settled {
    size_t pair;             ///< number in the list, of a part in that of its process
    uint32_t first, second;  ///< ids
    bool parted;             ///< was broken before: nothing happens to its forces
    bool in_tension;         ///< broke in tension; else in shear
    scree_vector place;      ///< m, of the contact on the first body
    scree_vector normal;     ///< from second to first
    double normal_force;     ///< N
    double tangential_force; ///< N, magnitude
    double energy;           ///< J, fracture
    double virial[2][9];     ///< J, what goes and what comes
} contact_settled;

/// Breaks what has to break in the forces of this step, and finds what has parted; in the order of ids, of a part that
/// of all processes, which call it together. For the phase of contacts, behind their forces. Release *settled. Errors:
/// memory, nothing has changed then. Cost: a pass over the held pairs.
scree_status contact_settle(const scree_model *model, scree_state *state, scree_work *work, contact_settled **settled,
                            size_t *count, scree_error *error) SCREE_MUST_USE;

/// Puts what a pair exerts `after` in place of what it exerted `before` into the sums of two bodies, and into moments.
/// Both evaluated in the quanta of the state; NULL: nothing. virial [J]: what goes and what comes (contact_add_virial).
void contact_exchange(scree_state *state, uint32_t first, uint32_t second, const contact_evaluation *before,
                      const contact_evaluation *after, double virial[2][9]);

/// Adds it to that of a cell in motion.
void contact_add_virial(scree_state *state, const double virial[2][9]);

#endif
