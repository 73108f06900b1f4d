/// What a stage says of itself before there is a simulation: what rules and the model ask. What it does while a run
/// steps is its other face (run/stage.h).
#ifndef SCREE_MODULE_STAGE_H
#define SCREE_MODULE_STAGE_H

#include "module/module.h"

struct scree_config_stage;

/// When bodies may sleep (integrate/sleep.c).
typedef struct scree_sleep_limits {
    double window;   ///< s, for which a body must be quiet before it sleeps; NAN: none sleeps
    double force;    ///< 1, resultant over weight (torque: over weight and radius) below which it is quiet
    double motion;   ///< 1, way of its surface in the window at its present speed, over its radius, below which it is
    double wake;     ///< 1, mean resultant of a window over weight above which it wakes
    double interval; ///< s, after which all wake
} scree_sleep_limits;
/// Windows for which none falls asleep after all have woken.
#define SCREE_SLEEP_HOLD 4

/// `config` is the stage's own struct, in which its keys are.
typedef struct scree_stage_numbers {
    bool places;   ///< places the particles: the first stage of a case, and no other
    bool instant;  ///< takes no steps: no boundary matters to it, and it may stand anywhere behind the first
    bool bonds;    ///< makes bonds
    bool held;     ///< something holds the sample, which has the keys boundary and friction
    bool settles;  ///< waits until the sample is at rest under the pressure
    bool pours;    ///< sources let grains go
    bool still;    ///< no particle moves: there is no critical step
    bool collides; ///< nothing holds or drives the bodies, which meet and part
    const char *needs_pressure; ///< what is wrong where no stage before settles; NULL: it needs none
    bool (*strains_all)(const void *own, int dimension); ///< whether it drives all normal components; NULL: no
    const char *needs_approach; ///< what is wrong where the particles cannot be about to collide; NULL: they need not
    const char *needs_standing; ///< what is wrong where nothing stands around the sample; NULL: nothing need stand
    const char *needs_free;     ///< what is wrong where plates stand, since it imposes a velocity gradient; names of
                                ///< boundaries that take one follow. NULL: they may stand
    /// Largest normal stress that it holds [Pa, compression positive], NAN: none. NULL: holds none.
    double (*pressure)(const void *config);
    /// Strain rate that it imposes [1/s], of several components the largest, on the sample that the model expects.
    /// NULL: it loads nothing.
    double (*rate)(const scree_model *model, const void *config);
    /// Strain at which it ends. NULL: none.
    double (*strain)(const void *config);
    /// When its bodies may sleep. NULL: never.
    scree_sleep_limits (*sleep)(const void *config);
    /// What is wrong with the keys of the stage `index` of a case, and under which; NULL: nothing. NULL: never
    /// anything.
    const char *(*wrong)(const scree_config *config, int64_t index, const char **key);
} scree_stage_numbers;

#endif
