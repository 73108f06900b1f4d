/// Stage `rotate_particle` (P 4.2): the spin of one particle is raised linearly to a value and held; nothing else
/// changes. Under minimal conditions the components of the velocity gradient beside the diagonal are held at zero, so
/// that the sample as a whole does not turn.
///
/// Three spans of time. Rest: the particle is held still, and what the others turn by all the same (a sample under
/// pressure creeps) is the background. Ramp: w(n+1/2) = spin (t(n+1/2) - rest) / ramp. Hold: w = spin. Angles are set
/// back to zero at the begin of each but the ramp after no rest, so that at the end they are the rotations of the hold:
/// over its time the mean spins, from which the waves of single instants have gone.
/// state.stage.reference: run/stage.h, SCREE_LOADING_... and SCREE_ROTATE_...
#include "base/fixed.h"
#include "base/integer_sum.h"
#include "boundary/minimal.h"
#include "integrate/forced_spin.h"
#include "measure/imposed_gradient.h"
#include "measure/measure.h"
#include "measure/rotation.h"
#include "run/simulation.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define RAMP_WAVES 4.0
#define CENTRE     2.5 /* mean diameters */

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
    while (scree_integer_sum_next(sum, 3))
        for (size_t row = 0; row < state->count; row++) {
            if (!scree_body_is_grain(state, row)) continue;
            scree_body_place(state, row, place);
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
        scree_body_place(state, row, place);
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
    double named = scree_stage_config(s)->particle;
    int64_t *load = NULL;
    long long stage = (long long)s->state.stage.index;
    int64_t found = isnan(named) ? -1 : (int64_t)named;
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

/// The boundary as a whole keeps its shape of angles and does not turn.
static void hold_rotation(scree_simulation *s)
{
    scree_imposed_gradient *drive = scree_imposed(&s->state);
    int dimension = s->state.dimension;
    double penalty = s->model.config->boundary.penalty, rate[9] = {0};
    memset(drive->target, 0, sizeof drive->target);
    for (int c = 0; c < 9; c++)
        drive->prescribed[c] = c / 3 != c % 3 && c / 3 < dimension && c % 3 < dimension ? SCREE_FULL : SCREE_FREE;
    // The scale of the rates that are to be held back: those of the particle.
    rate[1] = scree_stage_config(s)->spin;
    drive->viscosity = isnan(penalty) ? scree_minimal_viscosity(scree_pressure_now(&s->state), rate) : penalty;
}

/// Ticks from the begin of the stage to the ends of rest, ramp and hold.
typedef struct course {
    uint64_t rest, ramp, hold;
} course;

static course course_of(const scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    double wave = s->state.stage.reference[SCREE_LOADING_WAVE];
    course c = {.rest = stage->rest_time > 0 ? scree_stage_ticks(s, stage->rest_time) : 0};
    c.ramp = c.rest + scree_stage_ticks(s, isnan(stage->ramp_time) ? RAMP_WAVES * wave : stage->ramp_time);
    c.hold = c.ramp + scree_stage_ticks(s, stage->hold_time);
    return c;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    uint32_t id = 0;
    scree_loading_begin(s);
    hold_rotation(s);
    scree_status status = choose(s, &id, error);
    if (status) return status;
    course c = course_of(s);
    double ramp = (double)(c.ramp - c.rest) * s->state.tick, hold = (double)(c.hold - c.ramp) * s->state.tick;
    s->state.stage.reference[SCREE_ROTATE_BACKGROUND] = NAN;
    s->state.stage.reference[SCREE_ROTATE_TURN] = scree_stage_config(s)->spin * (0.5 * ramp + hold);
    scree_forced_spin_begin(&s->state, id);
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    course c = course_of(s);
    s->plan = scree_loading_plan(s, (double)c.hold * s->state.tick);
    s->plan.expected = c.hold;
}

/// What the particles that bear load turn by at rest, over the prescribed spin.
static double background(const scree_simulation *s, uint64_t ticks)
{
    double mean = scree_rotation_mean_amount(&s->state, s->state.row_of_id[scree_forced(&s->state)->id]);
    double time = s->state.dimension == 2 ? (double)ticks * s->state.tick : 1;
    return mean / (time * scree_stage_config(s)->spin);
}

static void forget_angles(scree_state *state)
{
    if (state->angle) memset(state->angle, 0, state->count * sizeof *state->angle);
}

static void control(scree_simulation *s)
{
    scree_state *state = &s->state;
    const scree_config_stage *stage = scree_stage_config(s);
    const course c = course_of(s);
    uint64_t done = state->step - state->stage.first_step;
    if (done == c.rest && c.rest > 0) {
        state->stage.reference[SCREE_ROTATE_BACKGROUND] = background(s, c.rest);
        forget_angles(state);
    }
    if (done == c.ramp) forget_angles(state);
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
