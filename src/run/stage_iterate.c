/// Stage `iterate`: particles are held where they are, and each step is one iteration of the forces with the strains
/// that these cause (contact.deformation: explicit or relaxed; Madan 2019, "M", 3.2, 3.4):
///     f(k) = forces at the places held, of strain(k),    strain(k+1) = D : stress(f(k)), or theta of the way to it.
/// Their change is d(k) = root mean square over the particles of |strain(k+1) - strain(k)|. It comes to fall, or grow,
/// by one factor an iterate, the largest |eigenvalue| of the iteration, which is M 3.8's spectral radius of B with the
/// explicit scheme: `convergence_factor` = d(k) / d(k-1) of the last k whose change is far above the rounding.
///
/// Method. After the forces of a step all velocities are zero, and what is left of sums of forces is taken up by what
/// holds the particles, so nothing moves and nothing is worked; the kinetic energy that they came with goes out with
/// the hold. Dashpots act on strains that change, as in every step. Cost: a step of the run, and one pass over the
/// bodies.
///
/// Stop rule, at a sample: the change is below `tolerance` times the strain; it has grown tenfold since the first
/// iterate (the iterates diverge, which is a result); or `iterations` of them are done. A strain beyond the small ones
/// is an error, as always.
#include "base/fixed.h"
#include "base/integer_sum.h"
#include "case/check.h"
#include "comm/comm.h"
#include "contact/deformation.h"
#include "contact/stretch.h"
#include "measure/measure.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/step.h"
#include "state/body.h"
#include "state/case_walls.h"

#include <float.h>
#include <math.h>
#include <string.h>

/// Of changes below this share of the strain the rounding of forces to quanta (2^-50 of their bound) shows in the
/// factor.
#define FLOOR 1e-7
/// Times the first change: the iterates diverge.
#define GROWTH 10
/// The forces of the first may be none yet, those of the second have no change before them.
enum { FEWEST = 3 };

typedef struct config {
    int64_t iterations;
    double tolerance; ///< 1
} config;

static const scree_key keys[] = {
    INTEGER(config, iterations, FROM("3"), TO("1e9"),
            .meaning = "Iterations after which the stage ends at the latest."),
    NUMBER(config, tolerance, "1", .standard = "1e-9", FROM("1e-12"), TO("0.1"),
           .meaning = "It ends before when strains change by less than this times themselves."),
};

/// State of the module. Strains as roots of mean squares over the bodies.
typedef struct memory {
    double iteration;             ///< 1, number of the last one
    double strain;                ///< 1
    double first, before, change; ///< 1, changes of the strain: the first, that of the iterate before, the last
    double factor;                ///< 1, NAN: none yet
    double held;                  ///< J, kinetic energy that ended with the holds of the run
} memory;

static memory *memory_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_iterate];
}

#define ONE(member, unit, meaning)                                                                                     \
    SCREE_FIELD_ONE(iterate, memory, member, "iterate/" #member, SCREE_FIELD_DOUBLE, 1, unit, meaning,                 \
                    .range = {.least = 0, .limit = SCREE_LIMIT_NUMBER, .most = DBL_MAX, .undefined = true})
static const scree_field fields[] = {
    ONE(iteration, "1", "number of the last iterate"),
    ONE(strain, "1", "strain of the particles, root of the mean square"),
    ONE(first, "1", "its change in the first iterate"),
    ONE(before, "1", "its change in the iterate before the last"),
    ONE(change, "1", "its change in the last iterate"),
    ONE(factor, "1", "of two changes, one after the other"),
    ONE(held, "J", "kinetic energy that ended when particles were held"),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

// ---- rules -------------------------------------------------------------------------------------------------------

static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    (void)index;
    *key = "stage";
    if (!scree_deformation_iterates(whole))
        return "there is nothing to iterate: strains follow forces a step later with contact.deformation: explicit or "
               "relaxed alone";
    return NULL;
}

// ---- the hold ----------------------------------------------------------------------------------------------------

