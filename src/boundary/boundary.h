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
    bool open;      ///< bodies have no boundary at all, and no hull is kept
    uint32_t walls; ///< bit w: wall w stands (those of the state's dimension)
    /// When a stage begins with it: bodies of its own, resets. NULL: nothing to do.
    scree_status (*begin)(const scree_model *model, scree_state *state, scree_error *error);
    /// In every step, after the Delaunay boundary: memory for what it keeps a body. NULL: nothing to do.
    scree_status (*refresh)(const scree_model *model, scree_state *state, scree_error *error);
    /// Largest force that it may put on one body in this step [N], for the quanta; up to 2^10 times more is safe. NULL:
    /// no forces besides the pressure.
    double (*bound)(const scree_model *model, const scree_state *state);
    /// Adds its forces at the present positions to the sums, which hold all others; rows hold v(n - 1/2). Books half
    /// their work.
    void (*forces)(const scree_model *model, scree_state *state, scree_work *work);
    /// The other half, when rows hold v(n + 1/2).
    void (*work)(scree_state *state);
} scree_boundary;

const scree_boundary *scree_boundary_get(scree_boundary_kind kind);
extern const scree_boundary scree_boundary_none;
extern const scree_boundary scree_boundary_pressure;
extern const scree_boundary scree_boundary_plates;
extern const scree_boundary scree_boundary_membrane;
extern const scree_boundary scree_boundary_minimal;
extern const scree_boundary scree_boundary_affine;
extern const scree_boundary scree_boundary_periodic;
extern const scree_boundary scree_boundary_channel;

/// Both axial plates, bottom and top, stand.
bool scree_boundary_has_plates(const scree_boundary *boundary);

/// Changes the walls to those of `boundary` and begins it. `table`: contacts at the present step; the elastic energy of
/// those with a wall that goes leaves the ledger with it. changed: walls or bodies are others than before, and contact
/// lists have to be made anew. Errors: the boundary's own, memory.
scree_status scree_boundary_begin(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                  const scree_contact_table *table, bool *changed, scree_error *error) SCREE_MUST_USE;

/// The four calls of a step, in their order, for the pressure and for what `boundary` does besides.
void scree_boundary_finish_work(const scree_boundary *boundary, scree_state *state);
scree_status scree_boundary_prepare(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                    scree_error *error) SCREE_MUST_USE;
double scree_boundary_bound(const scree_boundary *boundary, const scree_model *model, const scree_state *state);
void scree_boundary_forces(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                           scree_work *work);

#endif
