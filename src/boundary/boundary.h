/// Boundaries: one file a kind, one descriptor each, listed in boundary.c. A stage chooses its boundary
/// (`boundary` of the stage); the same prepared sample can so be loaded by each.
///
/// A boundary says which walls stand, and may add forces to the sums besides the pressure on the Delaunay boundary
/// (pressure.c), which acts wherever no wall stands. Every force it adds is booked by the rule of the ledger, half with
/// the velocity before it and half with the one after (measure/energy.c), and kept in the state for that.
#ifndef SCREE_BOUNDARY_BOUNDARY_H
#define SCREE_BOUNDARY_BOUNDARY_H

#include "contact/contact.h"

typedef struct scree_boundary {
    const char *name;
    uint32_t walls; ///< bit w: wall w stands (those of the state's dimension)
    bool open;      ///< the bodies need not hang together: no Delaunay boundary or hull is kept, and no pressure
    /// When a stage begins with it: bodies of its own, resets. NULL: nothing to do.
    scree_status (*begin)(const scree_model *model, scree_state *state, scree_error *error);
    /// What it does in a step, besides the modules: forces at the present positions are added to the sums, which hold
    /// all others, in phase loads, when rows hold v(n - 1/2), with half their work; the other half in phase follow,
    /// when rows hold v(n + 1/2).
    const scree_pass *passes;
    size_t pass_count;
    /// As that of a module.
    double (*bound)(const scree_context *context);
} scree_boundary;

const scree_boundary *scree_boundary_get(scree_boundary_kind kind);
extern const scree_boundary scree_boundary_none;
extern const scree_boundary scree_boundary_pressure;
extern const scree_boundary scree_boundary_plates;
extern const scree_boundary scree_boundary_membrane;
extern const scree_boundary scree_boundary_minimal;
extern const scree_boundary scree_boundary_affine;
extern const scree_boundary scree_boundary_walls;
extern const scree_boundary scree_boundary_periodic;
extern const scree_boundary scree_boundary_channel;

/// Both axial plates, bottom and top, stand.
bool scree_boundary_has_plates(const scree_boundary *boundary);

/// Changes the walls to those of `boundary` and begins it. `table`: contacts at the present step; the elastic energy of
/// those with a wall that goes leaves the ledger with it. changed: walls or bodies are others than before, and contact
/// lists have to be made anew. Errors: the boundary's own, memory.
scree_status scree_boundary_begin(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                  const scree_contact_table *table, bool *changed, scree_error *error) SCREE_MUST_USE;

#endif
