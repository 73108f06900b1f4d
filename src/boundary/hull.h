/// The triangulated hull as the place of the lateral pressure in three dimensions; private to pressure.c, which has the
/// loop of 2D beside it.
#ifndef SCREE_BOUNDARY_HULL_H
#define SCREE_BOUNDARY_HULL_H

#include "state/pressure.h"
#include "state/state.h"

/// Finds the hull of the present positions, marks its loads, closes the strain increment of the old one and takes its
/// place. Errors: memory, SCREE_ERROR_GUARD; the state is unchanged then.
scree_status scree_hull_renew(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Keeps the forces of scree_pressure_now(state) at the present positions in hull.force, rounded to `quantum` [N]; with
/// `adds` these quanta are those of the state, and go to the sums as well.
void scree_hull_press(scree_state *state, double quantum, bool adds);

/// A bound of the force of the pressure on a body [N], for the quanta.
double scree_hull_pressure_bound(const scree_model *model, const scree_state *state);

/// Power of the kept forces on the velocities that the rows hold [W].
double scree_hull_power(const scree_state *state);

#endif
