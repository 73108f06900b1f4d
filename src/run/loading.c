/// What loading stages share: the numbers that they begin with, a rate that rises smoothly, the plan of samples.
///
/// The rate rises as the smooth step 3 f^2 - 2 f^3 of the fraction f of the rise time T, whose integral T (f^3 - f^4/2)
/// loses half a rise time in the end.

#include "run/loading.h"

#include "comm/comm.h"
#include "integrate/orientation.h"
#include "measure/measure.h"
#include "run/step.h"
#include "state/plates.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define RISE_WAVES 4.0
#define RISE_SHARE 0.1
/// A stage that takes this many times as long as planned does not follow its rate.
#define LATE 2.0

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

/// Height of the sample; where the boundary says none the extent of the bodies along the axis.
static double present_height(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    const scree_state *state = &s->state;
    if (s->boundary->height) return s->boundary->height(&context);
    double low = INFINITY, high = -INFINITY;
    scree_vector place;
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        low = fmin(low, place[state->dimension - 1] - state->row[row].radius);
        high = fmax(high, place[state->dimension - 1] + state->row[row].radius);
    }
    double ends[] = {high, -low};
    scree_comm_maximum(state, ends, 2);
    return ends[0] + ends[1];
}

void scree_rotations_begin(scree_state *state)
{
    // Of bodies that are not round the angle is how they lie.
    if (state->dimension == 2 && state->form) return;
    if (state->angle) memset(state->angle, 0, state->count * sizeof *state->angle);
    scree_orientation_forget(state);
    state->turned_since = scree_state_time(state);
}

void scree_loading_begin(scree_simulation *s, double pressure)
{
    scree_state *state = &s->state;
    scree_loading *loading = scree_loading_of(state);
    const scree_context context = scree_step_context(s);
    *loading = (scree_loading){.height = present_height(s), .wave_time = s->boundary->wave_time(&context, pressure)};
    scree_strain_measure(state, loading->strain);
    s->boundary->fit(&context, pressure);
    if (s->boundary->mark) s->boundary->mark(&context);
    for (size_t row = 0; row < state->count; row++) scree_body_refer(state, row);
    scree_rotations_begin(state);
}

double scree_loading_planned(double time, double rise_time, double wave)
{
    // The smooth start costs half the rise time.
    return time + 0.5 * (isnan(rise_time) ? fmin(RISE_WAVES * wave, RISE_SHARE * time) : rise_time);
}

scree_stage_plan scree_loading_plan(const scree_simulation *s, double time, double rise_time)
{
    // Without a confining pressure there is no wave time; a tenth of the loading is slow enough for anything.
    double rise = fmin(RISE_WAVES * scree_loading_of(&s->state)->wave_time, RISE_SHARE * time);
    if (!isnan(rise_time)) rise = rise_time;
    uint64_t expected = scree_stage_ticks(s, time + 0.5 * rise), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.measure.samples * largest;
    return (scree_stage_plan){.interval = interval > 0 ? interval : largest, .expected = expected, .ramp_time = rise};
}

double scree_loading_rise(const scree_simulation *s, double *loaded)
{
    double elapsed = scree_stage_elapsed(s);
    double rise = s->plan.ramp_time, fraction = rise > 0 ? fmin(1, elapsed / rise) : 1;
    *loaded = rise * fraction * fraction * fraction * (1 - 0.5 * fraction) + fmax(0, elapsed - rise);
    return rise > 0 ? scree_smooth_ramp(elapsed / rise) : 1;
}

/// The error when a stage falls too far behind its rate.
static scree_status check_pace(const scree_simulation *s, double strain, scree_error *error)
{
    uint64_t done = s->state.step - s->state.stage.first_step;
    if ((double)done < LATE * (double)s->plan.expected) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_GUARD,
        "stage %lld (%s): strain %.4g after %.2g times the planned time: the boundary does not follow "
        "the imposed rate; try a larger boundary.penalty",
        (long long)s->state.stage.index, s->stage->name, strain, LATE);
}

scree_status scree_loading_finished(scree_simulation *s, const char *what, double strain, double end, double rate,
                                    bool *done, scree_error *error)
{
    // The last sample lies on the planned last step.
    *done = strain >= end - SCREE_LOADING_SHORT * rate * s->state.tick;
    (void)snprintf(s->reason, sizeof s->reason, "%s %.4g reached", what, strain);
    return *done ? SCREE_OK : check_pace(s, strain, error);
}

typedef scree_loading own;

#define ONE(member, components, unit, meaning)                                                                         \
    SCREE_FIELD_ONE(loading, own, member, "loading/" #member, SCREE_FIELD_DOUBLE, components, unit, meaning,           \
                    .range = {.least = -DBL_MAX, .limit = SCREE_LIMIT_NUMBER, .most = DBL_MAX, .undefined = true})
static const scree_field fields[] = {
    ONE(height, 1, "m", "height of the sample at the begin of the loading stage"),
    ONE(wave_time, 1, "s", "time that a wave needed through it"),
    ONE(strain, 9, "1", "strain accumulated before, 3 x 3 by rows"),
    ONE(enclosed, 1, "1", "logarithm of the enclosed volume at the first sample"),
    ONE(redetected, 1, "1", "strain/redetected at the first sample"),
    ONE(solid, 1, "1", "solid fraction at the first sample"),
};

const scree_module scree_module_loading = {
    .name = "loading",
    .meaning = "the sample as it was when its loading began",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
};
