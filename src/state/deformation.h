/// Bodies that deform uniformly (contact/deformation.c): what the run remembers of them beside state->stretch.
#ifndef SCREE_STATE_DEFORMATION_H
#define SCREE_STATE_DEFORMATION_H

#include "state/state.h"

/// What the implicit strain needs of n while n + 1 is sought: symmetric, xx, yy, xy in 2D; xx, yy, zz, yz, xz, xy.
typedef struct scree_departed {
    double stretch[6]; ///< m, at n
    double force[6];   ///< N, moments over the radius at n
    double step[6];    ///< m, the last step of the search
} scree_departed;

/// Moments over the radius of the loads that act on the surface of a body [N], at its present place: symmetric, in the
/// same order.
typedef struct scree_surface_force {
    double force[6];
} scree_surface_force;

/// State of the module `deformation`.
typedef struct scree_deformation {
    double given;         ///< J, energy that the bodies have taken up with their strains: stored, and lost by the lag
    double largest_reach; ///< m, of all bodies: no surface has moved out by more
    double growth;        ///< m, largest way that a surface goes in the step that comes to its forces (derived)
    double *term;         ///< J, one a body: work of the present change of its strain (derived)
    uint64_t attacked;    ///< 1: there is something in `attack` (derived)
    scree_surface_force *attack; ///< one a body: what loads add from the first half of a step on (derived)
    scree_departed *departed;    ///< one a body, of the implicit strain (derived)
} scree_deformation;

static inline scree_deformation *scree_deformation_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_deformation];
}

/// Loads put something on surfaces in this step: said before the first of them, and in all processes alike, since a body
/// that is loaded may go to one that has had none.
static inline void scree_deformation_await_attack(const scree_state *state)
{
    scree_deformation_of(state)->attacked = scree_deformation_of(state)->attack != NULL;
}

/// Adds what a load puts on the surface of a body, force [N] at `arm` [m] from its centre: in the phases `follow` and
/// `search`, at the places of n + 1. Nothing where bodies are rigid.
static inline void scree_deformation_attack(const scree_state *state, size_t row, const double arm[3],
                                            const double force[3])
{
    static const int plane[][2] = {{0, 0}, {1, 1}, {0, 1}},
                     space[][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const int(*place)[2] = state->dimension == 3 ? space : plane, size = state->dimension == 3 ? 6 : 3;
    scree_surface_force *attack = scree_deformation_of(state)->attack;
    const double half = 0.5 / state->row[row].radius;
    for (int k = 0; k < size && attack; k++)
        attack[row].force[k] += half * (arm[place[k][0]] * force[place[k][1]] + arm[place[k][1]] * force[place[k][0]]);
}

#endif
