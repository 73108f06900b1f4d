/// Bonds: pairs of the persistent list (state/persistent.h) whose law pulls, until they break. How many there were,
/// what broke and when, and the energy that went with it.
///
/// A bond is a member of the persistent list with the strengths that it was made with (make.h); it breaks in the step
/// in which its forces reach them (contact/settle.h), one that has broken stays a member until its bodies have parted,
/// and then leaves the list without a word. Breaks of one step are events in the order of ids.
#ifndef SCREE_BOND_BOND_H
#define SCREE_BOND_BOND_H

#include "state/state.h"

/// How a bond broke, as files have it.
enum { SCREE_BREAK_TENSION = 0, SCREE_BREAK_SHEAR = 1 };

/// A bond that broke, with the forces that it had.
typedef struct scree_break {
    double time;             ///< s
    uint64_t step;           ///< ticks
    uint32_t first, second;  ///< ids
    uint32_t mode;           ///< SCREE_BREAK_...
    scree_vector place;      ///< m, of the contact on the first body
    scree_vector normal;     ///< from second to first
    double normal_force;     ///< N, negative in tension
    double tangential_force; ///< N, magnitude
    double energy;           ///< J, that went as fracture
} scree_break;

/// State of the module `bonds`.
typedef struct scree_bonds {
    scree_break *event; ///< count, in the order in which they broke, of one step by ids
    size_t count, capacity;
    uint64_t made;   ///< bonds
    double fracture; ///< J, that went with bonds that broke
    double bonding;  ///< J, that contacts had where bonds took their place
} scree_bonds;

static inline scree_bonds *scree_bonds_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_bonds];
}

/// Bonds that stand, of all processes where the state is a part; all of them call it then.
size_t scree_bonds_standing(const scree_state *state);

#endif
