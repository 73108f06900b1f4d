/// Stage `rotate_particle` (P 4.2): the spin of one particle is raised linearly to a value and held; nothing else
/// changes. Under minimal conditions the components of the velocity gradient beside the diagonal are held at zero, so
/// that the sample as a whole does not turn. The particle is the one nearest to the centre of the assembly that touches
/// three others or more (four in 3D). Ends after ramp and hold. reference: run/stage.h, SCREE_LOADING_...
#include "boundary/forced_spin.h"
#include "boundary/minimal.h"
#include "measure/measure.h"
#include "run/simulation.h"

#include <math.h>
#include <string.h>

#define RAMP_WAVES 4.0

/// Id of the particle; -1: none is held by others.
static int64_t choose(const scree_state *state)
{
    scree_vector centre = {0}, place;
    for (size_t id = 0; id < state->grains; id++) {
        scree_body_place(state, state->row_of_id[id], place);
        for (int i = 0; i < 3; i++) centre[i] += place[i] / (double)state->grains;
    }
    int64_t best = -1;
    double nearest = INFINITY;
    for (size_t id = 0; id < state->grains; id++) {
        size_t row = state->row_of_id[id];
        if (state->sum[row].contacts <= state->dimension) continue;
        scree_body_place(state, row, place);
        for (int i = 0; i < 3; i++) place[i] -= centre[i];
        if (scree_length(place) >= nearest) continue;
        nearest = scree_length(place);
        best = (int64_t)id;
    }
    return best;
}

/// The boundary as a whole keeps its shape of angles and does not turn.
static void hold_rotation(scree_simulation *s)
{
    scree_drive *drive = &s->state.drive;
    int dimension = s->state.dimension;
    double penalty = s->model.config->boundary.penalty, rate[9] = {0};
    const scree_config_stage *stage = scree_stage_config(s);
    memset(drive->target, 0, sizeof drive->target);
    for (int c = 0; c < 9; c++)
        drive->prescribed[c] = c / 3 != c % 3 && c / 3 < dimension && c % 3 < dimension ? SCREE_FULL : SCREE_FREE;
    // The scale of the rates that are to be held back: those of the particle.
    rate[1] = stage->spin;
    drive->viscosity = isnan(penalty) ? scree_minimal_viscosity(s->state.pressure, rate) : penalty;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_loading_begin(s);
    hold_rotation(s);
    int64_t id = choose(&s->state);
    if (id < 0)
        return scree_error_set(error, SCREE_ERROR_GUARD, "stage %lld (rotate_particle): no particle is held by others",
                               (long long)s->state.stage.index);
    scree_forced_spin_begin(&s->state, (uint32_t)id);
    return SCREE_OK;
}

static double rise_of(const scree_simulation *s, const scree_config_stage *stage)
{
    return isnan(stage->ramp_time) ? RAMP_WAVES * s->state.stage.reference[SCREE_LOADING_WAVE] : stage->ramp_time;
}

static double ramp(const scree_simulation *s)
{
    return rise_of(s, scree_stage_config(s));
}

double scree_rotate_turned(const scree_simulation *s, double elapsed)
{
    const scree_config_stage *stage = &s->model.config->stages[s->model.config->stage_count - 1];
    double rise = rise_of(s, stage), raised = fmin(elapsed, rise);
    return stage->spin * ((rise > 0 ? 0.5 * raised * raised / rise : 0) + fmax(0, elapsed - rise));
}

static void plan(scree_simulation *s)
{
    double time = ramp(s) + scree_stage_config(s)->hold_time;
    s->plan = scree_loading_plan(s, time);
    uint64_t expected = (uint64_t)ceil(time / s->state.step_size - 1e-9);
    s->plan.expected = expected > 0 ? expected : 1;
    s->plan.ramp_time = ramp(s);
}

static double elapsed(const scree_simulation *s)
{
    return scree_state_time(&s->state) - s->state.stage.first_time;
}

static void control(scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    double middle = elapsed(s) + 0.5 * s->state.step_size;
    double part = s->plan.ramp_time > 0 ? fmin(1, middle / s->plan.ramp_time) : 1;
    scree_vector spin = {0};
    spin[stage->axis] = part * stage->spin;
    scree_forced_spin_set(&s->state, spin);
}

static double fraction(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) / (double)s->plan.expected;
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    *done = s->state.step - s->state.stage.first_step >= s->plan.expected;
    (void)snprintf(s->reason, sizeof s->reason, "spin %.4g rad/s held for %.4g s", scree_stage_config(s)->spin,
                   scree_stage_config(s)->hold_time);
    return SCREE_OK;
}

const scree_stage scree_stage_rotate = {.name = "rotate_particle",
                                        .loading = true,
                                        .begin = begin,
                                        .plan = plan,
                                        .control = control,
                                        .finished = finished,
                                        .fraction = fraction};
