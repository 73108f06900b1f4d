/// Table of stages and what several of them share.
#include "run/stage.h"

#include "run/simulation.h"

#include <math.h>

const scree_stage *scree_stage_get(scree_stage_kind kind)
{
    static const scree_stage *const table[] = {
        [SCREE_STAGE_PREPARE] = &scree_stage_prepare,
        [SCREE_STAGE_CONFINE] = &scree_stage_confine,
        [SCREE_STAGE_COMPRESS] = &scree_stage_compress,
    };
    return table[kind];
}

const scree_config_stage *scree_stage_config(const scree_simulation *s)
{
    return &s->model.config->stages[s->state.stage.index];
}

double scree_stage_elapsed(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) * s->state.tick;
}

uint64_t scree_stage_ticks(const scree_simulation *s, double time)
{
    uint64_t largest = s->model.largest_step;
    return (uint64_t)fmax(1, ceil(time / ((double)largest * s->state.tick))) * largest;
}

double scree_sample_height(const scree_state *state)
{
    return -(state->wall[SCREE_WALL_BOTTOM].position + state->wall[SCREE_WALL_TOP].position);
}

double scree_axial_strain(const scree_simulation *s)
{
    if (!s->stage || !s->stage->loading) return NAN;
    double height = s->state.stage.reference[0];
    return (height - scree_sample_height(&s->state)) / height;
}

double scree_smooth_ramp(double fraction)
{
    if (fraction >= 1) return 1;
    if (fraction <= 0) return 0;
    return fraction * fraction * (3 - 2 * fraction);
}

void scree_servo_sides(scree_simulation *s, double pressure)
{
    for (int w = SCREE_WALL_LEFT; w <= SCREE_WALL_RIGHT; w++)
        if (s->state.wall[w].active) scree_plate_servo(&s->stage_model, &s->state, w, s->plan.sides, pressure);
}
