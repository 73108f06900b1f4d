/// Stages in a cell that is periodic in all directions (boundary/periodic.c).
///
/// `confine`: all normal stresses rise smoothly to the pressure, the cell keeps its angles; ends when the assembly is
/// at rest under it, by the rule of stage_confine.c with the normal stresses in the place of the top plate; they are
/// to be within `stress_tolerance`, by default STRESS_TOLERANCE, as means since the last sample: friction that depends
/// on velocity may change its sign in every step, and the stress with it.
/// `compress`: the last direction is compressed at a constant rate (referred to its width at the begin), the normal
/// stresses of the others stay at the pressure of the stage before, angles stay. The biaxial test without a boundary.
/// `deform`: every component of the velocity gradient as the case says. Its strain is that of the fastest prescribed
/// component: the magnitude of its integral over time, so logarithmic for an extension, the engineering shear for a
/// shear. Rates are reached smoothly within `rise_time`.
///
/// reference: [0] confine: pressure at the begin, compress: width at the begin; [1] wave time, [2, 3, 13] inertia,
/// damping and limit of components under stress, [4..12] strain of the cell at the begin (3 x 3),
/// [14..16] confine: sums of the normal stresses times the step since the last sample, [17] of the steps.
#include "base/matrix.h"
#include "run/sample.h"
#include "run/simulation.h"
#include "run/stage_compress.h"
#include "run/stage_confine.h"
#include "run/stage_deform.h"
#include "state/periodic.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

enum { WAVE_TIME = 1, INERTIA, DAMPING, STRAIN, LIMIT = 13, STRESSES, TIME = 17 };
enum { SAMPLES_A_WAVE = 4 };
#define STRESS_TOLERANCE 0.002
#define RAMP_WAVES       6.0
#define LIMIT_WAVES      1000.0
#define RISE_WAVES       4.0

/// Measures the sample once, at the begin of the stage.
static void measure_sample(scree_simulation *s, double pressure)
{
    double *reference = s->state.stage.reference;
    scree_periodic_drive drive;
    scree_periodic_drive_fit(&s->model, &s->state, pressure, &drive);
    reference[WAVE_TIME] = scree_periodic_wave_time(&s->model, &s->state, pressure);
    reference[INERTIA] = drive.inertia;
    reference[DAMPING] = drive.damping;
    reference[LIMIT] = drive.limit;
    memcpy(&reference[STRAIN], scree_cell(&s->state)->strain, sizeof scree_cell(&s->state)->strain);
}

/// Displacements and rotations count from here.
static void set_reference(scree_state *state)
{
    for (size_t row = 0; row < state->count; row++) scree_body_place(state, row, state->reference[row]);
    memcpy(scree_cell(state)->reference, scree_cell(state)->lattice, sizeof scree_cell(state)->reference);
    if (state->angle) memset(state->angle, 0, state->count * sizeof *state->angle);
}

/// A cell that keeps its shape, with the servo of this stage.
static scree_periodic_drive drive_at_rest(const scree_simulation *s)
{
    const double *reference = s->state.stage.reference;
    scree_periodic_drive drive = {
        .inertia = reference[INERTIA], .damping = reference[DAMPING], .limit = reference[LIMIT]};
    for (int k = 0; k < 9; k++) drive.stress[k] = NAN;
    return drive;
}

/// Leaves the normal component of a direction to a pressure.
static void hold_pressure(scree_periodic_drive *drive, int direction, double pressure)
{
    drive->stress[4 * direction] = -pressure;
}

// ---- confine -----------------------------------------------------------------------------------------------------

static void forget_stresses(scree_simulation *s)
{
    double *reference = s->state.stage.reference;
    reference[STRESSES] = reference[STRESSES + 1] = reference[STRESSES + 2] = reference[TIME] = 0;
}

