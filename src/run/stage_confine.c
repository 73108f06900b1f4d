/// Stage `confine`: the plates and the sides press with a pressure that rises smoothly; ends when the assembly is at
/// rest under it. Stop rule: after the ramp, the mean unbalanced force over the mean contact force stays below
/// `unbalanced_limit` and both plates carry the pressure within 1 %, for CALM samples in a row. Reaching the time limit
/// is an error: the sample does not come to rest. reference: [0] pressure at the begin, [1] wave time, [2] impedance of
/// the plates, [3] impedance of the side plates.
#include "boundary/plates.h"
#include "measure/measure.h"
#include "run/simulation.h"

#include <math.h>

enum { CALM = 5, SAMPLES_A_WAVE = 4 };
#define RAMP_WAVES  6.0
#define LIMIT_WAVES 400.0

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_state *state = &s->state;
    const scree_config_stage *stage = scree_stage_config(s);
    double *reference = state->stage.reference;
    reference[0] = state->pressure;
    reference[1] = scree_sample_wave_time(&s->model, state, stage->pressure);
    double width = scree_plate_length(state, SCREE_WALL_TOP), height = scree_plate_length(state, SCREE_WALL_LEFT);
    reference[2] = scree_sample_impedance(&s->model, state, width, stage->pressure);
    reference[3] = scree_sample_impedance(&s->model, state, height, stage->pressure);

    // Measured while the box of the preparation still stands; then the sides go where the pressure takes their place.
    bool pressed = s->model.config->boundary.lateral == SCREE_LATERAL_PRESSURE;
    state->wall[SCREE_WALL_BOTTOM].active = state->wall[SCREE_WALL_TOP].active = 1;
    state->wall[SCREE_WALL_LEFT].active = state->wall[SCREE_WALL_RIGHT].active = !pressed;
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    const double *reference = s->state.stage.reference;
    double wave = reference[1];
    s->plan = (scree_stage_plan){
        .interval = (uint64_t)fmax(1, ceil(wave / SAMPLES_A_WAVE / s->state.step_size)),
        .ramp_time = isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time,
        .time_limit = isnan(stage->time_limit) ? LIMIT_WAVES * wave : stage->time_limit,
        .impedance = reference[2],
        .side_impedance = reference[3],
    };
}

static double elapsed(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) * s->state.step_size;
}

static void control(scree_simulation *s)
{
    double from = s->state.stage.reference[0], to = scree_stage_config(s)->pressure;
    double done = s->plan.ramp_time > 0 ? elapsed(s) / s->plan.ramp_time : 1;
    s->state.pressure = from + (to - from) * scree_smooth_ramp(done);
    scree_plate_servo(&s->stage_model, &s->state, SCREE_WALL_BOTTOM, s->plan.impedance, s->state.pressure);
    scree_plate_servo(&s->stage_model, &s->state, SCREE_WALL_TOP, s->plan.impedance, s->state.pressure);
    scree_servo_sides(s, s->state.pressure);
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const scree_config_stage *stage = scree_stage_config(s);
    const scree_model *model = &s->stage_model;
    double unbalanced = scree_unbalanced_ratio(model, &s->state, &s->table);
    double bottom = scree_plate_stress(model, &s->state, SCREE_WALL_BOTTOM) / stage->pressure - 1;
    double top = scree_plate_stress(model, &s->state, SCREE_WALL_TOP) / stage->pressure - 1;
    bool calm = elapsed(s) > s->plan.ramp_time && unbalanced < stage->unbalanced_limit && fabs(bottom) < 0.01 &&
                fabs(top) < 0.01;
    s->state.stage.counter = calm ? s->state.stage.counter + 1 : 0;
    *done = s->state.stage.counter >= CALM;
    (void)snprintf(s->reason, sizeof s->reason, "unbalanced force ratio %.2g below %.2g for %d samples", unbalanced,
                   stage->unbalanced_limit, CALM);
    if (*done || elapsed(s) < s->plan.time_limit) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_GUARD,
        "stage %lld (confine): not at rest after %.3g s: unbalanced force ratio %.2g (limit %.2g), plate "
        "stress off by %.2g; try a larger unbalanced_limit, a larger time_limit or more damping",
        (long long)s->state.stage.index, elapsed(s), unbalanced, stage->unbalanced_limit,
        fmax(fabs(bottom), fabs(top)));
}

static double fraction(const scree_simulation *s)
{
    (void)s;
    return NAN;
}

const scree_stage scree_stage_confine = {
    .name = "confine", .begin = begin, .plan = plan, .control = control, .finished = finished, .fraction = fraction};
