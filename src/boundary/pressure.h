/// Pressure applied directly to the Delaunay boundary (P 2.5): traction p times edge length times thickness, shared
/// equally by the two discs of the edge, along the inward normal of the edge.
#ifndef SCREE_BOUNDARY_PRESSURE_H
#define SCREE_BOUNDARY_PRESSURE_H

#include "state/work.h"

/// Re-finds the boundary loop if it is due (every config->boundary.every steps, or none yet): triangulates, cleans,
/// marks which edges carry the lateral pressure (those not facing an active top or bottom plate), closes the strain
/// increment of the old loop (measure of Bagi) before replacing it.
scree_status scree_boundary_refresh(const scree_model *model, scree_state *state, scree_work *work,
                                    scree_error *error) SCREE_MUST_USE;

/// Adds the pressure forces at the present positions to state->sum, keeps them in loop.fx, loop.fy, and books the half
/// 1/2 F(n) . v(n-1/2) dt of their work. Call after scree_contact_forces and scree_boundary_refresh, before `second`.
/// Nothing when state->pressure is zero or there is no loop.
void scree_pressure_forces(const scree_model *model, scree_state *state, scree_work *work);

/// Largest force that the pressure may put on one body [N], for the quanta.
double scree_pressure_bound(const scree_model *model, const scree_state *state);

/// The other half of the work of the forces kept in the loop, 1/2 F(n) . v(n+1/2) dt. Call right after the integrator's
/// `first` of the next step, when rows hold v(n+1/2), before anything changes the loop.
void scree_pressure_work(scree_state *state);

#endif
