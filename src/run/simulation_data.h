/// What a simulation in memory consists of: the case, its model, the state, the work, and the stage that runs now.
#ifndef SCREE_RUN_SIMULATION_DATA_H
#define SCREE_RUN_SIMULATION_DATA_H

#include "boundary/boundary.h"
#include "case/case.h"
#include "contact/contact.h"
#include "integrate/integrate.h"
#include "run/columns.h"
#include "run/stage_face.h"

#include <scree/simulation.h>

enum { SCREE_PASSES = 64 }; ///< most passes of a step

/// state.stage.counter of a stage that has not begun, and of one that has ended. It stays the present one, for whoever
/// looks at it or stores it, until the next step.
enum { SCREE_STAGE_NOT_BEGUN = -1, SCREE_STAGE_ENDED = -2 };

/// The forces of the program that uses the library (run/own_force.h). No part of the state: a program registers its
/// functions anew.
typedef struct scree_own_force_list {
    scree_own_force *force; ///< with names of their own
    size_t count, capacity;
    bool called; ///< one of them runs now
} scree_own_force_list;

struct scree_simulation {
    const scree_case *c;
    scree_model model;       ///< of the case
    scree_model stage_model; ///< with the friction of the present stage; what the kernels see
    const scree_integrator *integrator;
    scree_state state;
    scree_work work;
    scree_contact_table table;       ///< at the last sample; of a sample in parts the contacts of this process
    const scree_stage *stage;        ///< NULL when the case has ended
    const scree_boundary *boundary;  ///< of the present stage
    scree_pass passes[SCREE_PASSES]; ///< of the step of this stage, in their order
    size_t pass_count;
    double (*bounds[SCREE_MODULE_COUNT])(const scree_context *context); ///< of the loads of all modules
    size_t bound_count;
    bool moments;       ///< a module that is in use reads the moments of contact forces
    bool bounds_differ; ///< bounds are those of the bodies of a process
    bool flags_late;    ///< a module that is in use flags bodies behind the contact forces
    scree_stage_plan plan;
    scree_columns columns;                        ///< of series.csv
    double *sample;                               ///< the last row of them
    bool has_sample;                              ///< there is a last one
    uint64_t samples_in_parts, samples_of_wholes; ///< taken since the begin of the process
    double in_steps;   ///< s of wall time in steps since then, without begins of stages, samples and files
    bool sampled;      ///< the last step made a sample
    bool stage_ended;  ///< the last step ended a stage
    char reason[192];  ///< why it ended
    char warning[512]; ///< what a check has found, until it has been told; empty: nothing
    bool whole;        ///< a step that failed has not begun: the state can be gone on from
    scree_own_force_list forces;
    scree_contact_point *points; ///< what the library has handed out
    size_t point_capacity;
    scree_error stopped; ///< why no further step can be taken; its status is 0 while there is no reason
};

/// What passes of this simulation are given.
static inline scree_context scree_step_context(scree_simulation *s)
{
    return (scree_context){&s->stage_model, &s->state, &s->work, s->boundary, s, s->stage_model.gravity, &s->table};
}

#endif