static void remember_stresses(scree_simulation *s)
{
    double stress[9], *reference = s->state.stage.reference, step = s->state.step_size;
    scree_periodic_stress(&s->stage_model, &s->state, stress);
    for (int k = 0; k < s->state.dimension; k++) reference[STRESSES + k] += step * stress[4 * k];
    reference[TIME] += step;
}

static const scree_confine_config *confine_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

static const scree_compress_config *compress_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

static const scree_deform_config *deform_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

static scree_status begin_confine(scree_simulation *s, scree_error *error)
{
    (void)error;
    s->state.stage.reference[0] = scree_pressure_now(&s->state);
    measure_sample(s, confine_config(s)->pressure);
    forget_stresses(s);
    return SCREE_OK;
}

static void plan_confine(scree_simulation *s)
{
    const scree_confine_config *stage = confine_config(s);
    double wave = s->state.stage.reference[WAVE_TIME];
    s->plan = (scree_stage_plan){
        .interval = scree_stage_ticks(s, wave / SAMPLES_A_WAVE),
        .ramp_time = isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time,
        .time_limit = isnan(stage->time_limit) ? LIMIT_WAVES * wave : stage->time_limit,
        .periodic = drive_at_rest(s),
    };
}

static void control_confine(scree_simulation *s)
{
    double from = s->state.stage.reference[0], to = confine_config(s)->pressure;
    double done = s->plan.ramp_time > 0 ? scree_stage_elapsed(s) / s->plan.ramp_time : 1;
    scree_pressure_set(&s->state, from + (to - from) * scree_smooth_ramp(done));
    for (int k = 0; k < s->state.dimension; k++) hold_pressure(&s->plan.periodic, k, scree_pressure_now(&s->state));
    scree_periodic_control(&s->stage_model, &s->state, &s->plan.periodic, 1);
    remember_stresses(s);
}

static scree_status confine_finished(scree_simulation *s, bool *done, scree_error *error)
{
    const scree_confine_config *stage = confine_config(s);
    const double *reference = s->state.stage.reference;
    double tolerance = isnan(stage->stress_tolerance) ? STRESS_TOLERANCE : stage->stress_tolerance, off = 0;
    for (int k = 0; k < s->state.dimension; k++)
        off = fmax(off, fabs(reference[STRESSES + k] / reference[TIME] / stage->pressure + 1));
    forget_stresses(s);
    return scree_confine_finished(s, "every normal stress", off, tolerance, done, error);
}

static double confine_fraction(const scree_simulation *s)
{
    (void)s;
    return NAN;
}

const scree_stage scree_stage_confine_periodic = {.name = "confine",
                                                  .begin = begin_confine,
                                                  .plan = plan_confine,
                                                  .control = control_confine,
                                                  .finished = confine_finished,
                                                  .fraction = confine_fraction};

// ---- loading -----------------------------------------------------------------------------------------------------

/// Strain at which the stage ends.
static double end_of(const scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    return scree_modules[stage->kind]->numbers->strain(stage->own);
}

/// Steps, samples and rise time of a loading to `strain` at `rate`.
static void plan_loading(scree_simulation *s, double strain, double rate, double rise_time)
{
    double rise = fmin(RISE_WAVES * s->state.stage.reference[WAVE_TIME], 0.1 * strain / rate);
    if (!isnan(rise_time)) rise = rise_time;
    // The smooth start costs half the rise time.
    uint64_t expected = scree_stage_ticks(s, strain / rate + 0.5 * rise), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.config->measure.samples * largest;
    s->plan = (scree_stage_plan){.interval = interval > 0 ? interval : largest,
                                 .expected = expected,
                                 .ramp_time = rise,
                                 .periodic = drive_at_rest(s)};
}

static double rise_now(const scree_simulation *s)
{
    return s->plan.ramp_time > 0 ? scree_smooth_ramp(scree_stage_elapsed(s) / s->plan.ramp_time) : 1;
}

