/// Stage `rotate_particle` (P 4.2): the spin of one particle is raised linearly to a value and held; nothing else
/// changes. Under minimal conditions the components of the velocity gradient beside the diagonal are held at zero, so
/// that the sample as a whole does not turn.
///
/// Three spans of time. Rest: the particle is held still, and what the others turn by all the same (a sample under
/// pressure creeps) is the background. Ramp: w(n+1/2) = spin (t(n+1/2) - rest) / ramp. Hold: w = spin. Angles are set
/// back to zero at the begin of each but the ramp after no rest, so that at the end they are the rotations of the hold:
/// over its time the mean spins, from which the waves of single instants have gone.
#include "base/fixed.h"
#include "base/integer_sum.h"
#include "case/check.h"
#include "comm/comm.h"
#include "integrate/forced_spin.h"
#include "measure/measure.h"
#include "measure/rotation.h"
#include "module/integrator.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/rotation_results.h"
#include "run/stage_rotate_config.h"
#include "run/step.h"
#include "state/pressure.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define RAMP_WAVES 4.0
#define CENTRE     2.5 /* mean diameters */

typedef scree_rotate_config config;
static const scree_choice axes[] = {
    {"x", SCREE_AXIS_X, "only in 3D"},
    {"y", SCREE_AXIS_Y, "only in 3D"},
    {"z", SCREE_AXIS_Z, "out of the plane in 2D"},
    {0},
};
static const scree_key keys[] = {
    NUMBER(config, spin, "rad/s", ABOVE("0 rad/s"), TO("1e6 rad/s"),
           .meaning = "Angular velocity of the forced particle."),
    CHOICE(config, axis, axes, .standard = "z", .meaning = "Axis that it turns about."),
    NUMBER(config, particle, "1", .standard = "auto", FROM("0"), TO("1e9"),
           .meaning = "Number of the forced particle, from 0; auto: of those near the centre the one that bears most."),
    NUMBER(config, rest_time, "s", .standard = "0 s", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time before, in which it is held still and the spins that there are anyway are measured."),
    NUMBER(config, ramp_time, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time in which the spin is reached, linearly; auto: four wave times of the sample."),
    NUMBER(config, hold_time, "s", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time for which it is held, in which the spins of the others are measured."),
    NUMBER(config, cutoff, "1", .standard = "10", ABOVE("0"), TO("1e4"),
           .meaning = "Radius around the particle, in mean diameters, of the force network that is measured."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// Sum of the normal forces on each row, in quanta of their own, so that the order of contacts does not show; room for
/// them is made. Errors: memory.
static scree_status measure_loads(scree_simulation *s, int64_t **load, scree_error *error)
{
    double largest = 0;
    scree_status status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    if (!status) status = scree_allocate(load, s->state.count, sizeof **load, error);
    for (size_t c = 0; !status && c < s->table.count; c++)
        largest = fmax(largest, fabs(s->table.contact[c].normal_force));
    double inverse = 1 / scree_fixed_quantum(largest);
    for (size_t c = 0; !status && c < s->table.count; c++) {
        const scree_contact *contact = &s->table.contact[c];
        int64_t quanta = scree_fixed_from(contact->normal_force, inverse);
        (*load)[contact->first] += quanta;
        if (!contact->wall) (*load)[contact->second] += quanta;
    }
    return status;
}

/// Mean position of the assembly.
static void find_centre(const scree_state *state, scree_vector centre)
{
    scree_integer_sum sum[3] = {0};
    scree_vector place;
    while (scree_comm_sum_next(state, sum, 3))
        for (size_t row = 0; row < state->count; row++) {
            if (!scree_body_is_grain(state, row)) continue;
            scree_body_position(state, row, place);
            for (int i = 0; i < 3; i++) scree_integer_sum_add(&sum[i], place[i]);
        }
    for (int i = 0; i < 3; i++) centre[i] = scree_integer_sum_total(&sum[i]) / (double)scree_grain_count(state);
}

/// Id of the particle that bears most of those within CENTRE mean diameters of the centre of the assembly that touch
/// three others or more (four in 3D); -1: none. One that bears little slides on its neighbours and turns none of them.
static int64_t find_central(const scree_simulation *s, const int64_t *load)
{
    const scree_state *state = &s->state;
    scree_vector centre, place;
    find_centre(state, centre);
    int64_t best = -1, most = 0;
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        for (int i = 0; i < 3; i++) place[i] -= centre[i];
        int64_t id = state->id[row];
        bool held = state->sum[row].contacts > state->dimension;
        if (!held || scree_length(place) > CENTRE * 2 * s->model.mean_radius || load[row] <= 0) continue;
        // Of two that bear the same the one with the lower id, in whatever order they come.
        if (load[row] < most || (load[row] == most && id > best)) continue;
        most = load[row];
        best = id;
    }
    return best;
}

/// The particle that the case names, or the central one.
static scree_status choose(scree_simulation *s, uint32_t *id, scree_error *error)
{
    double named = own_config(s)->particle;
    int64_t *load = NULL;
    long long stage = (long long)s->state.stage.index;
    int64_t found = isnan(named) ? -1 : (int64_t)named;
    if (s->state.form)
        return scree_error_set(error, SCREE_ERROR_GUARD,
                               "stage %lld (rotate_particle): rotations are measured of round particles alone, from "
                               "where they lie at the begin",
                               stage);
    if (isnan(named)) {
        scree_status status = measure_loads(s, &load, error);
        if (!status) found = find_central(s, load);
        scree_release(&load);
        if (status) return status;
    }
    if (found < 0)
        return scree_error_set(error, SCREE_ERROR_GUARD,
                               "stage %lld (rotate_particle): no particle near the centre is held by others", stage);
    size_t row = scree_state_row_of(&s->state, (size_t)found);
    if (row == SCREE_NO_ROW || !scree_body_is_grain(&s->state, row))
        return scree_error_set(error, SCREE_ERROR_GUARD,
                               "stage %lld (rotate_particle): there is no particle %lld; ids are below %zu", stage,
                               (long long)found, s->state.next_id);
    *id = (uint32_t)found;
    return SCREE_OK;
}

/// The boundary as a whole keeps its shape of angles and does not turn, where it can be told to.
static void hold_rotation(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    const int dimension = s->state.dimension;
    // The scale of the rates that are to be held back: those of the particle.
    scree_demand demand = {.scale = own_config(s)->spin};
    for (int c = 0; c < 9; c++) {
        demand.how[c] = c / 3 != c % 3 && c / 3 < dimension && c % 3 < dimension ? SCREE_FULL : SCREE_FREE;
        demand.stress[c] = NAN;
    }
    if (s->boundary->deform) s->boundary->deform(&context, &demand, 1);
}

/// Ticks from the begin of the stage to the ends of rest, ramp and hold.
typedef struct course {
    uint64_t rest, ramp, hold;
} course;

static course course_of(const scree_simulation *s)
{
    const config *stage = own_config(s);
    double wave = scree_loading_of(&s->state)->wave_time;
    course c = {.rest = stage->rest_time > 0 ? scree_stage_ticks(s, stage->rest_time) : 0};
    c.ramp = c.rest + scree_stage_ticks(s, isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time);
    c.hold = c.ramp + scree_stage_ticks(s, stage->hold_time);
    return c;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    uint32_t id = 0;
    scree_loading_begin(s, scree_pressure_now(&s->state));
    hold_rotation(s);
    scree_status status = choose(s, &id, error);
    if (status) return status;
    course c = course_of(s);
    double ramp = (double)(c.ramp - c.rest) * s->state.tick, hold = (double)(c.hold - c.ramp) * s->state.tick;
    scree_rotation *own = scree_rotation_of(&s->state);
    *own = (scree_rotation){.background.mean = NAN, .turn = own_config(s)->spin * (0.5 * ramp + hold)};
    for (int b = 0; b < SCREE_ROTATION_BINS; b++) own->background.shell[b] = NAN;
    scree_forced_spin_begin(&s->state, id);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    course c = course_of(s);
    s->plan = scree_loading_plan(s, (double)c.hold * s->state.tick, NAN);
    s->plan.expected = c.hold;
}

/// What the particles that bear load turn by at rest, over the prescribed spin.
static void measure_background(const scree_simulation *s, uint64_t ticks)
{
    const double time = s->state.dimension == 2 ? (double)ticks * s->state.tick : 1;
    scree_rotation_background_measure(&s->model, &s->state, s->state.row_of_id[scree_forced(&s->state)->id],
                                      time * own_config(s)->spin, &scree_rotation_of(&s->state)->background);
}

/// The background is measured once.
static bool control_whole(const scree_simulation *s)
{
    const course c = course_of(s);
    return c.rest > 0 && s->state.step - s->state.stage.first_step == c.rest;
}

static void control(scree_simulation *s)
{
    scree_state *state = &s->state;
    const config *stage = own_config(s);
    const course c = course_of(s);
    uint64_t done = state->step - state->stage.first_step;
    if (done == c.rest && c.rest > 0) {
        measure_background(s, c.rest);
        scree_rotations_begin(state);
    }
    if (done == c.ramp) scree_rotations_begin(state);
    scree_vector spin = {0};
    double middle = ((double)done - (double)c.rest) * state->tick + 0.5 * state->step_size;
    if (done >= c.rest) spin[stage->axis] = fmin(1, middle / ((double)(c.ramp - c.rest) * state->tick)) * stage->spin;
    scree_forced_spin_set(state, spin);
}

static double fraction(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) / (double)s->plan.expected;
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    *done = s->state.step - s->state.stage.first_step >= s->plan.expected;
    (void)snprintf(s->reason, sizeof s->reason, "spin %.4g rad/s held for %.4g s", own_config(s)->spin,
                   own_config(s)->hold_time);
    return SCREE_OK;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    (void)model;
    const config *stage = own;
    return stage->rest_time + (isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time) + stage->hold_time;
}

/// A particle that there is not is left open.
static void shrink(void *own, int64_t count)
{
    config *stage = own;
    if (!(stage->particle < (double)count)) stage->particle = NAN;
}

/// Why the forced particle cannot be turned, or NULL.
static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    const config *stage = whole->stages[index].own;
    *key = "stage";
    if (whole->boundary.periodic > 0)
        return "a particle is not turned in a periodic sample, where it would feel its own images: leave out "
               "boundary.periodic";
    *key = "axis";
    if (stage->axis != SCREE_AXIS_Z && whole->dimension == 2) return "in two dimensions a particle turns about z only";
    *key = "particle";
    if (isnan(stage->particle)) return NULL;
    if (stage->particle != floor(stage->particle)) return "the number of a particle is whole";
    return stage->particle < (double)whole->particles.count
               ? NULL
               : "there is no such particle: numbers begin at 0 and end below particles.count";
}

static const scree_stage stage_face = {.name = "rotate_particle",
                                       .loading = true,
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .control_whole = control_whole,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .quasistatic = true,
                                       .planned = planned,
                                       .shrink = shrink};

static const scree_stage_numbers numbers = {.held = true,
                                            .needs_pressure =
                                                "a confine stage must come before: rotate_particle keeps its pressure",
                                            .wrong = wrong};

#define SOME(member, name, components, unit, meaning)                                                                  \
    SCREE_FIELD_ONE(rotate_particle, scree_rotation, member, "rotate_particle/" name, SCREE_FIELD_DOUBLE, components,  \
                    unit, meaning,                                                                                     \
                    .range = {.least = -DBL_MAX, .limit = SCREE_LIMIT_NUMBER, .most = DBL_MAX, .undefined = true})
static const scree_field fields[] = {
    SOME(background.mean, "background", 1, "1", "spins at rest over the prescribed one; not a number: no rest"),
    SOME(background.shell, "shells", SCREE_ROTATION_BINS, "1",
         "the same of the shells around the particle, a mean diameter wide, from half a diameter on"),
    SOME(turn, "turn", 1, "rad", "angle that the particle turns by in the whole stage"),
};

static const scree_result results[] = {
    {"forced_particle", "1", "number of the particle"},
    {"rotation_reach", "1", "how far rotations are felt, in mean diameters"},
    SCREE_RESULT_INTERVAL("rotation_decay_length", "1", "decay length of the rotations in mean diameters"),
    {"rotation_at_contact", "1", "rotation of the neighbours over that of the particle"},
    {"rotation_background", "1", "rotation without the forced one"},
    {"rotation_felt", "1", "rotation that counts as felt"},
    SCREE_RESULT_INTERVAL("rotation_chain_correlation", "1", "correlation of rotations with force chains"),
    SCREE_RESULT_INTERVAL("rotation_chain_alignment", "1", "alignment of rotations with force chains"),
    SCREE_RESULT_INTERVAL("rotation_across_chains", "1", "the same across the chains"),
    {"rotation_handed_strong", "1", "what a strong contact that leads outward hands on of a rotation"},
    {"rotation_handed_weak", "1", "the same of weak contacts"},
    {"rotation_handed_aside", "1", "the same of contacts that do not lead outward"},
    {"rotation_handed_crossed", "1", "the same of contacts that lead outward to a grain that a strong chain crosses"},
    {"rotation_handed_open", "1", "the same of those that lead to a grain that none crosses"},
    {"rose_eigenvector_angle", "degree", "angle between the peak of the rose and the first axis of T"},
    {"rotation_tensor_angle", "degree", "angle of the first axis of T"},
    {"rotation_tensor_first", "1", "largest eigenvalue of T"},
    {"rotation_tensor_last", "1", "least eigenvalue of T"},
    {"rotation_tensor_off_diagonal", "1", "off-diagonal part of T over its diagonal"},
    {"rigid_rotation_ratio", "1", "rotation of the boundary over that of the particle"},
};

/// The torque that prescribes the spin is found from the kicks of a leapfrog (integrate/forced_spin.c).
static void rules(scree_reader *reader, const scree_config *whole)
{
    if (whole->integrator.scheme < 0 || !scree_integrator_get(whole->integrator.scheme)->velocity) return;
    for (int64_t i = 0; i < whole->stage_count; i++) {
        if (whole->stages[i].kind != SCREE_SLOT_rotate_particle) continue;
        scree_rule_refuse(reader, "integrator.scheme",
                          scree_rule_choices(reader, "integrator.scheme", ", ", scree_scheme_is_leapfrog),
                          "stages.%lld prescribes a spin in the steps of a leapfrog: choose such a scheme",
                          (long long)i);
        return;
    }
}

const scree_module scree_module_rotate_particle = {
    .name = "rotate_particle",
    .meaning =
        "Turns one particle at a prescribed spin under the pressure reached before; with `minimal` the sample as a "
        "whole is "
        "kept from turning.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "turns one particle and watches how rotations spread")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers = &numbers,
    .spreads = true,
    .stage = &stage_face,
    .state_size = sizeof(scree_rotation),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = scree_rotation_conclude,
};