static void stop(scree_state *state, size_t row)
{
    scree_row *body = &state->row[row];
    body->vx = body->vy = 0;
    if (state->dimension == 2) {
        body->spin = 0;
        return;
    }
    body->vz = 0;
    state->turn[row].wx = state->turn[row].wy = state->turn[row].wz = 0;
}

/// What holds a body bears all that acts on it but its weight, which the kick adds.
static void bear(const scree_model *model, scree_state *state, size_t row)
{
    scree_sum_row *sum = &state->sum[row];
    const double inverse = 1 / state->force_quantum, weight = scree_body_mass(state, row);
    sum->fx = scree_fixed_from(-weight * model->gravity[0], inverse);
    sum->fy = scree_fixed_from(-weight * model->gravity[1], inverse);
    if (state->dimension == 2) {
        sum->torque = 0;
        return;
    }
    sum->fz = scree_fixed_from(-weight * model->gravity[2], inverse);
    memset(&state->torque[row], 0, sizeof state->torque[row]);
}

/// Behind the drift: weight and what bears it differ by the rounding. A load that moves a body has moved it by now.
static scree_status stay(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector velocity, spin;
        scree_body_motion(state, row, velocity, spin);
        if (state->held && state->held[row] && scree_length(velocity) + scree_length(spin) > 0)
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "stage %s holds all particles, and a load moves particle %u in it: end that load "
                                   "before (until)",
                                   c->model->stages[state->stage.index].name, state->id[row]);
        const double *place = state->reference[row];
        state->row[row].x = place[0];
        state->row[row].y = place[1];
        if (state->dimension == 3) state->row[row].z = place[2];
        stop(state, row);
    }
    return SCREE_OK;
}

static void hold_all(const scree_model *model, scree_state *state)
{
    for (size_t row = 0; row < state->count; row++) {
        stop(state, row);
        bear(model, state, row);
    }
}

static scree_status hold(const scree_context *c, scree_error *error)
{
    (void)error;
    hold_all(c->model, c->state);
    return SCREE_OK;
}

// ---- iterates ----------------------------------------------------------------------------------------------------

/// Squares of the strain of a body and of its last change.
static void square(const scree_state *state, size_t row, scree_integer_sum sum[2])
{
    const int d = state->dimension, half = (int)scree_stretch_size(d) / 2;
    const double *stretch = scree_stretch_row(state, row), radius = scree_body_bounding_radius(state, row);
    for (int part = 0; part < 2; part++) {
        double tensor[6];
        scree_tensor_get(d, stretch + part * half, tensor);
        scree_integer_sum_add(&sum[part], scree_tensor_product(d, tensor, tensor) / (radius * radius));
    }
}

/// The strains that the forces of this step will be made with stand.
static scree_status observe(const scree_context *c, scree_error *error)
{
    const scree_state *state = c->state;
    memory *m = memory_of(state);
    scree_integer_sum sum[2] = {0};
    (void)error;
    while (scree_comm_sum_next(state, sum, 2))
        for (size_t row = 0; row < state->count; row++) square(state, row, sum);
    const double count = (double)state->count;
    m->iteration++;
    m->before = m->change;
    m->strain = sqrt(scree_integer_sum_total(&sum[0]) / count);
    m->change = sqrt(scree_integer_sum_total(&sum[1]) / count);
    if (m->first == 0) m->first = m->change;
    if (m->before > 0 && m->change > FLOOR * m->strain) m->factor = m->change / m->before;
    return SCREE_OK;
}

static bool in_use(const scree_context *c)
{
    return c->state->stage.index < c->model->stage_count &&
           c->model->stages[c->state->stage.index].kind == SCREE_SLOT_iterate;
}

// ---- the stage ---------------------------------------------------------------------------------------------------

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state *state = &s->state;
    memory *m = memory_of(state);
    const scree_context context = scree_step_context(s);
    scree_energy energy;
    (void)error;
    *scree_loading_of(state) = (scree_loading){.height = 0};
    if (s->boundary->rest) s->boundary->rest(&context);
    scree_case_walls(state)->moving = 0;
    for (size_t row = 0; row < state->count; row++) scree_body_refer(state, row);
    scree_energy_measure(&s->stage_model, state, &s->table, &energy);
    const double kinetic = energy.kinetic + energy.kinetic_rotation;
    *m = (memory){.factor = NAN, .held = m->held + kinetic};
    state->ledger.turnover += fabs(kinetic);
    hold_all(&s->stage_model, state);
    return SCREE_OK;
}

