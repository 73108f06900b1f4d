/// Gear's predictor and corrector of fifth order for x'' = f(x, x') (Gear 1971; Roul 2009, "R", 2.20 - 2.28; for
/// translation and rotation alike). With r_k = dt^k / k! d^k x / dt^k, k = 0 .. 5, as R 2.21 has them:
///   predict    r_k <- sum over j >= k of binomial(j, k) r_j                                       R 2.22
///   evaluate   F(x, x') at the predicted x = r_0, x' = r_1 / dt                                   R 2.24
///   correct    e = dt^2 / 2 F / m - r_2,  r_k <- r_k + c_k e                                      R 2.25, 2.26
///   c = 3/16, 251/360, 1, 11/18, 1/6, 1/60                                                        R 2.28
/// R prints e without dt^2 / 2; it carries that factor, in every r_k. In space a sphere has no angle, and r_0 of its
/// rotation is not kept: nothing depends on it.
///
/// The correction of step n stands at the beginning of step n + 1. So between two steps rows hold the places that
/// forces were evaluated at, x_p(n). Their velocities are (x_p(n) - x_p(n-1)) / dt, those of the middle of the step as
/// with every other scheme: springs follow the way that the bodies went, and forces do the work of it. The predicted
/// velocity less that is `lead` of the state; dashpots follow the sum (kinematics_at_end), which makes contact forces
/// without sliding and without tangential springs functions of x and x' at one time. The state has r_2 to r_5 as
/// predicted; r_1 follows from velocity and lead. Velocities told at n are the corrected ones.
///
/// A body begins, or begins anew when somebody gives it a velocity, with r_3 = r_4 = r_5 = 0: it comes to the full
/// order within some five steps, after an error of third order in the step. Where a force jumps or bends, as a contact
/// opens or closes, the series is wrong for as long, and the order is that of the jump: 1 where a dashpot sets in, 2
/// where a linear spring does, 3 with a tangential spring that sticks is not reached: its stretch is summed by the rule
/// of the middle, of second order.
///
/// Energy: nothing is conserved. The kinetic energy T is that of the corrected velocities, and what the scheme adds to
/// it in a step beside the work of the forces by the rule of the ledger (measure/energy.c),
///   T(n+1) - T(n) - sum (F(n) + F(n+1)) / 2 . (x_p(n+1) - x_p(n)),
/// rotation alike, goes into the row `scheme`, each body by itself.
///
/// Stability: of one evaluation a step with dashpots in it, far below a leapfrog's: `limit`, which the critical step of
/// a case follows.
///
/// Order: 5 for places and velocities where forces are smooth (tests/unit/test_gear.c). Cost: one pass more than
/// velocity_verlet, 280 bytes a body, and contacts one at a time: kernels in lanes know no lead.
#include "base/checksum.h"
#include "case/check.h"
#include "comm/guessed_sum.h"
#include "integrate/kick.h"
#include "module/boundary.h"
#include "module/key_rows.h"
#include "state/fields.h"

#define ORDER 5
static const double corrector[ORDER + 1] = {3.0 / 16, 251.0 / 360, 1, 11.0 / 18, 1.0 / 6, 1.0 / 60};

/// r_2 to r_5, predicted, of a vector.
typedef double gear_terms[3][ORDER - 1];

typedef struct gear_row {
    gear_terms place; ///< m
    gear_terms turn;  ///< rad
    double pending;   ///< J, within a step: what it adds so far to the row `scheme`
    uint8_t begun;    ///< 0: the terms are not there yet
} gear_row;

typedef struct own {
    gear_row *row;  ///< a body
    double largest; ///< J, magnitude of the energies that were summed last: what the next ones are guessed from
} own;

static own *own_state(const scree_state *state)
{
    return state->own[SCREE_SLOT_gear];
}

#define BODY(member, kind, count, unit, meaning, ...)                                                                  \
    SCREE_FIELD_BODY(gear, own, row, gear_row, "gear/" #member, kind, count, unit, meaning, .optional = true,          \
                     .offset = offsetof(gear_row, member), __VA_ARGS__)
