/// Boundaries: one file a kind, one descriptor each, listed in boundary.c. A stage chooses its boundary
/// (`boundary` of the stage); the same prepared sample can so be loaded by each.
///
/// A boundary says which walls stand, and may add forces to the sums besides the pressure on the Delaunay boundary
/// (pressure.c), which acts wherever no wall stands. Every force it adds is booked by the rule of the ledger, half with
/// the velocity before it and half with the one after (measure/energy.c), and kept in the state for that.
#ifndef SCREE_BOUNDARY_BOUNDARY_H
#define SCREE_BOUNDARY_BOUNDARY_H

#include "contact/contact.h"
#include "measure/imposed_gradient.h"

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

    // ---- what stages ask of it; NULL where it cannot do that, or has nothing to do ----
    /// Time [s] that a longitudinal wave needs through the longer side of the sample at `pressure` [Pa].
    double (*wave_time)(const scree_context *context, double pressure);
    /// Height of the sample [m]: distance of the plates, of the faces of the cell. NULL: it follows from the strain.
    double (*height)(const scree_context *context);
    /// When a stage begins: measures the sample for its servos at this pressure, and imposes nothing.
    void (*fit)(const scree_context *context, double pressure);
    /// A loading stage begins: displacements and strains count from here.
    void (*mark)(const scree_context *context);
    /// In the coming step: the pressure [Pa] on all sides, nothing else imposed.
    void (*hold)(const scree_context *context, double pressure);
    /// In the coming step: shortens the sample along its axis, under the pressure on the other sides.
    void (*compress)(const scree_context *context, const scree_compression *compression);
    /// In the coming step: `rise` of the rates of a demand, under the pressure where nothing is prescribed.
    void (*deform)(const scree_context *context, const scree_demand *demand, double rise);
    /// How far the stress is from `pressure`, relative to it, since the last call; *what: which stress.
    double (*stress_error)(const scree_context *context, double pressure, const char **what);
    double stress_tolerance; ///< 1, of it, unless the case says so
    double patience;         ///< wave times after which a sample that does not come to rest is an error
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