static scree_status loading_finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    double strain = scree_loading_strain(s), gradient = scree_matrix_norm(scree_cell(&s->state)->gradient);
    // The last sample lies on the planned last step.
    *done = strain >= end_of(s) - SCREE_LOADING_SHORT * gradient * s->state.tick;
    (void)snprintf(s->reason, sizeof s->reason, "strain %.4g reached", strain);
    return SCREE_OK;
}

static double loading_fraction(const scree_simulation *s)
{
    return scree_loading_strain(s) / end_of(s);
}

static scree_status begin_compress(scree_simulation *s, scree_error *error)
{
    (void)error;
    measure_sample(s, scree_pressure_now(&s->state));
    s->state.stage.reference[0] = scree_sample_height(s);
    set_reference(&s->state);
    return SCREE_OK;
}

static void plan_compress(scree_simulation *s)
{
    const scree_compress_config *stage = compress_config(s);
    plan_loading(s, stage->strain, stage->rate, stage->rise_time);
    for (int k = 0; k + 1 < s->state.dimension; k++) hold_pressure(&s->plan.periodic, k, scree_pressure_now(&s->state));
}

static void control_compress(scree_simulation *s)
{
    int axial = 4 * (s->state.dimension - 1);
    double begin = s->state.stage.reference[0];
    s->plan.periodic.rate[axial] = -compress_config(s)->rate * begin / scree_sample_height(s);
    scree_periodic_control(&s->stage_model, &s->state, &s->plan.periodic, rise_now(s));
}

const scree_stage scree_stage_compress_periodic = {.name = "compress",
                                                   .loading = true,
                                                   .strain = scree_axial_strain,
                                                   .begin = begin_compress,
                                                   .plan = plan_compress,
                                                   .control = control_compress,
                                                   .finished = loading_finished,
                                                   .fraction = loading_fraction};

/// Rates of a deform stage [1/s], zero where nothing is said, and the number of the fastest component.
static int find_rates(const scree_deform_config *stage, double rate[9])
{
    int leader = 0;
    for (int k = 0; k < 9; k++) {
        int mirror = 3 * (k % 3) + k / 3;
        const double given[3] = {stage->velocity_gradient[k], stage->strain_rate[k], stage->strain_rate[mirror]};
        rate[k] = 0;
        for (int i = 0; i < 3; i++)
            if (!isnan(given[i])) rate[k] = given[i];
        if (fabs(rate[k]) > fabs(rate[leader])) leader = k;
    }
    return leader;
}

static scree_status begin_deform(scree_simulation *s, scree_error *error)
{
    (void)error;
    double held = scree_held_pressure(scree_stage_config(s));
    measure_sample(s, held > 0 ? held : scree_pressure_now(&s->state));
    set_reference(&s->state);
    return SCREE_OK;
}

static void plan_deform(scree_simulation *s)
{
    const scree_deform_config *stage = deform_config(s);
    double rate[9];
    int leader = find_rates(stage, rate);
    plan_loading(s, stage->strain, fabs(rate[leader]), stage->rise_time);
    memcpy(s->plan.periodic.rate, rate, sizeof rate);
    for (int k = 0; k < 9; k++) s->plan.periodic.stress[k] = k % 4 == 0 ? -stage->stress[k] : stage->stress[k];
}

static void control_deform(scree_simulation *s)
{
    scree_periodic_control(&s->stage_model, &s->state, &s->plan.periodic, rise_now(s));
}

static double deform_strain(const scree_simulation *s)
{
    double rate[9];
    int leader = find_rates(deform_config(s), rate);
    return fabs(scree_cell(&s->state)->strain[leader] - s->state.stage.reference[STRAIN + leader]);
}

const scree_stage scree_stage_deform_periodic = {.name = "deform",
                                                 .loading = true,
                                                 .strain = deform_strain,
                                                 .begin = begin_deform,
                                                 .plan = plan_deform,
                                                 .control = control_deform,
                                                 .finished = loading_finished,
                                                 .fraction = loading_fraction};