static const scree_field fields[] = {
    BODY(place, SCREE_FIELD_DOUBLE, 3 * (ORDER - 1), "m",
         "predicted derivatives of the position, k = 2 to 5, times step_size^k / k!: those of x, of y, of z"),
    BODY(turn, SCREE_FIELD_DOUBLE, 3 * (ORDER - 1), "rad", "the same of the angles about x, y, z"),
    BODY(begun, SCREE_FIELD_UINT8, 1, "1", "0: the derivatives are not there yet", SCREE_RANGE(0, 1)),
    SCREE_FIELD_ONE(gear, own, largest, "gear/largest", SCREE_FIELD_DOUBLE, 1, "J",
                    "magnitude of the energies that were summed last", .role = SCREE_FIELD_DERIVED),
};

// ---- one body ------------------------------------------------------------------------------------------------------

/// Velocity and spin as vectors of six.
typedef struct motion {
    double rate[6]; ///< m/s, rad/s
} motion;

static motion motion_of(const scree_state *state, size_t row)
{
    motion m;
    scree_body_motion(state, row, m.rate, m.rate + 3);
    return m;
}

static void set_motion(scree_state *state, size_t row, const motion *m)
{
    scree_row *body = &state->row[row];
    body->vx = m->rate[0];
    body->vy = m->rate[1];
    if (state->dimension == 2) {
        body->spin = m->rate[5];
        return;
    }
    body->vz = m->rate[2];
    state->turn[row].wx = m->rate[3];
    state->turn[row].wy = m->rate[4];
    state->turn[row].wz = m->rate[5];
}

static motion lead_of(const scree_state *state, size_t row)
{
    const scree_predicted *lead = &state->lead[row];
    if (state->dimension == 2) return (motion){{lead->vx, lead->vy, 0, 0, 0, lead->spin}};
    return (motion){{lead->vx, lead->vy, lead->vz, lead->wx, lead->wy, lead->wz}};
}

static void set_lead(scree_state *state, size_t row, const motion *m)
{
    scree_predicted *lead = &state->lead[row];
    *lead = (scree_predicted){.vx = m->rate[0], .vy = m->rate[1]};
    if (state->dimension == 2) {
        lead->spin = m->rate[5];
        return;
    }
    lead->vz = m->rate[2];
    lead->wx = m->rate[3];
    lead->wy = m->rate[4];
    lead->wz = m->rate[5];
}

/// Moves a body by `way` [m], [rad].
static void move(scree_state *state, size_t row, const double way[6])
{
    scree_row *body = &state->row[row];
    body->x += way[0];
    body->y += way[1];
    if (state->dimension == 3)
        body->z += way[2];
    else
        state->angle[row] += way[5];
}

static double *terms_of(gear_row *row, int component)
{
    return component < 3 ? row->place[component] : row->turn[component - 3];
}

/// The corrected r_0 less the predicted one, r_1 to r_5. step: that which led to n. force: or torque, at n.
static void correct(const gear_row *row, const double *predicted, double rate, double lead, double acceleration,
                    double step, double term[ORDER + 1])
{
    const double found = 0.5 * step * step * acceleration;
    if (!row->begun) {
        const double begin[ORDER + 1] = {0, (rate + 0.5 * step * acceleration) * step, found};
        for (int k = 0; k <= ORDER; k++) term[k] = begin[k];
        return;
    }
    const double error = found - predicted[0];
    term[0] = corrector[0] * error;
    term[1] = (rate + lead) * step + corrector[1] * error;
    for (int k = 2; k <= ORDER; k++) term[k] = predicted[k - 2] + corrector[k] * error;
}

/// The way to n + 1 [m], the predicted r_1; the others into `predicted`.
static double predict(const double t[ORDER + 1], double predicted[ORDER - 1], double *first)
{
    *first = t[1] + 2 * t[2] + 3 * t[3] + 4 * t[4] + 5 * t[5];
    predicted[0] = t[2] + 3 * t[3] + 6 * t[4] + 10 * t[5];
    predicted[1] = t[3] + 4 * t[4] + 10 * t[5];
    predicted[2] = t[4] + 5 * t[5];
    predicted[3] = t[5];
    return t[0] + t[1] + t[2] + t[3] + t[4] + t[5];
}

