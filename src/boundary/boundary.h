/// Boundaries: one file a kind, one descriptor each, with the face of module/boundary.h.
///
/// A boundary says which walls stand, and may add forces to the sums besides the pressure on the Delaunay boundary
/// (pressure.c), which acts wherever no wall stands. Every force it adds is accumulated by the rule of the ledger, half
/// with the velocity before it and half with the one after (measure/energy.c), and kept in the state for that.
#ifndef SCREE_BOUNDARY_BOUNDARY_H
#define SCREE_BOUNDARY_BOUNDARY_H

#include "contact/contact.h"
#include "measure/imposed_gradient.h"
#include "module/boundary.h"
#include "state/plates.h"

/// Axial compression in the coming step.
typedef struct scree_compression {
    double rate;   ///< 1/s, at the full rate, referred to the height at the begin
    double rise;   ///< 1, share of it in this step
    double strain; ///< 1, engineering, that the rate has led to so far
    double height; ///< m, at the begin
} scree_compression;

/// What a stage demands of the velocity gradient of the sample, 3 x 3 by rows, extension positive.
typedef struct scree_demand {
    double rate[9];   ///< 1/s, at the full rate
    int64_t how[9];   ///< of each component: scree_prescription
    double stress[9]; ///< Pa, tension positive, that a periodic cell holds by this component; NAN: none
    double scale;     ///< 1/s, of the rates that are held back where all demanded ones are zero
} scree_demand;

/// Plates, as masks of `walls`.
enum {
    SCREE_AXIAL_WALLS = 1U << SCREE_WALL_BOTTOM | 1U << SCREE_WALL_TOP,
    SCREE_SIDE_WALLS = 1U << SCREE_WALL_LEFT | 1U << SCREE_WALL_RIGHT | 1U << SCREE_WALL_FRONT | 1U << SCREE_WALL_BACK
};

/// Both axial plates, bottom and top, stand.
bool scree_boundary_has_plates(const scree_boundary *boundary);

/// Changes the walls to those of `boundary` and begins it. `table`: contacts at the present step; the elastic energy of
/// those with a wall that goes leaves the ledger with it; so does the motion of the sample as a rigid body where the
/// boundary is free. changed: walls or bodies are others than before, and contact
/// lists have to be made anew. Errors: the boundary's own, memory.
scree_status scree_boundary_begin(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                  const scree_contact_table *table, bool *changed, scree_error *error) SCREE_MUST_USE;

#endif
