/// What loading stages share: the numbers that they begin with, a rate that rises smoothly, the plan of samples.
///
/// The rate rises as the smooth step 3 f^2 - 2 f^3 of the fraction f of the rise time T, whose integral T (f^3 - f^4/2)
/// loses half a rise time in the end.
#include "boundary/minimal.h"
#include "measure/measure.h"
#include "run/simulation.h"
#include "state/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define RISE_WAVES 4.0
#define RISE_SHARE 0.1
/// A stage that takes this many times as long as planned does not follow its rate.
#define LATE 2.0

/// Distance between the plates; without them the extent of the bodies along the axis.
static double present_height(const scree_state *state)
{
    const scree_wall *bottom = &scree_plates(state)[SCREE_WALL_BOTTOM], *top = &scree_plates(state)[SCREE_WALL_TOP];
    if (bottom->active && top->active) return -(bottom->position + top->position);
    double low = INFINITY, high = -INFINITY;
    scree_vector place;
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_place(state, row, place);
        low = fmin(low, place[state->dimension - 1] - state->row[row].radius);
        high = fmax(high, place[state->dimension - 1] + state->row[row].radius);
    }
    return high - low;
}

void scree_loading_begin(scree_simulation *s)
{
    scree_state *state = &s->state;
    double *reference = state->stage.reference;
    reference[SCREE_LOADING_HEIGHT] = present_height(state);
    reference[SCREE_LOADING_WAVE] = scree_sample_wave_time(&s->model, state, scree_pressure_now(state));
    scree_strain_measure(state, &reference[SCREE_LOADING_STRAIN]);
    scree_servo sides = scree_servo_for(&s->model, state, SCREE_WALL_LEFT, scree_pressure_now(state));
    reference[SCREE_LOADING_SIDES] = sides.impedance;
    reference[SCREE_LOADING_SIDES + 1] = sides.mass;
    for (size_t row = 0; row < state->count; row++) scree_body_place(state, row, state->reference[row]);
    if (state->angle) memset(state->angle, 0, state->count * sizeof *state->angle);
}

double scree_loading_planned(double time, double rise_time, double wave)
{
    // The smooth start costs half the rise time.
    return time + 0.5 * (isnan(rise_time) ? fmin(RISE_WAVES * wave, RISE_SHARE * time) : rise_time);
}

scree_stage_plan scree_loading_plan(const scree_simulation *s, double time, double rise_time)
{
    const double *reference = s->state.stage.reference;
    // Without a confining pressure there is no wave time; a tenth of the loading is slow enough for anything.
    double rise = fmin(RISE_WAVES * reference[SCREE_LOADING_WAVE], RISE_SHARE * time);
    if (!isnan(rise_time)) rise = rise_time;
    uint64_t expected = scree_stage_ticks(s, time + 0.5 * rise), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.config->measure.samples * largest;
    return (scree_stage_plan){
        .interval = interval > 0 ? interval : largest,
        .expected = expected,
        .ramp_time = rise,
        .sides = {.impedance = reference[SCREE_LOADING_SIDES], .mass = reference[SCREE_LOADING_SIDES + 1]}};
}

double scree_loading_rise(const scree_simulation *s, double *loaded)
{
    double elapsed = scree_stage_elapsed(s);
    double rise = s->plan.ramp_time, fraction = rise > 0 ? fmin(1, elapsed / rise) : 1;
    *loaded = rise * fraction * fraction * fraction * (1 - 0.5 * fraction) + fmax(0, elapsed - rise);
    return rise > 0 ? scree_smooth_ramp(elapsed / rise) : 1;
}

scree_status scree_loading_check(const scree_simulation *s, scree_error *error)
{
    uint64_t done = s->state.step - s->state.stage.first_step;
    if ((double)done < LATE * (double)s->plan.expected) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_GUARD,
        "stage %lld (%s): strain %.4g after %.2g times the planned time: the boundary does not follow "
        "the imposed rate; try a larger boundary.penalty",
        (long long)s->state.stage.index, s->stage->name, scree_loading_strain(s), LATE);
}
