/// The stage that runs now: its config, its time; what several stages share.
#ifndef SCREE_RUN_STAGE_H
#define SCREE_RUN_STAGE_H

#include "run/simulation_data.h"

/// s since the begin of the stage.
double scree_stage_elapsed(const scree_simulation *s);

/// Ticks of `time` [s], rounded up to whole largest steps, where every sequence of steps ends; at least one of them.
uint64_t scree_stage_ticks(const scree_simulation *s, double time);

/// The config of the stage that runs now; what its kind says is in `own`.
const scree_config_stage *scree_stage_config(const scree_simulation *s);

/// Smooth step from 0 to 1 (cubic), for pressures and velocities that must not shock the sample.
double scree_smooth_ramp(double fraction);

#endif
