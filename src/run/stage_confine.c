/// Stage `confine`: the top plate and the sides press with a pressure that rises smoothly; the bottom plate stands.
/// Ends when the assembly is at rest under it. Without plates (boundary minimal) the pressure acts on all sides and
/// nothing is imposed. (With two plates under servo the sample would drift: the pressure on
/// sloping sides has a vertical resultant that only a standing plate can bear.)
///
/// Stop rule: after the ramp, the mean unbalanced force over the mean contact force stays below `unbalanced_limit` and
/// the top plate carries the pressure within `stress_tolerance`, by default PLATE_TOLERANCE (a sample whose friction
/// depends on velocity creeps on, and its plate with it), for CALM samples in a row. Reaching the time limit is an
/// error: the sample does not come to rest.
///
/// state.stage.reference: [0] pressure at the begin, [1] wave time, [2, 3] impedance and mass of the plates, [4, 5] of
/// the side plates.
#include "run/stage_confine.h"
#include "measure/imposed_gradient.h"
#include "model/critical_step.h"
#include "module/key_rows.h"
#include "run/quasistatic.h"
#include "run/sample.h"
#include "run/simulation.h"
#include "state/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

enum { CALM = 5, SAMPLES_A_WAVE = 4 };
#define PLATE_TOLERANCE 0.05
#define RAMP_WAVES      6.0
#define LIMIT_WAVES     400.0

/// Duration of a confinement after its ramp, in times that a wave needs from grain to grain: it does not grow with the
/// sample. Quick forms: biaxial 680 (2000 discs 630, 60 discs 930), biaxial-boundaries 770, biaxial-timescales 710,
/// rotation-length 900, minimal-shear-circle 1090, minimal-size-effect 1700; periodic-shear 460; triaxial 1070. That of
/// discs between plates depends on the law (confine_grains of its descriptor).
static const struct {
    double periodic, solid;
} confine_grains = {.periodic = 460, .solid = 1070};

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

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_state *state = &s->state;
    const config *stage = own_config(s);
    double *reference = state->stage.reference;
    reference[0] = scree_pressure_now(state);
    reference[1] = scree_sample_wave_time(&s->model, state, stage->pressure);
    scree_servo plates = scree_servo_for(&s->model, state, SCREE_WALL_TOP, stage->pressure);
    scree_servo sides = scree_servo_for(&s->model, state, SCREE_WALL_LEFT, stage->pressure);
    reference[2] = plates.impedance;
    reference[3] = plates.mass;
    reference[4] = sides.impedance;
    reference[5] = sides.mass;
    memset(scree_imposed(state)->prescribed, 0, sizeof scree_imposed(state)->prescribed);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    const double *reference = s->state.stage.reference;
    double wave = reference[1];
    s->plan = (scree_stage_plan){
        .interval = scree_stage_ticks(s, wave / SAMPLES_A_WAVE),
        .ramp_time = isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time,
        .time_limit = isnan(stage->time_limit) ? LIMIT_WAVES * wave : stage->time_limit,
        .plates = {.impedance = reference[2], .mass = reference[3]},
        .sides = {.impedance = reference[4], .mass = reference[5]},
    };
}

static void control(scree_simulation *s)
{
    double from = s->state.stage.reference[0], to = own_config(s)->pressure;
    double done = s->plan.ramp_time > 0 ? scree_stage_elapsed(s) / s->plan.ramp_time : 1;
    scree_pressure_set(&s->state, from + (to - from) * scree_smooth_ramp(done));
    scree_plates(&s->state)[SCREE_WALL_BOTTOM].velocity = 0;
    if (!scree_boundary_has_plates(s->boundary)) return;
    scree_plate_servo(&s->stage_model, &s->state, SCREE_WALL_TOP, s->plan.plates, scree_pressure_now(&s->state));
    scree_servo_sides(s, scree_pressure_now(&s->state));
}

scree_status scree_confine_finished(scree_simulation *s, const char *what, double off, double tolerance, bool *done,
                                    scree_error *error)
{
    const config *stage = own_config(s);
    double unbalanced = s->sample.value[SCREE_SAMPLE_UNBALANCED_RATIO];
    char within[96] = "", apart[96] = "";
    if (what) {
        (void)snprintf(within, sizeof within, ", and %s within %.2g of the pressure,", what, tolerance);
        (void)snprintf(apart, sizeof apart, ", %s off by %.2g of the pressure (stress_tolerance %.2g)", what, off,
                       tolerance);
    }
    bool calm = scree_stage_elapsed(s) > s->plan.ramp_time && unbalanced < stage->unbalanced_limit && off < tolerance;
    s->state.stage.counter = calm ? s->state.stage.counter + 1 : 0;
    *done = s->state.stage.counter >= CALM;
    (void)snprintf(s->reason, sizeof s->reason, "unbalanced force ratio %.2g below %.2g%s for %d samples", unbalanced,
                   stage->unbalanced_limit, within, CALM);
    if (*done || scree_stage_elapsed(s) < s->plan.time_limit) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "stage %lld (confine): not at rest after %.3g s: unbalanced force ratio %.2g "
                           "(unbalanced_limit %.2g)%s; try a larger limit%s or time_limit, a denser preparation, or "
                           "more damping",
                           (long long)s->state.stage.index, scree_stage_elapsed(s), unbalanced, stage->unbalanced_limit,
                           apart, what ? ", stress_tolerance" : "");
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const config *stage = own_config(s);
    double tolerance = isnan(stage->stress_tolerance) ? PLATE_TOLERANCE : stage->stress_tolerance;
    if (!scree_boundary_has_plates(s->boundary)) return scree_confine_finished(s, NULL, 0, tolerance, done, error);
    double top = scree_plate_stress(&s->stage_model, &s->state, SCREE_WALL_TOP) / stage->pressure - 1;
    return scree_confine_finished(s, "the stress of the top plate", fabs(top), tolerance, done, error);
}

static double fraction(const scree_simulation *s)
{
    (void)s;
    return NAN;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    const config *stage = own;
    double density = model->density[SCREE_PARTICLE_MATERIAL], modulus = scree_confined_modulus(model, stage->pressure);
    double grain = 2 * model->mean_radius / scree_wave_speed(modulus, density, scree_expected_solid_fraction(model));
    double grains = scree_model_law(model)->confine_grains;
    if (model->dimension == 3) grains = confine_grains.solid;
    if (scree_model_is_wholly_periodic(model)) grains = confine_grains.periodic;
    return (isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time) + grains * grain;
}

static double pressure_of(const void *own)
{
    return ((const config *)own)->pressure;
}

const scree_stage scree_stage_confine = {.name = "confine",
                                         .begin = begin,
                                         .plan = plan,
                                         .control = control,
                                         .finished = finished,
                                         .fraction = fraction,
                                         .quasistatic = true,
                                         .samples_a_wave = SAMPLES_A_WAVE,
                                         .cell = &scree_stage_confine_periodic,
                                         .planned = planned};

static const scree_stage_numbers numbers = {.held = true, .settles = true, .pressure = pressure_of};

const scree_module scree_module_confine = {
    .name = "confine",
    .meaning = "Raises the pressure on all sides and waits for equilibrium.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "raises the pressure and waits for equilibrium")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &scree_stage_confine,
};