/// Force and torque at n, and what divides them.
typedef struct pull {
    double force[6], inertia[6];
} pull;

static pull pull_of(const scree_model *model, const scree_state *state, size_t row)
{
    pull p;
    scree_body_force(model, state, row, p.force, p.force + 3);
    const double mass = scree_body_mass(state, row), inertia = scree_body_inertia(state, row);
    for (int k = 0; k < 6; k++) p.inertia[k] = k < 3 ? mass : inertia;
    return p;
}

/// The corrected velocity and spin at n.
static motion corrected(const scree_state *state, size_t row, const pull *p, double step)
{
    const gear_row *body = &own_state(state)->row[row];
    const motion m = motion_of(state, row), lead = lead_of(state, row);
    motion to = m;
    for (int k = 0; k < 6 && step > 0; k++) {
        const double *predicted = k < 3 ? body->place[k] : body->turn[k - 3];
        double term[ORDER + 1];
        correct(body, predicted, m.rate[k], lead.rate[k], p->force[k] / p->inertia[k], step, term);
        to.rate[k] = term[1] / step;
    }
    return to;
}

static double kinetic(const motion *m, const pull *p)
{
    double energy = 0;
    for (int k = 0; k < 6; k++) energy += 0.5 * p->inertia[k] * m->rate[k] * m->rate[k];
    return energy;
}

/// Half of the work of the forces at n along the step of the rows.
static double half_work(const motion *m, const pull *p, double step)
{
    double power = 0;
    for (int k = 0; k < 6; k++) power += p->force[k] * m->rate[k];
    return 0.5 * step * power;
}

/// Lengths of the step that led to n and of that which begins.
typedef struct lengths {
    double last, next;
} lengths;

/// Corrects n, predicts n + 1.
static void advance(const scree_model *model, scree_state *state, size_t row, lengths step)
{
    gear_row *body = &own_state(state)->row[row];
    const motion m = motion_of(state, row), lead = lead_of(state, row);
    const pull p = pull_of(model, state, row);
    const double ratio = step.next / step.last;
    motion middle = m, ahead = lead, velocity = m;
    double way[6];
    for (int k = 0; k < 6; k++) {
        double term[ORDER + 1], first, scale = ratio;
        correct(body, terms_of(body, k), m.rate[k], lead.rate[k], p.force[k] / p.inertia[k], step.last, term);
        velocity.rate[k] = term[1] / step.last;
        for (int j = 1; j <= ORDER && ratio != 1; j++, scale *= ratio) term[j] *= scale;
        way[k] = predict(term, terms_of(body, k), &first);
        middle.rate[k] = way[k] / step.next;
        ahead.rate[k] = (first - way[k]) / step.next;
    }
    body->pending = -kinetic(&velocity, &p) - half_work(&middle, &p, step.next);
    body->begun = 1;
    move(state, row, way);
    set_motion(state, row, &middle);
    set_lead(state, row, &ahead);
}

/// Speeds of the way and of the prediction: the larger one bounds forces, the first one the lists.
static scree_speeds speeds_of(const scree_state *state, size_t row)
{
    const motion m = motion_of(state, row), lead = lead_of(state, row);
    double centre = 0, ahead = 0, spin = 0, turning = 0;
    for (int k = 0; k < 6; k++) {
        const double moving = m.rate[k] + lead.rate[k];
        *(k < 3 ? &centre : &spin) += m.rate[k] * m.rate[k];
        *(k < 3 ? &ahead : &turning) += moving * moving;
    }
    const double surface = sqrt(fmax(centre, ahead)) + state->row[row].radius * sqrt(fmax(spin, turning));
    // fmax would lose what is not a number.
    const bool finite = centre + spin + ahead + turning < (double)INFINITY;
    return finite ? (scree_speeds){.surface = surface, .centre = sqrt(centre)}
                  : (scree_speeds){.surface = (double)INFINITY, .centre = (double)INFINITY};
}