static double work(const scree_state *state)
{
    return -memory_of(state)->held;
}

static void plan(scree_simulation *s)
{
    const uint64_t largest = s->model.largest_step, count = (uint64_t)own_config(s)->iterations;
    const uint64_t between = count / (uint64_t)s->model.measure.samples;
    s->plan = (scree_stage_plan){.interval = (between > 0 ? between : 1) * largest, .expected = count * largest};
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const memory *m = memory_of(&s->state);
    const bool over = s->state.step - s->state.stage.first_step >= s->plan.expected;
    const bool begun = m->iteration >= FEWEST;
    (void)error;
    const bool converged = begun && m->change <= own_config(s)->tolerance * m->strain;
    const bool diverged = begun && m->change > GROWTH * m->first;
    *done = over || converged || diverged;
    if (diverged)
        (void)snprintf(s->reason, sizeof s->reason, "diverges: changes grow by %.4g an iterate", m->factor);
    else if (converged)
        (void)snprintf(s->reason, sizeof s->reason, "converged in %.0f iterations, by %.4g each", m->iteration,
                       m->factor);
    else
        (void)snprintf(s->reason, sizeof s->reason, "%.0f iterations, changes go by %.4g each", m->iteration,
                       m->factor);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) / (double)s->plan.expected;
}

static double duration(const scree_model *model, const void *own)
{
    return (double)((const config *)own)->iterations * (double)model->largest_step * model->step;
}

static double planned(const scree_model *model, const void *own, double wave)
{
    (void)wave;
    return duration(model, own);
}

// ---- what it tells -----------------------------------------------------------------------------------------------

static const scree_result columns[] = {
    {"iteration", "1", "number of the iterate of the forces in a stage `iterate`"},
    {"iteration_change", "1", "root mean square over the particles of the change of their strain in it"},
};

static const scree_result results[] = {
    {"iterations", "1", "iterates of the last stage `iterate`"},
    {"iteration_change", "1", "change of the strains in its last iterate"},
    {"convergence_factor", "1", "factor by which changes of the strains go from one iterate to the next"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const memory *m = memory_of(c->state);
    (void)index, (void)error;
    value[0] = in_use(c) ? m->iteration : NAN;
    value[1] = in_use(c) ? m->change : NAN;
    return SCREE_OK;
}

static scree_status summarise(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const memory *m = memory_of(c->state);
    (void)index, (void)error;
    value[0] = m->iteration;
    value[1] = m->change;
    value[2] = m->factor;
    return SCREE_OK;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    int64_t k = 0;
    name[0] = 0;
    while (k < whole->stage_count && whole->stages[k].kind != SCREE_SLOT_iterate) k++;
    return index == 0 && k < whole->stage_count;
}

// ---- module ------------------------------------------------------------------------------------------------------

static const scree_stage stage_face = {.name = "iterate",
                                       .loading = true,
                                       .begin = begin,
                                       .plan = plan,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .duration = duration,
                                       .planned = planned};

static const scree_stage_numbers numbers = {.held = true, .still = true, .wrong = wrong};

static const scree_pass passes[] = {{SCREE_PHASE_FIRST_HALF, .run = observe},
                                    {SCREE_PHASE_FOLLOW, .run = stay},
                                    {SCREE_PHASE_SECOND_HALF, .run = hold}};

const scree_module scree_module_iterate = {
    .name = "iterate",
    .meaning = "Holds all particles where they are, and iterates the forces with the strains that they cause.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "holds all particles; their strains and forces are iterated")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .passes = passes,
    .pass_count = COUNT(passes),
    .in_use = in_use,
    .work = work,
    .columns = SCREE_RESULTS(columns, sample),
    .results = SCREE_RESULTS(results, summarise),
    .told = told,
};
