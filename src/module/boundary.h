/// The face of a boundary: one file each (src/boundary/). A stage chooses its boundary (`boundary` of the stage); the
/// same prepared sample can so be loaded by each.
#ifndef SCREE_MODULE_BOUNDARY_H
#define SCREE_MODULE_BOUNDARY_H

#include "module/module.h"

struct scree_compression;
struct scree_demand;

typedef struct scree_boundary {
    // ---- traits ----
    uint32_t walls;    ///< bit w: plate w stands (those of the state's dimension, where the sample has an end)
    bool open;         ///< the bodies need not hang together: no Delaunay boundary or hull is kept, and no pressure
    bool periodic;     ///< the sample repeats itself in all directions, and its cell can be deformed
    bool stands;       ///< something stands around the sample on all sides
    bool free;         ///< no plates: forces on the boundary of the sample impose a velocity gradient
    bool round;        ///< can hold a round sample; a periodic one never is
    bool equal_steps;  ///< imposes velocities, for which all steps must have one size
    bool unpressed;    ///< may do without a pressure where bonds hold the bodies together
    bool full_mirrors; ///< a component of the velocity gradient beside the diagonal needs its mirror: a rotation would
                       ///< satisfy it alone

    // ---- which stages have it; each may be NULL ----
    /// The case leaves stage `index` no other; the first row of the table that says so counts.
    bool (*forced)(const scree_config *config, int64_t index);
    /// It takes the place of `boundary.lateral` until a stage chooses.
    bool (*standard)(const scree_config *config);

    // ---- what is wrong, as messages; NULL: nothing ----
    const char *needs_walls;    ///< where the case has no walls
    const char *needs_gradient; ///< where a stage demands no velocity gradient
    const char *needs_all;      ///< where a component of that is not given
    const char *needs_ends;     ///< where the sample repeats itself in some directions
    const char *needs_axis;     ///< where it does along its axis, in a stage that presses or shortens it
    const char *needs_rigid;    ///< where the bodies deform: forces of its own act on them, not at their centres
    const char *needs_lag;      ///< where their strains are those of the forces of the same step
    const char *kept;     ///< where another follows it; after a free one those that are not free, after others all
    const char *returned; ///< where it follows another

    /// Fills its numbers in the model, when some stage has it. NULL: none.
    scree_status (*resolve)(scree_model *model, scree_error *error);

    // ---- what it does ----
    /// When a stage begins with it: bodies of its own, resets. NULL: nothing to do.
    scree_status (*begin)(const scree_model *model, scree_state *state, scree_error *error);
    /// What it does in a step, besides the modules: forces at the present positions are added to the sums, which hold
    /// all others, in phase loads, when rows hold v(n - 1/2), with half their work; the other half in phase follow,
    /// when rows hold v(n + 1/2).
    const scree_pass *passes;
    size_t pass_count;
    /// As those of a module.
    double (*bound)(const scree_context *context);
    bool bound_differs;

    // ---- what stages ask of it; NULL where it cannot do that, or has nothing to do ----
    /// Time [s] that a longitudinal wave needs through the longer side of the sample at `pressure` [Pa].
    double (*wave_time)(const scree_context *context, double pressure);
    /// Height of the sample [m]: distance of the plates, of the faces of the cell. NULL: it follows from the strain.
    double (*height)(const scree_context *context);
    /// When a stage begins: measures the sample for its servos at this pressure, and imposes nothing.
    void (*fit)(const scree_context *context, double pressure);
    /// A stage begins in which nothing is imposed: its plates stand where they are.
    void (*rest)(const scree_context *context);
    /// A loading stage begins: displacements and strains count from here.
    void (*mark)(const scree_context *context);
    /// In the coming step: the pressure [Pa] on all sides, nothing else imposed.
    void (*hold)(const scree_context *context, double pressure);
    /// In the coming step: shortens the sample along its axis, under the pressure on the other sides.
    void (*compress)(const scree_context *context, const struct scree_compression *compression);
    /// In the coming step: `rise` of the rates of a demand, under the pressure where nothing is prescribed.
    void (*deform)(const scree_context *context, const struct scree_demand *demand, double rise);
    /// Stress of the sample as the boundary knows it at the present step [Pa, tension positive]. NULL: it does not.
    void (*stress)(const scree_context *context, double stress[9]);
    /// How far the stress is from `pressure`, relative to it, since the last call; *what: which stress.
    double (*stress_error)(const scree_context *context, double pressure, const char **what);
    double stress_tolerance; ///< 1, of it, unless the case says so
    double patience;         ///< wave times after which a sample that does not come to rest is an error
} scree_boundary;

#endif
