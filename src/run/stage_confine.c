/// Stage `confine`: a pressure that rises smoothly on all sides (boundary/boundary.h, `hold`: the top plate and the
/// sides press and the bottom plate stands, a cell holds its normal stresses); nothing else is imposed. Ends when the
/// assembly is at rest under it.
///
/// Stop rule: after the ramp, the mean unbalanced force over the mean contact force stays below `unbalanced_limit` and
/// the stress that the boundary names is the pressure within `stress_tolerance`, by default that of the boundary, for
/// CALM samples in a row. Reaching the time limit is an error: the sample does not come to rest.
#include "run/stage_confine.h"
#include "model/critical_step.h"
#include "module/key_rows.h"
#include "run/quasistatic.h"
#include "run/sample.h"
#include "run/stage.h"
#include "run/step.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

enum { CALM = 5, SAMPLES_A_WAVE = 4 };
#define RAMP_WAVES 6.0

/// Duration of a confinement after its ramp, in times that a wave needs from grain to grain: it does not grow with the
/// sample. Quick forms: biaxial 680 (2000 discs 630, 60 discs 930), biaxial-boundaries 770, biaxial-timescales 710,
/// rotation-length 900, minimal-shear-circle 1090, minimal-size-effect 1700; periodic-shear 460; triaxial 1070. That of
/// discs between plates depends on the law (confine_grains of its descriptor).
static const struct {
    double periodic, solid;
} confine_grains = {.periodic = 460, .solid = 1070};

/// Under a law whose springs do not stiffen (its confine_falls), the stiffer they are the more waves pass while grains
/// find their places: the duration is that of so many times 2R sqrt(density / pressure), in which the pressure moves a
/// grain by its size. A run is stopped after PATIENCE of it.
#define PATIENCE 5.0

/// 0 where waves count.
static double settling_time(const scree_model *model, double pressure)
{
    double fall = 2 * model->mean_radius * sqrt(scree_model_mean_density(model) / pressure);
    double falls = 0;
    for (int k = 0; k < scree_model_law_count(model); k++)
        falls = fmax(falls, scree_law_get(model->laws[k].law)->confine_falls);
    return falls * fall;
}

