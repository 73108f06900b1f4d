/// The face of an integrator: one file a scheme (src/integrate/). A step is first(), forces at the new positions,
/// second().
#ifndef SCREE_MODULE_INTEGRATOR_H
#define SCREE_MODULE_INTEGRATOR_H

#include "module/module.h"

struct scree_work;

/// Lengths of steps, in ticks.
typedef struct scree_steps {
    uint64_t largest;  ///< of the step before loading, and of a sequence of steps while loading
    uint64_t multiple; ///< of the large steps of a sequence
    uint64_t small;    ///< number of steps of one tick after a large one
} scree_steps;

typedef struct scree_integrator {
    /// Lengths of the steps; `own`: of the section integrator. NULL: one tick each.
    scree_steps (*steps)(const void *own);
    /// Ticks of the next step of a loading stage. NULL: always the largest step of the model.
    uint64_t (*ticks)(const scree_model *model, const scree_state *state);
    /// Advances rows (and angles, largest_speed, work->budget) to positions n+1 from the sums at n.
    void (*first)(const scree_model *model, scree_state *state, struct scree_work *work);
    /// Finishes velocities with the sums at n+1. May be NULL.
    void (*second)(const scree_model *model, scree_state *state, struct scree_work *work);
    /// Velocity and spin at n of one that keeps more than velocities of the middle of the step, whose kinetic energy is
    /// theirs. NULL: they follow from velocity_lead and the sums, and the kinetic energy from those half a step away.
    void (*velocity)(const scree_model *model, const scree_state *state, size_t row, double velocity[3],
                     double spin[3]);
    /// Velocity, spin or mass of the body were set from outside: what it remembers of the motion is void. NULL:
    /// nothing.
    void (*begin_anew)(scree_state *state, size_t row);
    /// Largest omega dt with which an oscillator of this damping ratio stays bounded. NULL: that of a leapfrog whose
    /// dashpots follow the velocity of the middle of the step (model/critical_step.c).
    double (*limit)(double ratio);
    double velocity_lead; ///< stored velocity = v(n - 1/2) + velocity_lead * dt * a(n): 0 position, 1/2 velocity Verlet
} scree_integrator;

/// A leapfrog: its kick says which force a motion takes that is imposed.
static inline bool scree_scheme_is_leapfrog(const scree_module *scheme)
{
    return !scheme->integrator->velocity;
}

/// A leapfrog whose steps are all of one size.
static inline bool scree_scheme_has_equal_steps(const scree_module *scheme)
{
    return scree_scheme_is_leapfrog(scheme) && !scheme->integrator->steps;
}

/// That of a scheme: the slot of a module that is one.
static inline const scree_integrator *scree_integrator_get(int scheme)
{
    return scree_modules[scheme]->integrator;
}

#endif
