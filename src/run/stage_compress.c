/// Stage `compress`: the bottom and top plates approach each other at a constant rate (referred to the height at the
/// begin), reached smoothly within `rise_time`; the sides keep the pressure of the stage before. Stop rule: the axial
/// strain (engineering, from the plates) has reached `strain`. reference: [0] height at the begin, [1] wave time,
/// [2, 3] impedance and mass of the side plates, [4..12] accumulated boundary strain at the begin (3 x 3).
#include "measure/measure.h"
#include "run/simulation.h"

#include <math.h>
#include <string.h>

#define RISE_WAVES 4.0

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_state *state = &s->state;
    double *reference = state->stage.reference;
    reference[0] = scree_sample_height(state);
    reference[1] = scree_sample_wave_time(&s->model, state, state->pressure);
    scree_strain_measure(state, &reference[4]);
    scree_servo sides = scree_servo_for(&s->model, state, SCREE_WALL_LEFT, state->pressure);
    reference[2] = sides.impedance;
    reference[3] = sides.mass;
    for (size_t row = 0; row < state->count; row++) scree_body_place(state, row, state->reference[row]);
    if (state->angle) memset(state->angle, 0, state->count * sizeof *state->angle);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    double dt = s->state.step_size;
    // Without a confining pressure there is no wave time; a tenth of the loading is slow enough for anything.
    double rise = fmin(RISE_WAVES * s->state.stage.reference[1], 0.1 * stage->strain / stage->rate);
    if (!isnan(stage->rise_time)) rise = stage->rise_time;
    // The smooth start costs half the rise time.
    uint64_t expected = (uint64_t)ceil((stage->strain / stage->rate + 0.5 * rise) / dt);
    uint64_t interval = expected / (uint64_t)s->model.config->measure.samples;
    s->plan =
        (scree_stage_plan){.interval = interval > 0 ? interval : 1,
                           .expected = expected,
                           .ramp_time = rise,
                           .sides = {.impedance = s->state.stage.reference[2], .mass = s->state.stage.reference[3]}};
}

static void control(scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    double elapsed = (double)(s->state.step - s->state.stage.first_step) * s->state.step_size;
    double rise = s->plan.ramp_time > 0 ? scree_smooth_ramp(elapsed / s->plan.ramp_time) : 1;
    double velocity = 0.5 * stage->rate * s->state.stage.reference[0] * rise;
    s->state.wall[SCREE_WALL_BOTTOM].velocity = s->state.wall[SCREE_WALL_TOP].velocity = velocity;
    scree_servo_sides(s, s->state.pressure);
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    double strain = scree_axial_strain(s);
    // The last sample lies on the planned last step; half a step of strain covers round-off.
    double step = scree_stage_config(s)->rate * s->state.step_size;
    *done = strain >= scree_stage_config(s)->strain - 0.5 * step;
    (void)snprintf(s->reason, sizeof s->reason, "axial strain %.4g reached", strain);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    return scree_axial_strain(s) / scree_stage_config(s)->strain;
}

const scree_stage scree_stage_compress = {.name = "compress",
                                          .loading = true,
                                          .begin = begin,
                                          .plan = plan,
                                          .control = control,
                                          .finished = finished,
                                          .fraction = fraction};
