/// What several stages share.
#include "run/stage.h"

#include <math.h>

#define MOST_STEPS 1e15

const scree_config_stage *scree_stage_config(const scree_simulation *s)
{
    return &s->model.stages[s->state.stage.index];
}

double scree_stage_elapsed(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) * s->state.tick;
}

uint64_t scree_stage_ticks(const scree_simulation *s, double time)
{
    uint64_t largest = s->model.largest_step;
    // A time that no run lasts is cut before it leaves the integers.
    return (uint64_t)fmin(fmax(1, ceil(time / ((double)largest * s->state.tick))), MOST_STEPS) * largest;
}

double scree_smooth_ramp(double fraction)
{
    if (fraction >= 1) return 1;
    if (fraction <= 0) return 0;
    return fraction * fraction * (3 - 2 * fraction);
}
