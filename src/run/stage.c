/// What several stages share.
#include "run/stage.h"
#include "state/plates.h"

#include "measure/measure.h"
#include "run/loading.h"
#include "run/step.h"

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

/// Logarithmic axial strain of the Delaunay boundary since the begin of the loading stage, extension positive.
static double axial_stretch(const scree_simulation *s)
{
    double gradient[9];
    int axial = s->state.dimension == 3 ? 8 : 4;
    scree_strain_measure(&s->state, gradient);
    return gradient[axial] - scree_loading_of(&s->state)->strain[axial];
}

double scree_sample_height(const scree_simulation *s)
{
    const scree_context context = scree_step_context((scree_simulation *)(uintptr_t)s);
    if (s->boundary && s->boundary->height) return s->boundary->height(&context);
    if (s->boundary && s->stage && s->stage->loading)
        return scree_loading_of(&s->state)->height * exp(axial_stretch(s));
    const scree_wall *wall = scree_plates(&s->state);
    return -(wall[SCREE_WALL_BOTTOM].position + wall[SCREE_WALL_TOP].position);
}

double scree_axial_strain(const scree_simulation *s)
{
    double height = scree_loading_of(&s->state)->height;
    return (height - scree_sample_height(s)) / height;
}

double scree_loading_strain(const scree_simulation *s)
{
    return s->stage && s->stage->strain ? s->stage->strain(s) : NAN;
}

double scree_smooth_ramp(double fraction)
{
    if (fraction >= 1) return 1;
    if (fraction <= 0) return 0;
    return fraction * fraction * (3 - 2 * fraction);
}