// ---- the step ------------------------------------------------------------------------------------------------------

/// What the members of the thread pool share.
typedef struct gear_task {
    const scree_model *model;
    scree_state *state;
    lengths step;
    const uint32_t *moving; ///< rows; NULL: the first `count`
    size_t count;
    scree_speeds speeds[SCREE_THREAD_POOL_MOST];
} gear_task;

/// The sums have been read for the last time: they are left clear.
static void share_first(void *argument, int index, int count)
{
    gear_task *task = argument;
    scree_state *state = task->state;
    const size_t begin = task->count * (size_t)index / (size_t)count;
    const size_t end = task->count * (size_t)(index + 1) / (size_t)count;
    scree_speeds largest = {0};
    for (size_t k = begin; k < end; k++) {
        const size_t row = task->moving ? task->moving[k] : k;
        advance(task->model, state, row, task->step);
        state->sum[row] = (scree_sum_row){0};
        if (state->torque) state->torque[row] = (scree_torque_row){0};
        const scree_speeds speeds = speeds_of(state, row);
        largest.surface = fmax(largest.surface, speeds.surface);
        largest.centre = fmax(largest.centre, speeds.centre);
    }
    task->speeds[index] = largest;
}

static void first(const scree_model *model, scree_state *state, scree_work *work)
{
    gear_task task = {.model = model,
                      .state = state,
                      .step = {.last = 2 * state->kick_size - state->step_size, .next = state->step_size}};
    if (!(task.step.last > 0)) task.step.last = task.step.next;
    const int count = scree_work_shares(work);
    task.moving = scree_moving_rows(state, &task.count);
    scree_thread_pool_run(&work->pool, count, share_first, &task);
    scree_sleep_clear_sums(state);
    work->clear_rows = scree_row_count(state, work);
    scree_speeds largest = {0};
    for (int k = 0; k < count; k++) {
        largest.surface = fmax(largest.surface, task.speeds[k].surface);
        largest.centre = fmax(largest.centre, task.speeds[k].centre);
    }
    scree_moved_tell(state, work, &largest);
}

static void share_second(void *argument, int index, int count)
{
    const gear_task *task = argument;
    const scree_state *state = task->state;
    const size_t begin = task->count * (size_t)index / (size_t)count;
    const size_t end = task->count * (size_t)(index + 1) / (size_t)count;
    for (size_t k = begin; k < end; k++) {
        const size_t row = task->moving ? task->moving[k] : k;
        gear_row *body = &own_state(state)->row[row];
        // A body that was not there when the step began brings its energy with it.
        if (!body->begun) continue;
        const pull p = pull_of(task->model, state, row);
        const motion middle = motion_of(state, row), velocity = corrected(state, row, &p, state->step_size);
        body->pending += kinetic(&velocity, &p) - half_work(&middle, &p, state->step_size);
    }
}

/// The row `scheme` of the ledger. The correction itself waits for the next step.
static void second(const scree_model *model, scree_state *state, scree_work *work)
{
    gear_task task = {.model = model, .state = state};
    task.moving = scree_moving_rows(state, &task.count);
    const gear_row *row = own_state(state)->row;
    scree_thread_pool_run(&work->pool, scree_work_shares(work), share_second, &task);
    scree_guessed_sum added = {{0}, {0}};
    while (scree_guessed_sum_next(state, &added, 1, &own_state(state)->largest))
        for (size_t k = 0; k < state->count; k++) scree_guessed_sum_add(&added, row[k].begun ? row[k].pending : 0);
    state->ledger.scheme += scree_guessed_sum_total(&added);
}

static void velocity_at(const scree_model *model, const scree_state *state, size_t row, scree_vector velocity,
                        scree_vector spin)
{
    const pull p = pull_of(model, state, row);
    // Before the first step rows hold the velocities that the bodies begin with.
    const bool begun = own_state(state)->row && state->lead;
    const motion m = begun ? corrected(state, row, &p, state->step_size) : motion_of(state, row);
    for (int k = 0; k < 3; k++) {
        velocity[k] = m.rate[k];
        spin[k] = m.rate[3 + k];
    }
}

