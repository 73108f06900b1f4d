/// Gravity of a case: what it is at a time, and its change where a stage has its own.
#ifndef SCREE_LOAD_GRAVITY_H
#define SCREE_LOAD_GRAVITY_H

#include "state/work.h"

/// Acceleration [m/s2] `ticks` after the step that the state is at, in the stage that it is in: that of the stage,
/// which follows the time since it began, or that of the case, which follows the time of the run. A pure function of
/// time.
void scree_gravity_find(const scree_model *model, const scree_state *state, uint64_t ticks, double gravity[3]);

/// Whether the ramps and tables that gravity follows in the stage that the state is in have come to their last value;
/// of a harmonic, which has none, always.
bool scree_gravity_is_final(const scree_model *model, const scree_state *state);

/// Sets model->gravity to what acts now in the stage that the state is in. The balance is told of the jump at its begin
/// where `told`: the discrete kinetic energy holds F(n) (measure/energy.c), so it changes too, as if gravity had done
/// that work at once; of first order in the step.
void scree_gravity_enter(scree_model *model, scree_state *state, bool told);

#endif
