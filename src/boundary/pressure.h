/// Pressure applied directly to the Delaunay boundary (P 2.5): traction p times edge length times thickness, shared
/// equally by the two discs of the edge, along the inward normal of the edge; the gap between a corner disc and its
/// plate is loaded too, so that the lateral force is exactly p times the distance of the plates times the thickness.
/// In 3D the same on the triangles of the hull (hull.c), with hull.force and hull.loaded in the place of the loop's.
#ifndef SCREE_BOUNDARY_PRESSURE_H
#define SCREE_BOUNDARY_PRESSURE_H

#include "state/pressure.h"
#include "state/state.h"

/// Re-finds the boundary loop if it is due (every config->boundary.every steps, or none yet): triangulates, cleans,
/// marks which edges carry the lateral pressure (those not facing an active top or bottom plate: rule in
/// loaded_edges.c), closes the strain increment of the old loop (measure of Bagi) before replacing it. Errors: memory;
/// SCREE_ERROR_GUARD when the bodies cannot be triangulated (fewer than three, all on a line, two in one place). The
/// state is unchanged then.
scree_status scree_boundary_refresh(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Marks again which edges (triangles) of the present boundary carry the pressure, after walls have come or gone.
/// Errors: memory.
scree_status scree_boundary_mark_loaded(const scree_model *model, scree_state *state,
                                        scree_error *error) SCREE_MUST_USE;

/// Adds the pressure forces at the present positions to state->sum, keeps them in loop.fx, loop.fy, and accumulates the
/// half 1/2 F(n) . v(n-1/2) dt of their work. Call after scree_contact_forces and scree_boundary_refresh, before
/// `second`, with the quantum of this step set: rows then hold v(n-1/2) in both schemes. Nothing when there is no loop;
/// zeros the kept forces when scree_pressure_now(state) is zero.
void scree_pressure_forces(const scree_model *model, scree_state *state);

/// Largest force that the pressure may put on one body [N], for the quanta. Call after scree_boundary_refresh.
double scree_pressure_bound(const scree_model *model, const scree_state *state);

/// The other half of the work of the forces kept in the loop, 1/2 F(n) . v(n+1/2) dt. Call right after the integrator's
/// `first` of the next step, when rows hold v(n+1/2), before anything changes the loop.
void scree_pressure_work(scree_state *state);

#endif
