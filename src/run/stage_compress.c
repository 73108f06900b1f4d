/// Stage `compress`: the sample is shortened along its axis at a constant rate (referred to the height at the begin),
/// reached smoothly within `rise_time`, under the pressure of the stage before. With plates the bottom and top plates
/// approach each other. Without (boundary minimal) the axial component of the velocity gradient is imposed, - rate / (1
/// - strain) at the strain that the rate has led to, and all other components are free.
///
/// Stop rule: the axial strain (engineering; from the plates or the Delaunay boundary) has reached `strain`. reference:
/// run/stage.h, SCREE_LOADING_...
#include "run/stage_compress.h"
#include "boundary/minimal.h"
#include "measure/imposed_gradient.h"
#include "module/key_rows.h"
#include "run/simulation.h"
#include "state/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

typedef scree_compress_config config;
static const scree_key keys[] = {
    NUMBER(config, strain, "1", ABOVE("0 %"), TO("90 %"), .meaning = "Axial strain at which the stage ends."),
    NUMBER(config, rate, "1/s", ABOVE("0 1/s"), TO("1e6 1/s"), .meaning = "Axial strain rate."),
    NUMBER(config, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rate is reached; auto: four wave times of the sample."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// Minimal conditions on the axial component alone.
static void prescribe(scree_simulation *s)
{
    scree_imposed_gradient *drive = scree_imposed(&s->state);
    int axial = s->state.dimension == 3 ? 8 : 4;
    double full[9] = {[0] = own_config(s)->rate}, penalty = s->model.config->boundary.penalty;
    memset(drive->target, 0, sizeof drive->target);
    memset(drive->prescribed, 0, sizeof drive->prescribed);
    drive->prescribed[axial] = SCREE_FULL;
    drive->viscosity = isnan(penalty) ? scree_minimal_viscosity(scree_pressure_now(&s->state), full) : penalty;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_loading_begin(s);
    if (!scree_boundary_has_plates(s->boundary)) prescribe(s);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    s->plan = scree_loading_plan(s, stage->strain / stage->rate, stage->rise_time);
}

static void control(scree_simulation *s)
{
    const config *stage = own_config(s);
    scree_state *state = &s->state;
    double loaded, rate = stage->rate * scree_loading_rise(s, &loaded);
    if (!scree_boundary_has_plates(s->boundary)) {
        scree_imposed(state)->target[state->dimension == 3 ? 8 : 4] = -rate / (1 - stage->rate * loaded);
        return;
    }
    double velocity = 0.5 * rate * state->stage.reference[SCREE_LOADING_HEIGHT];
    scree_plates(state)[SCREE_WALL_BOTTOM].velocity = scree_plates(state)[SCREE_WALL_TOP].velocity = velocity;
    scree_servo_sides(s, scree_pressure_now(state));
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    double strain = scree_axial_strain(s);
    // The last sample lies on the planned last step.
    double step = own_config(s)->rate * s->state.tick;
    *done = strain >= own_config(s)->strain - SCREE_LOADING_SHORT * step;
    (void)snprintf(s->reason, sizeof s->reason, "axial strain %.4g reached", strain);
    return *done ? SCREE_OK : scree_loading_check(s, error);
}

static double fraction(const scree_simulation *s)
{
    return scree_axial_strain(s) / own_config(s)->strain;
}

static double rate_of(const void *own)
{
    return fabs(((const config *)own)->rate);
}

static double strain_of(const void *own)
{
    return ((const config *)own)->strain;
}

static double duration(const void *own)
{
    return strain_of(own) / rate_of(own);
}

static double planned(const scree_model *model, const void *own, double wave)
{
    (void)model;
    return scree_loading_planned(duration(own), ((const config *)own)->rise_time, wave);
}

const scree_stage scree_stage_compress = {.name = "compress",
                                          .loading = true,
                                          .strain = scree_axial_strain,
                                          .begin = begin,
                                          .plan = plan,
                                          .control = control,
                                          .finished = finished,
                                          .fraction = fraction,
                                          .quasistatic = true,
                                          .cell = &scree_stage_compress_periodic,
                                          .duration = duration,
                                          .planned = planned};

static const scree_stage_numbers numbers = {.held = true,
                                            .needs_pressure =
                                                "a confine stage must come before: compress keeps its pressure",
                                            .rate = rate_of,
                                            .strain = strain_of};

const scree_module scree_module_compress = {
    .name = "compress",
    .meaning =
        "Shortens the sample along its axis at a constant rate under the pressure reached before: plates approach each "
        "other, or minimal conditions or a periodic cell impose the rate.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "shortens the sample along its axis to a strain")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &scree_stage_compress,
};
