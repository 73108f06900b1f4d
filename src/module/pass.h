/// Passes: functions of modules with the phase of the step in which they run. A stage begin puts those of all modules
/// in use into one array (run/step.c), by phase, then by row of the table of modules, the core's own first; the step
/// runs it.
#ifndef SCREE_MODULE_PASS_H
#define SCREE_MODULE_PASS_H

#include "base/error.h"

#include <stdbool.h>

typedef struct scree_model scree_model;
typedef struct scree_state scree_state;
typedef struct scree_work scree_work;

typedef enum scree_phase {
    SCREE_PHASE_DECIDE,      ///< stages and servos set velocities and rates from what is known at n
    SCREE_PHASE_FIRST_HALF,  ///< kick and drift: positions at n + 1; rows hold v(n + 1/2)
    SCREE_PHASE_FOLLOW,      ///< what moves by itself follows; second half of the work of the forces at n
    SCREE_PHASE_SEARCH,      ///< neighbour lists, outlines
    SCREE_PHASE_CONTACTS,    ///< quanta from the bounds, then contact forces, with those on ghosts added back; sums
                             ///< hold nothing else
    SCREE_PHASE_BODIES,      ///< from contacts to bodies; what a pass collects on ghosts it adds back itself
                             ///< (scree_comm_add_back)
    SCREE_PHASE_LOADS,       ///< all other forces, each on top of those before it; first half of their work
    SCREE_PHASE_RESULTANTS,  ///< loads that depend on the resultant of all others on a body: damping of its motion
    SCREE_PHASE_SECOND_HALF, ///< velocities with the forces at n + 1
    SCREE_PHASE_GUARD,
    SCREE_PHASE_COUNT
} scree_phase;

/// What a pass is given.
typedef struct scree_context {
    const scree_model *model; ///< of the stage: its friction
    scree_state *state;
    scree_work *work;
    const struct scree_boundary *boundary;
    struct scree_simulation *simulation; ///< of the passes of run/ alone
    double *gravity;                     ///< m/s2, that of `model`; the module of gravity sets it
    /// Contacts as measures see them (contact/contact.h), for columns and results: those of the sample, or of the end.
    /// A pass finds those of the last sample.
    const struct scree_contact_table *table;
} scree_context;

typedef struct scree_pass {
    scree_phase phase;
    scree_status (*run)(const scree_context *context, scree_error *error);
    /// Of a pass that in some steps looks at all bodies or changes which there are: whether it does in this one, found
    /// out by all processes together. The sample is then put together in each of them for the pass, and spread again
    /// behind it. In SCREE_PHASE_DECIDE only, where the contacts are those of the sums. NULL: never.
    scree_status (*whole)(const scree_context *context, bool *wanted, scree_error *error);
} scree_pass;

#endif
