/// Forces of the program that uses the library: functions that it has registered, called in every step. The method is
/// in own_force.c.
#ifndef SCREE_RUN_OWN_FORCE_H
#define SCREE_RUN_OWN_FORCE_H

#include "run/simulation_data.h"

void scree_own_force_list_destroy(scree_own_force_list *list);

/// State of the module `own_force`: the forces of the last step, by id.
typedef struct scree_own_loads {
    int64_t registered; ///< functions that make them
    size_t count;       ///< bodies; 0: there were none
    size_t capacity;
    int64_t (*force)[3];  ///< state.force_quantum
    int64_t (*torque)[3]; ///< state.torque_quantum
} scree_own_loads;

static inline scree_own_loads *scree_own_loads_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_own_force];
}

#endif
