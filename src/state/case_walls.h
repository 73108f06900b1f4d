/// The walls of a case in a run: whether they move, and what the bodies do to them. Their geometry is in
/// shape/wall_set.h.
#ifndef SCREE_STATE_CASE_WALLS_H
#define SCREE_STATE_CASE_WALLS_H

#include "state/state.h"

/// What the bodies do to a wall of the case, and what a servo has made of it.
typedef struct scree_surface_load {
    scree_vector force;  ///< N, by the bodies on the wall at n
    scree_vector torque; ///< N m, the same about its centre at n
    double work;         ///< J, of the wall on the bodies since the begin of the run
    double travel;       ///< m, of a wall under servo, along its direction
    double speed;        ///< m/s, of it in the last step
} scree_surface_load;

/// State of the module `case_walls`.
typedef struct scree_case_wall_set {
    scree_surface_load load[SCREE_SURFACES]; ///< in the order of the case
    uint64_t ticks;                          ///< for which they have been moving
    uint64_t moving;                         ///< 1: they move now
    double speed;                            ///< m/s, bound of their velocity now
} scree_case_wall_set;

/// Time of the walls at the step of the state [s]; never accumulated.
static inline double scree_case_walls_time(const scree_case_wall_set *walls, const scree_state *state)
{
    return (double)walls->ticks * state->tick;
}

static inline scree_case_wall_set *scree_case_walls(const scree_state *state)
{
    return state->own[SCREE_SLOT_case_walls];
}

/// A bit for each wall of the case that moves in this step.
uint64_t scree_case_walls_that_move(const scree_model *model, const scree_state *state);

#endif
