/// What several stages share.
#include "run/stage.h"
#include "state/plates.h"

#include "base/matrix.h"
#include "measure/measure.h"
#include "run/simulation.h"
#include "state/periodic.h"

#include <math.h>

#define MOST_STEPS 1e15

const scree_stage *scree_stage_get(int kind, bool wholly_periodic)
{
    const scree_stage *stage = scree_modules[kind]->stage;
    return wholly_periodic && stage->cell ? stage->cell : stage;
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
    // A time that no run lasts is cut before it leaves the integers.
    return (uint64_t)fmin(fmax(1, ceil(time / ((double)largest * s->state.tick))), MOST_STEPS) * largest;
}

/// Logarithmic axial strain of the Delaunay boundary since the begin of the loading stage, extension positive.
static double axial_stretch(const scree_simulation *s)
{
    double gradient[9];
    int axial = s->state.dimension == 3 ? 8 : 4;
    scree_strain_measure(&s->state, gradient);
    return gradient[axial] - s->state.stage.reference[SCREE_LOADING_STRAIN + axial];
}

double scree_sample_height(const scree_simulation *s)
{
    const scree_wall *wall = scree_plates(&s->state);
    if (scree_periodic_is_whole(&s->state)) {
        double inverse[9], width[3];
        scree_matrix_invert(scree_cell(&s->state)->lattice, inverse);
        scree_periodic_widths(inverse, width);
        return width[s->state.dimension - 1];
    }
    if (s->boundary && !scree_boundary_has_plates(s->boundary) && s->stage && s->stage->loading)
        return s->state.stage.reference[SCREE_LOADING_HEIGHT] * exp(axial_stretch(s));
    return -(wall[SCREE_WALL_BOTTOM].position + wall[SCREE_WALL_TOP].position);
}

double scree_axial_strain(const scree_simulation *s)
{
    double height = s->state.stage.reference[SCREE_LOADING_HEIGHT];
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

void scree_servo_sides(scree_simulation *s, double pressure)
{
    for (int w = SCREE_WALL_LEFT; w < SCREE_WALL_COUNT; w++)
        if (scree_plates(&s->state)[w].active)
            scree_plate_servo(&s->stage_model, &s->state, w, s->plan.sides, pressure);
}
