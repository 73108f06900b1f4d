/// Pressure applied directly to the Delaunay boundary (P 2.5): traction p times edge length times thickness, shared
/// equally by the two discs of the edge, along the inward normal of the edge.
#ifndef SCREE_BOUNDARY_PRESSURE_H
#define SCREE_BOUNDARY_PRESSURE_H

#include "state/work.h"

/// Re-finds the boundary loop if it is due (every config->boundary.every steps, or none yet): triangulates, cleans, marks
/// which edges carry the lateral pressure (those not facing an active top or bottom plate), closes the strain increment
/// of the old loop (measure of Bagi) before replacing it.
scree_status scree_boundary_refresh(const scree_model *model, scree_state *state, scree_work *work,
                                    scree_error *error) SCREE_MUST_USE;

/// Adds the pressure forces at the present positions to state->sum and work->loaded_*; first half of their work to the
/// ledger. Nothing when state->pressure is zero or there is no loop.
void scree_pressure_forces(const scree_model *model, scree_state *state, scree_work *work);

/// Second half of the work, after velocities have been kicked to n + 1/2.
void scree_pressure_work(const scree_model *model, scree_state *state, scree_work *work);

#endif