static void begin_anew(scree_state *state, size_t row)
{
    if (!own_state(state)->row) return;
    own_state(state)->row[row].begun = 0;
    state->lead[row] = (scree_predicted){0};
}

/// From the roots of the scheme for x'' = -w^2 x - 2 z w x' (largest magnitude below 1 + 1e-5): w dt below 0.33 without
/// damping, z w dt below 0.0815 with much, and never less than this between.
static double limit(double ratio)
{
    return 1 / hypot(3, 12.3 * ratio);
}

static const scree_integrator integrator = {
    .first = first,
    .second = second,
    .velocity = velocity_at,
    .begin_anew = begin_anew,
    .limit = limit,
    .velocity_lead = 0.0,
};

// ---- the module ----------------------------------------------------------------------------------------------------

/// From velocities that bodies begin with to those half a step before.
static void step_back(const scree_model *model, scree_state *state)
{
    for (size_t row = 0; row < state->count; row++) {
        const pull p = pull_of(model, state, row);
        motion m = motion_of(state, row);
        for (int k = 0; k < 6; k++) m.rate[k] -= 0.5 * state->step_size * p.force[k] / p.inertia[k];
        set_motion(state, row, &m);
    }
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    size_t count;
    if (c->model->scheme != SCREE_SLOT_gear || own_state(c->state)->row) return SCREE_OK;
    scree_status status = scree_state_begin_field(c->state, &fields[0], error);
    const scree_field *core = scree_own_fields(&count);
    for (size_t k = 0; k < count && !status; k++)
        if (strcmp(core[k].name, "lead") == 0) status = scree_state_begin_field(c->state, &core[k], error);
    if (!status) step_back(c->model, c->state);
    return status;
}

static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const bool there = own_state(state)->row && state->lead;
    // Before the first stage that takes steps there is nothing.
    if (model->scheme != SCREE_SLOT_gear || state->evaluations == 0 || there) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "dataset 'gear/place': missing, although integrator.scheme is gear");
}

/// With what the rows hold the terms say what comes.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const gear_row *rows = own_state(state)->row;
    if (model->scheme != SCREE_SLOT_gear || !rows) return c;
    size_t id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        const motion lead = lead_of(state, row);
        c = scree_checksum_numbers(scree_checksum_word(c, rows[row].begun), lead.rate, 6);
        c = scree_checksum_numbers(c, rows[row].place[0], 3 * (ORDER - 1));
        c = scree_checksum_numbers(c, rows[row].turn[0], 3 * (ORDER - 1));
    }
    return c;
}

/// A boundary that imposes a motion finds the force for it from the next kick of a leapfrog. Others that do so refuse
/// every scheme with velocities of its own.
static void rules(scree_reader *reader, const scree_config *config)
{
    const char *const path = "integrator.scheme", *const others =
                                                      scree_rule_choices(reader, path, ", ", scree_scheme_is_leapfrog);
    if (config->boundary.periodic != SCREE_PERIODIC_NONE) {
        scree_rule_refuse(reader, path, others,
                          "gear has not been made for periodic cells, whose bodies move with the cell: choose another "
                          "scheme, or boundary.periodic: none");
        return;
    }
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_boundary *boundary = scree_config_held_by(config, i);
        if (!boundary || !(boundary->equal_steps || boundary->free || boundary->periodic)) continue;
        scree_rule_refuse(reader, path, others,
                          "stages.%lld imposes velocities by forces that a leapfrog turns into them; gear does not",
                          (long long)i);
        return;
    }
}

const scree_module scree_module_gear = {
    .name = "gear",
    .meaning = "predictor and corrector of fifth order (Gear 1971; Roul 2009, 2.3.1)",
    .choice_of = CHOICE_OF(IS("integrator.scheme")),
    .rules = rules,
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .begin = begin,
    .integrator = &integrator,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
