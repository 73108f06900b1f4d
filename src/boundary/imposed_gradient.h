/// What boundaries share that impose a motion through forces on the bodies of the Delaunay boundary
/// (*scree_imposed(&state)).
#ifndef SCREE_BOUNDARY_IMPOSED_GRADIENT_H
#define SCREE_BOUNDARY_IMPOSED_GRADIENT_H

#include "boundary/boundary.h"
#include "measure/imposed_gradient.h"
#include "state/work.h"

/// Forgets the forces and rates of an earlier stage; target, prescribed components and viscosity stay.
scree_status scree_imposed_begin(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Room for one force a node of the present boundary. Errors: memory.
scree_status scree_imposed_refresh(const scree_context *context, scree_error *error) SCREE_MUST_USE;

/// scree_imposed_add_work as a pass.
scree_status scree_imposed_work(const scree_context *context, scree_error *error) SCREE_MUST_USE;

/// Adds a force in quanta to the sum of a node and keeps it in force.
void scree_imposed_add(scree_state *state, size_t node, const int64_t quanta[3]);

/// Accumulates 1/2 F . v dt of the kept forces, with the velocities that rows hold now.
void scree_imposed_add_work(scree_state *state);

/// Velocity gradient of the boundary [1/s] with the velocities that rows hold now. area: a node. Returns the volume
/// inside [m3].
double scree_imposed_measure(const scree_state *state, scree_vector *area, double rate[9]);

/// Accumulates the rate of this step for the recorded ratio of actual and wanted rate.
void scree_imposed_record(scree_state *state, const double rate[9]);

/// Forces f = stress . a on all nodes, whose integers add up to zero exactly (facets.h; imposed_gradient.c tells how),
/// added to the sums and to force. stress [Pa], tension positive. quantum: that of the present step.
void scree_imposed_apply_stress(const scree_model *model, scree_state *state, const double stress[9]);

/// Where bodies deform: what forces stress . area at the surfaces of the nodes add to the moments that strain them,
/// with its work; before the strains of the next step are found. Errors: memory.
scree_status scree_imposed_strain(scree_state *state, scree_vector *area, const double stress[9],
                                  scree_error *error) SCREE_MUST_USE;

/// What stages ask of a boundary that imposes a velocity gradient (imposed_control.c).
double scree_imposed_wave_time(const scree_context *context, double pressure);
void scree_imposed_fit(const scree_context *context, double pressure);
void scree_imposed_compress(const scree_context *context, const scree_compression *compression);
void scree_imposed_deform(const scree_context *context, const scree_demand *demand, double rise);

/// The passes of such a boundary; add_forces: a pass, its forces and the first half of their work.
#define SCREE_IMPOSED_PASSES(add_forces)                                                                               \
    {                                                                                                                  \
        {SCREE_PHASE_FOLLOW, .run = scree_imposed_work}, {SCREE_PHASE_SEARCH, .run = scree_imposed_refresh},           \
        {                                                                                                              \
            SCREE_PHASE_LOADS, .run = add_forces                                                                       \
        }                                                                                                              \
    }

/// Its members that are always the same.
#define SCREE_IMPOSED                                                                                                  \
    .free = true, .round = true, .equal_steps = true,                                                                  \
    .needs_ends = "its forces act on the Delaunay boundary, which goes around a sample that does not repeat itself: "  \
                  "give boundary: plates, or make the sample periodic in all directions",                              \
    .kept = "plates cannot come back to a sample that has deformed freely: only minimal or affine can follow",         \
    .begin = scree_imposed_begin, .wave_time = scree_imposed_wave_time, .fit = scree_imposed_fit,                      \
    .compress = scree_imposed_compress, .deform = scree_imposed_deform, .patience = 400

#endif
