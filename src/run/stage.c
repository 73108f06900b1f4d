/// Table of stages and what several of them share.
#include "run/stage.h"

#include "base/matrix.h"
#include "run/simulation.h"
#include "state/cell.h"

#include <math.h>

const scree_stage *scree_stage_get(scree_stage_kind kind, bool whole_cell)
{
    static const scree_stage *const table[][2] = {
        [SCREE_STAGE_PREPARE] = {&scree_stage_prepare, &scree_stage_prepare},
        [SCREE_STAGE_CONFINE] = {&scree_stage_confine, &scree_stage_confine_cell},
        [SCREE_STAGE_COMPRESS] = {&scree_stage_compress, &scree_stage_compress_cell},
        [SCREE_STAGE_DEFORM] = {&scree_stage_deform, &scree_stage_deform},
    };
    return table[kind][whole_cell];
}

const scree_config_stage *scree_stage_config(const scree_simulation *s)
{
    return &s->model.config->stages[s->state.stage.index];
}

double scree_sample_height(const scree_state *state)
{
    if (scree_cell_is_whole(state)) {
        double inverse[9], width[3];
        scree_matrix_invert(state->cell.lattice, inverse);
        scree_cell_widths(inverse, width);
        return width[state->dimension - 1];
    }
    return -(state->wall[SCREE_WALL_BOTTOM].position + state->wall[SCREE_WALL_TOP].position);
}

double scree_axial_strain(const scree_simulation *s)
{
    if (!s->stage || !s->stage->loading) return NAN;
    if (s->stage->strain) return s->stage->strain(s);
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