typedef scree_confine_config config;
static const scree_key keys[] = {
    NUMBER(config, pressure, "Pa", FROM("1e-3 Pa"), TO("1000 GPa"), .meaning = "Confining pressure."),
    NUMBER(config, ramp_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the pressure is raised."),
    NUMBER(config, unbalanced_limit, "1", .standard = "1e-3", FROM("1e-9"), BELOW("1"),
           .meaning = "The stage ends when the unbalanced force ratio stays below this."),
    NUMBER(config, stress_tolerance, "1", .standard = "auto", FROM("1e-9"), BELOW("1"),
           .meaning =
               "And when the normal stresses of a periodic cell (means since the last sample), or the stress of the "
               "top plate, are this near to the pressure, relative to it; auto: 0.2 % in a periodic cell, 5 % "
               "with plates."),
    NUMBER(config, time_limit, "s", .standard = "auto", .guard = true, ABOVE("0 s"), TO("1e9 s"),
           .meaning = "The run stops with a message if equilibrium takes longer."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// State of the module.
typedef struct confinement {
    double pressure;  ///< Pa, at the begin of the stage
    double wave_time; ///< s, through the sample under the pressure that it is brought to
} confinement;

static confinement *own_state(const scree_simulation *s)
{
    return s->state.own[SCREE_SLOT_confine];
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    double pressure = own_config(s)->pressure;
    const scree_context context = scree_step_context(s);
    *own_state(s) = (confinement){.pressure = scree_pressure_now(&s->state),
                                  .wave_time = s->boundary->wave_time(&context, pressure)};
    s->boundary->fit(&context, pressure);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    double wave = own_state(s)->wave_time;
    double longest = fmax(s->boundary->patience * wave, PATIENCE * settling_time(&s->model, stage->pressure));
    s->plan = (scree_stage_plan){
        .interval = scree_stage_ticks(s, wave / SAMPLES_A_WAVE),
        .ramp_time = isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time,
        .time_limit = isnan(stage->time_limit) ? longest : stage->time_limit,
    };
}

static void control(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    double from = own_state(s)->pressure, to = own_config(s)->pressure;
    double done = s->plan.ramp_time > 0 ? scree_stage_elapsed(s) / s->plan.ramp_time : 1;
    scree_pressure_set(&s->state, from + (to - from) * scree_smooth_ramp(done));
    if (s->boundary->hold) s->boundary->hold(&context, scree_pressure_now(&s->state));
}

/// The stress that the boundary names and how far it may be off, for messages.
typedef struct wanted_stress {
    const char *what; ///< NULL: none
    double off, tolerance;
} wanted_stress;

static wanted_stress stress_of(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    double given = own_config(s)->stress_tolerance;
    wanted_stress stress = {.tolerance = isnan(given) ? s->boundary->stress_tolerance : given};
    if (s->boundary->stress_error)
        stress.off = s->boundary->stress_error(&context, own_config(s)->pressure, &stress.what);
    return stress;
}

static scree_status not_at_rest(const scree_simulation *s, const wanted_stress *stress, double unbalanced,
                                scree_error *error)
{
    char apart[96] = "";
    if (stress->what)
        (void)snprintf(apart, sizeof apart, ", %s off by %.2g of the pressure (stress_tolerance %.2g)", stress->what,
                       stress->off, stress->tolerance);
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "stage %lld (confine): not at rest after %.3g s: unbalanced force ratio %.2g "
                           "(unbalanced_limit %.2g)%s; try a larger limit%s or time_limit, a denser preparation, or "
                           "more damping",
                           (long long)s->state.stage.index, scree_stage_elapsed(s), unbalanced,
                           own_config(s)->unbalanced_limit, apart, stress->what ? ", stress_tolerance" : "");
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const wanted_stress stress = stress_of(s);
    double unbalanced = s->sample[SCREE_SAMPLE_UNBALANCED_RATIO], limit = own_config(s)->unbalanced_limit;
    char within[96] = "";
    bool calm = scree_stage_elapsed(s) > s->plan.ramp_time && unbalanced < limit &&
                (!stress.what || stress.off < stress.tolerance);
    s->state.stage.counter = calm ? s->state.stage.counter + 1 : 0;
    *done = s->state.stage.counter >= CALM;
    if (stress.what)
        (void)snprintf(within, sizeof within, ", and %s within %.2g of the pressure,", stress.what, stress.tolerance);
    (void)snprintf(s->reason, sizeof s->reason, "unbalanced force ratio %.2g below %.2g%s for %d samples", unbalanced,
                   limit, within, CALM);
    return *done || scree_stage_elapsed(s) < s->plan.time_limit ? SCREE_OK : not_at_rest(s, &stress, unbalanced, error);
}

static double fraction(const scree_simulation *s)
{
    (void)s;
    return NAN;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    const config *stage = own;
    double density = scree_model_mean_density(model), modulus = scree_confined_modulus(model, stage->pressure);
    double grain = 2 * model->mean_radius / scree_wave_speed(modulus, density, scree_expected_solid_fraction(model));
    double grains = 0;
    for (int k = 0; k < scree_model_law_count(model); k++)
        grains = fmax(grains, scree_law_get(model->laws[k].law)->confine_grains);
    if (model->dimension == 3) grains = confine_grains.solid;
    if (scree_model_is_wholly_periodic(model)) grains = confine_grains.periodic;
    double settling = settling_time(model, stage->pressure);
    return (isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time) +
           (settling > 0 ? settling : grains * grain);
}

static double pressure_of(const void *own)
{
    return ((const config *)own)->pressure;
}

static const scree_stage stage_face = {.name = "confine",
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .quasistatic = true,
                                       .samples_a_wave = SAMPLES_A_WAVE,
                                       .planned = planned};

static const scree_stage_numbers numbers = {.held = true, .settles = true, .pressure = pressure_of};

#define ONE(member, unit, meaning)                                                                                     \
    SCREE_FIELD_ONE(confine, confinement, member, "confine/" #member, SCREE_FIELD_DOUBLE, 1, unit, meaning)
static const scree_field fields[] = {
    ONE(pressure, "Pa", "pressure at the begin of the confine stage"),
    ONE(wave_time, "s", "time of a wave through the sample under the pressure that it is brought to"),
};

const scree_module scree_module_confine = {
    .name = "confine",
    .meaning = "Raises the pressure on all sides and waits for equilibrium.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "raises the pressure and waits for equilibrium")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .state_size = sizeof(confinement),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
