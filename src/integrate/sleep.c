/// Who falls asleep and who wakes, at the begin of a step, from what is known at n. Bodies that are quiet in a pile are
/// left out of the step: they are not moved, and contacts among them are not evaluated, so that a step costs what is
/// awake.
///
/// Falls asleep: what touches something, is not prescribed, and has for `window` been quiet: its resultant force was
/// below `force` times its weight, its resultant torque below that times its radius, and its surface so slow that it
/// would have gone no farther than `motion` radii in the window. It is looked at every LOOK_EVERY steps. Its velocity
/// is taken away, and the kinetic energy accumulated in the ledger; so is what a scheme counts of one that wakes.
///
/// Wakes: what something that is awake, a wall or a load acts on so that the mean of its resultant (with its weight and
/// what others that sleep exert) over the last window, fading exponentially, exceeds `wake` times its weight: it would
/// have been given that momentum. The mean is taken in every step, and looked at every WAKE_EVERY, one by one, so that
/// a push runs through a pile as far as it is strong. Every LOOK_EVERY steps wakes, too, what has lost a contact since
/// the look before, one that it had when it fell asleep or with what came to rest beside it later, and what others that
/// sleep alone leave out of balance by more than `wake`: a hole below, or beside, is a push as well. All wake every
/// `interval`, and none falls asleep for SCREE_SLEEP_HOLD windows then: what sleepers bear in vain, each less than
/// `wake`, goes on to where it belongs as a wave does, in the time of one. (Were each woken by what it bears in vain,
/// it would hand half of it back to those above: a weight would go down n layers by a walk of n^2 steps, each a window
/// long.) All wake when gravity changes, when a wall begins to move or stops, when the sources have stopped, when
/// another stage begins, and before one that sleeps is taken out or changed from outside.
///
/// What two that sleep exert on each other is a function of their poses and of what their contact remembers: elastic
/// forces, no dashpots. It is added to both when the second of them falls asleep, and taken away when the first wakes,
/// as whole numbers (state/sleep.h). So is what walls that stand exert; what all that sleep exert on each of these is
/// summed anew whenever some beside walls fall asleep or wake.
///
/// An approximation: pushes below `wake` do not pass what sleeps until all wake, and motion below `force` and `motion`
/// stops; momentum is not kept by what sleeps, as by a wall. What it changes is measured in docs/theory/pouring.md.
/// Cost: 0.5 ns a body that sleeps, 20 ns one that is pushed, or awake (every LOOK_EVERY steps); 2 ns a pair of
/// neighbours when one falls asleep or wakes (search/sections.c).
#include "state/sleep.h"

#include "base/checksum.h"
#include "base/integer_sum.h"
#include "case/config.h"
#include "comm/comm.h"
#include "contact/resting.h"
#include "integrate/integrate.h"
#include "module/stage.h"
#include "search/neighbours.h"
#include "state/births.h"
#include "state/case_walls.h"
#include "state/plates.h"

#include <float.h>
#include <math.h>
#include <string.h>

/// Steps from one time at which some wake, or all are looked at, to the next: each change looks at all pairs.
enum { WAKE_EVERY = 16, LOOK_EVERY = 128 };
/// Rows that are looked at together.
enum { BLOCK = 16 };
_Static_assert(LOOK_EVERY % WAKE_EVERY == 0, "all are found in the steps in which some may wake");

// ---- whether ------------------------------------------------------------------------------------------------------

static const scree_sleep_limits none = {.window = NAN};

static scree_sleep_limits limits_in(const scree_config_stage *stage)
{
    const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
    return numbers->sleep ? numbers->sleep(stage->own) : none;
}

static scree_sleep_limits limits_of(const scree_model *model, const scree_state *state)
{
    return state->stage.index < model->stage_count ? limits_in(&model->stages[state->stage.index]) : none;
}

bool scree_some_may_sleep(const scree_config_stage *stage, int64_t count)
{
    for (int64_t k = 0; k < count; k++) {
        if (stage[k].kind < 0 || !stage[k].own) continue; // wrong, and noted
        if (!isnan(limits_in(&stage[k]).window)) return true;
    }
    return false;
}

static bool may_sleep(const scree_context *c, const scree_sleep_limits *limits)
{
    return !isnan(limits->window) && scree_births_of(c->state)->end == SCREE_POUR_GOES_ON &&
           scree_length(c->model->gravity) > 0;
}

static scree_status make_room(scree_state *state, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_module_sleep.field_count && !status; k++)
        if (scree_module_sleep.fields[k].rows == SCREE_ROWS_BODIES)
            status = scree_state_begin_field(state, &scree_module_sleep.fields[k], error);
    return status;
}

// ---- who ----------------------------------------------------------------------------------------------------------

/// Resultant force over weight, and torque over weight and radius.
static void find_resultant(const scree_context *c, size_t row, double resultant[6])
{
    const scree_state *state = c->state;
    const double weight = scree_body_mass(state, row) * scree_length(c->model->gravity);
    scree_body_force(c->model, state, row, resultant, resultant + 3);
    for (int k = 0; k < 3; k++) {
        resultant[k] /= weight;
        resultant[3 + k] /= weight * state->row[row].radius;
    }
}

/// The larger of the two.
static double size_of(const double resultant[6])
{
    return fmax(scree_length(resultant), scree_length(resultant + 3));
}

static bool is_quiet(const scree_context *c, const scree_sleep_limits *limits, size_t row)
{
    const scree_state *state = c->state;
    const double radius = state->row[row].radius;
    scree_vector velocity, spin;
    if (!scree_body_is_grain(state, row) || scree_body_held(state, row) || state->sum[row].contacts == 0) return false;
    scree_body_motion(state, row, velocity, spin);
    const double speed = scree_length(velocity) + radius * scree_length(spin);
    double resultant[6];
    if (speed * limits->window > limits->motion * radius) return false;
    find_resultant(c, row, resultant);
    return size_of(resultant) <= limits->force;
}

/// Marks those that fall asleep; returns how many.
static size_t mark_falling(const scree_context *c, const scree_sleep_limits *limits)
{
    scree_sleep *sleep = scree_sleep_of(c->state);
    size_t count, found = 0;
    const uint32_t *moving = scree_moving_rows(c->state, &count);
    const double needed = limits->window / c->state->step_size;
    for (size_t k = 0; k < count; k++) {
        const size_t row = moving ? moving[k] : k;
        sleep->quiet[row] = is_quiet(c, limits, row) ? sleep->quiet[row] + LOOK_EVERY : 0;
        if (!(sleep->quiet[row] >= needed)) continue;
        sleep->asleep[row] = SCREE_FALLS;
        found++;
    }
    return found;
}

/// Adds the resultant of a step to the mean that fades within the window.
static void add_push(const scree_context *c, const scree_sleep_limits *limits, size_t row)
{
    double *push = scree_sleep_of(c->state)->push[row], resultant[6];
    find_resultant(c, row, resultant);
    const double share = fmin(c->state->step_size / limits->window, 1);
    for (int k = 0; k < 6; k++) push[k] += share * (resultant[k] - push[k]);
}

/// Half a row of sums, or of torques, as large as what every machine takes at once.
typedef int64_t two_words __attribute__((vector_size(16), aligned(8), may_alias));
_Static_assert(2 * sizeof(two_words) == sizeof(scree_sum_row) && 2 * sizeof(two_words) == sizeof(scree_torque_row),
               "rows are looked at whole");

static bool are_zero(const two_words *half_row, size_t count)
{
    two_words any = {0}, other = {0};
    for (size_t k = 0; k < 2 * count; k += 2) {
        any |= half_row[k];
        other |= half_row[k + 1];
    }
    any |= other;
    return (any[0] | any[1]) == 0;
}

/// Whether something that is awake, a wall or a load acts on some of these rows.
static bool some_are_pushed(const scree_state *state, size_t begin, size_t count)
{
    return !are_zero((const two_words *)&state->sum[begin], count) ||
           (state->torque && !are_zero((const two_words *)&state->torque[begin], count));
}

/// Counts its contacts; returns whether they are fewer than it had. Those that touch it in passing are not counted, but
/// with what has come to rest beside it.
static bool count_contacts(const scree_state *state, size_t row)
{
    scree_sleep *sleep = scree_sleep_of(state);
    const int64_t resting = sleep->resting[row].contacts, all = resting + state->sum[row].contacts;
    scree_counted *counted = &sleep->counted[row];
    if (all < counted->contacts) return true;
    if (resting > counted->resting) counted->contacts = all;
    counted->resting = resting;
    return false;
}

/// How far it is out of balance, over its weight: of what is pushed the mean, else what others that sleep leave.
static double imbalance(const scree_context *c, size_t row)
{
    double resultant[6];
    if (some_are_pushed(c->state, row, 1)) return size_of(scree_sleep_of(c->state)->push[row]);
    find_resultant(c, row, resultant);
    return size_of(resultant);
}

/// Marks those that wake because of what is no longer beside them, or never was; returns how many.
static size_t mark_left(const scree_context *c, const scree_sleep_limits *limits)
{
    const scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    size_t found = 0;
    for (size_t row = 0; row < state->count && sleep->count > 0; row++) {
        if (sleep->asleep[row] != SCREE_ASLEEP) continue;
        const bool lost = count_contacts(state, row);
        if (!(imbalance(c, row) > limits->wake) && !lost) continue;
        sleep->asleep[row] = SCREE_WAKES;
        found++;
    }
    return found;
}

/// Marks those that wake; returns how many. What nothing acts on but others that sleep keeps its mean.
static size_t mark_waking(const scree_context *c, const scree_sleep_limits *limits)
{
    const bool now = c->state->evaluations % WAKE_EVERY == 0;
    const scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    size_t found = 0, end;
    sleep->pushed_count = 0;
    for (size_t begin = 0; begin < state->count && sleep->count > 0; begin = end) {
        end = begin + BLOCK < state->count ? begin + BLOCK : state->count;
        if (!some_are_pushed(state, begin, end - begin)) continue;
        for (size_t row = begin; row < end; row++) {
            if (sleep->asleep[row] != SCREE_ASLEEP || !some_are_pushed(state, row, 1)) continue;
            sleep->pushed[sleep->pushed_count++] = (uint32_t)row;
            add_push(c, limits, row);
            if (!now || size_of(sleep->push[row]) <= limits->wake) continue;
            sleep->asleep[row] = SCREE_WAKES;
            found++;
        }
    }
    return found;
}

// ---- the change -----------------------------------------------------------------------------------------------------

static void stop(scree_state *state, size_t row)
{
    scree_row *body = &state->row[row];
    body->vx = body->vy = 0;
    if (state->dimension == 2)
        body->spin = 0;
    else {
        body->vz = 0;
        state->turn[row].wx = state->turn[row].wy = state->turn[row].wz = 0;
    }
}

/// Kinetic energy v(n - 1/2) . v(n + 1/2) with which one that sleeps comes back into the step: none but that of a
/// scheme whose velocity of n is that of rest, so that the two are opposite; or that of a scheme which has a velocity
/// of its own at n, as the forces at n give it to one that had none [J].
static double kinetic_of_waking(const scree_context *c, size_t row)
{
    const scree_integrator *integrator = scree_integrator_get(c->model->scheme);
    const double lead = integrator->velocity_lead, step = c->state->step_size;
    scree_vector force, torque, velocity, spin;
    if (integrator->velocity) {
        integrator->velocity(c->model, c->state, row, velocity, spin);
        return 0.5 * (scree_body_mass(c->state, row) * scree_dot(velocity, velocity) +
                      scree_body_inertia(c->state, row) * scree_dot(spin, spin));
    }
    scree_body_force(c->model, c->state, row, force, torque);
    return -0.5 * lead * (1 - lead) * step * step *
           (scree_dot(force, force) / scree_body_mass(c->state, row) +
            scree_dot(torque, torque) / scree_body_inertia(c->state, row));
}

/// What a body has less of it at the end of this change [J].
static double kinetic_taken(const scree_context *c, size_t row)
{
    const uint8_t mark = scree_sleep_of(c->state)->asleep[row];
    double translation, rotation;
    if (mark == SCREE_WAKES) return -kinetic_of_waking(c, row);
    if (mark != SCREE_FALLS) return 0;
    scree_body_kinetic(c->model, c->state, row, &translation, &rotation);
    return translation + rotation;
}

static void book_taken(const scree_context *c)
{
    scree_state *state = c->state;
    scree_integer_sum taken = {0};
    while (scree_comm_sum_next(state, &taken, 1))
        for (size_t row = 0; row < state->count; row++) scree_integer_sum_add(&taken, kinetic_taken(c, row));
    scree_sleep_of(state)->taken += scree_integer_sum_total(&taken);
    state->ledger.turnover += fabs(scree_integer_sum_total(&taken));
}

void scree_sleep_wake_all(const scree_context *c)
{
    scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    sleep->woken = scree_state_time(state);
    if (sleep->count == 0) return;
    for (size_t row = 0; row < state->count; row++)
        if (sleep->asleep[row]) sleep->asleep[row] = SCREE_WAKES;
    book_taken(c);
    scree_sleep_end(state);
}

/// Rows that are marked, before pairs are moved: velocities of those that fall, sums of those that wake.
static void begin_change(const scree_context *c)
{
    scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    const scree_integrator *integrator = scree_integrator_get(c->model->scheme);
    book_taken(c);
    for (size_t row = 0; row < state->count; row++) {
        if (sleep->asleep[row] == SCREE_FALLS)
            stop(state, row);
        else if (sleep->asleep[row] == SCREE_WAKES)
            scree_sleep_add_resting(state, row);
        if (integrator->begin_anew && sleep->asleep[row] > SCREE_ASLEEP) integrator->begin_anew(state, row);
    }
}

static void end_change(scree_state *state)
{
    scree_sleep *sleep = scree_sleep_of(state);
    for (size_t row = 0; row < state->count; row++) {
        if (sleep->asleep[row] == SCREE_WAKES) sleep->resting[row] = (scree_resting){0};
        if (sleep->asleep[row] == SCREE_FALLS) {
            sleep->counted[row] =
                (scree_counted){.contacts = state->sum[row].contacts, .resting = sleep->resting[row].contacts};
            state->sum[row] = (scree_sum_row){0};
            if (state->torque) state->torque[row] = (scree_torque_row){0};
        }
        if (sleep->asleep[row] > SCREE_ASLEEP) {
            sleep->quiet[row] = 0;
            memset(sleep->push[row], 0, sizeof sleep->push[row]);
        }
        sleep->asleep[row] = scree_will_sleep(sleep->asleep[row]);
    }
    sleep->changes++;
    scree_sleep_list_moving(state);
}

static void change(const scree_context *c)
{
    scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    if (!(sleep->force_unit > 0)) {
        sleep->force_unit = ldexp(state->force_quantum, 8);
        sleep->torque_unit = ldexp(state->torque_quantum, 8);
        sleep->wall_torque_unit = ldexp(contact_surface_torque_quantum(c->model, state, c->work->wall_set), 8);
    }
    sleep->overlap = fmax(sleep->overlap, state->largest_overlap);
    begin_change(c);
    contact_move_resting(c->model, state, c->work);
    end_change(state);
}

// ---- the passes ---------------------------------------------------------------------------------------------------

static scree_status list(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    scree_status status = SCREE_OK;
    if (sleep->asleep && !sleep->moving) {
        status = make_room(state, error);
        if (!status) scree_sleep_list(state);
    }
    if (!status && sleep->asleep && (!sleep->listed || sleep->bodies != state->changes))
        status = scree_neighbours_refresh(c->model, state, c->work, error);
    return status;
}

/// Whether none may sleep in this step, or those that do have slept for long, or fell asleep under another gravity, or
/// beside walls that then stood or moved and now do not.
static bool all_wake(const scree_context *c)
{
    const scree_sleep_limits limits = limits_of(c->model, c->state);
    const scree_sleep *sleep = scree_sleep_of(c->state);
    return !may_sleep(c, &limits) || scree_state_time(c->state) - sleep->woken >= limits.interval ||
           memcmp(sleep->gravity, c->model->gravity, sizeof sleep->gravity) != 0 ||
           sleep->walls != scree_case_walls_that_move(c->model, c->state);
}

static scree_status all_will_wake(const scree_context *c, bool *wanted, scree_error *error)
{
    (void)error;
    *wanted = scree_sleep_of(c->state)->total > 0 && all_wake(c);
    return SCREE_OK;
}

static scree_status wake(const scree_context *c, scree_error *error)
{
    const scree_sleep_limits limits = limits_of(c->model, c->state);
    scree_sleep *sleep = scree_sleep_of(c->state);
    (void)error;
    if (!all_wake(c)) return SCREE_OK;
    scree_sleep_wake_all(c);
    if (!may_sleep(c, &limits)) return SCREE_OK;
    memcpy(sleep->gravity, c->model->gravity, sizeof sleep->gravity);
    sleep->walls = scree_case_walls_that_move(c->model, c->state);
    return SCREE_OK;
}

static scree_status decide(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    scree_sleep *sleep = scree_sleep_of(state);
    const scree_sleep_limits limits = limits_of(c->model, state);
    sleep->found = 0;
    if (!may_sleep(c, &limits)) return SCREE_OK;
    scree_status status = make_room(state, error);
    if (status) return status;
    const bool look = state->evaluations % LOOK_EVERY == 0;
    const bool held = scree_state_time(state) - sleep->woken < SCREE_SLEEP_HOLD * limits.window;
    int64_t found = (int64_t)mark_waking(c, &limits);
    if (look) found += (int64_t)mark_left(c, &limits);
    if (look && !held) found += (int64_t)mark_falling(c, &limits);
    // In the other steps nobody finds any.
    if (state->evaluations % WAKE_EVERY == 0) scree_comm_add(state, &found, 1);
    sleep->awake_steps += scree_state_total(state) - sleep->total;
    sleep->steps++;
    sleep->found = (uint64_t)found;
    return SCREE_OK;
}

/// Pairs that are moved have both bodies here then.
static scree_status some_are_found(const scree_context *c, bool *wanted, scree_error *error)
{
    (void)error;
    *wanted = scree_sleep_of(c->state)->found > 0;
    return SCREE_OK;
}

static scree_status change_found(const scree_context *c, scree_error *error)
{
    (void)error;
    if (scree_sleep_of(c->state)->found > 0) change(c);
    return SCREE_OK;
}

// ---- the module ---------------------------------------------------------------------------------------------------

static bool in_use(const scree_context *c)
{
    return scree_sleep_of(c->state)->asleep || !isnan(limits_of(c->model, c->state).window);
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_sleep_wake_all(c);
    return SCREE_OK;
}

static double work(const scree_state *state)
{
    return -scree_sleep_of(state)->taken;
}

/// By id: whether it sleeps, since when it is quiet.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    (void)model;
    size_t id = 0;
    for (uint32_t row; sleep->asleep && (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;)
        c = scree_checksum_word(c, 2 * (uint64_t)sleep->quiet[row] + sleep->asleep[row]);
    return c;
}

static scree_status derive(scree_state *state, scree_error *error)
{
    scree_sleep *sleep = scree_sleep_of(state);
    (void)error;
    scree_sleep_list_moving(state);
    sleep->pushed_count = SCREE_SLEEP_ALL;
    if (!sleep->asleep) return SCREE_OK;
    int64_t all = (int64_t)sleep->count;
    scree_comm_add(state, &all, 1);
    sleep->total = (uint64_t)all;
    return SCREE_OK;
}

/// What rests on others is handed back to them, with whom they have contacts.
static bool begins_whole(const scree_context *c)
{
    return scree_sleep_of(c->state)->asleep != NULL;
}

static const scree_result columns[] = {{"awake", "1", "particles that do not sleep"}};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    int64_t awake = (int64_t)(c->state->count - scree_sleep_of(c->state)->count);
    (void)index, (void)error;
    scree_comm_add(c->state, &awake, 1);
    value[0] = (double)awake;
    return SCREE_OK;
}

static const scree_result results[] = {
    {"mean_awake", "1", "mean number of particles that were awake while some might sleep"},
    {"sleep_taken", "J", "kinetic energy of particles when they fell asleep, less that of those that woke"},
};

static scree_status tell(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_sleep *sleep = scree_sleep_of(c->state);
    (void)index, (void)error;
    value[0] = (double)sleep->awake_steps / (double)sleep->steps;
    value[1] = sleep->taken;
    return SCREE_OK;
}

typedef scree_sleep own;
#define BODY(array, element, name, type, components, unit, meaning, ...)                                               \
    SCREE_FIELD_BODY(sleep, own, array, element, name, type, components, unit, meaning, .optional = true, __VA_ARGS__)
#define ONE(member, type, components, unit, meaning, ...)                                                              \
    SCREE_FIELD_ONE(sleep, own, member, "sleep/" #member, type, components, unit, meaning, __VA_ARGS__)
#define DERIVED(member, meaning) ONE(member, SCREE_FIELD_UINT64, 1, "1", meaning, .role = SCREE_FIELD_DERIVED)
#define WALL(member, meaning)                                                                                          \
    SCREE_FIELD_FIXED(sleep, own, wall, SCREE_SURFACES, scree_resting_load, member, "sleep/wall_" #member,             \
                      SCREE_FIELD_INT64, 3, "1", meaning, SCREE_RANGE(-0x1p62, 0x1p62))
static const scree_field fields[] = {
    WALL(force, "of all that sleep on each wall of the case that stands, in units of sleep/force_unit"),
    WALL(torque, "the same about its centre, in units of sleep/wall_torque_unit"),
    BODY(asleep, uint8_t, "asleep", SCREE_FIELD_UINT8, 1, "1", "1: the body sleeps", .snapshot = true,
         .ghosts = SCREE_GHOSTS_KEEP, SCREE_RANGE(0, 1)),
    BODY(quiet, uint32_t, "quiet", SCREE_FIELD_UINT32, 1, "1", "steps for which it has been quiet"),
    BODY(resting, scree_resting, "resting", SCREE_FIELD_INT64, 7, "1",
         "of a body that sleeps, from others that do and walls that stand: force in units of sleep/force_unit, torque "
         "in units of "
         "sleep/torque_unit, number of contacts",
         SCREE_RANGE(-0x1p62, 0x1p62)),
    BODY(push, double[6], "push", SCREE_FIELD_DOUBLE, 6, "1",
         "of a body that sleeps, mean of its resultants: force over weight, torque over weight and radius"),
    BODY(counted, scree_counted, "counted", SCREE_FIELD_INT64, 2, "1",
         "contacts that a body that sleeps had at the last look, and those among them with others that sleep",
         SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    BODY(moving, uint32_t, "moving", SCREE_FIELD_UINT32, 1, "1", "rows that are awake", .role = SCREE_FIELD_DERIVED),
    BODY(pushed, uint32_t, "pushed", SCREE_FIELD_UINT32, 1, "1", "rows that sleep and are pushed",
         .role = SCREE_FIELD_DERIVED),
    ONE(force_unit, SCREE_FIELD_DOUBLE, 1, "N", "unit of what rests", SCREE_RANGE(0, DBL_MAX)),
    ONE(torque_unit, SCREE_FIELD_DOUBLE, 1, "N m", "unit of its torques", SCREE_RANGE(0, DBL_MAX)),
    ONE(wall_torque_unit, SCREE_FIELD_DOUBLE, 1, "N m", "unit of the torques on walls", SCREE_RANGE(0, DBL_MAX)),
    ONE(gravity, SCREE_FIELD_DOUBLE, 3, "m/s2", "gravity of the last step in which bodies might sleep"),
    ONE(walls, SCREE_FIELD_UINT64, 1, "1", "a bit for each wall of the case that moved in that step"),
    ONE(woken, SCREE_FIELD_DOUBLE, 1, "s", "time at which all woke", SCREE_RANGE(0, DBL_MAX)),
    ONE(overlap, SCREE_FIELD_DOUBLE, 1, "m", "bound of the overlaps of those that sleep", SCREE_RANGE(0, DBL_MAX)),
    ONE(taken, SCREE_FIELD_DOUBLE, 1, "J",
        "kinetic energy of bodies when they fell asleep, less that of those that woke"),
    ONE(awake_steps, SCREE_FIELD_UINT64, 1, "1", "steps of all bodies that were awake, since some might sleep"),
    ONE(steps, SCREE_FIELD_UINT64, 1, "1", "steps since then"),
    DERIVED(count, "bodies that sleep"),
    DERIVED(total, "the same of all processes"),
    DERIVED(changes, "times that some fell asleep or woke"),
    DERIVED(moving_count, "rows that are awake"),
    DERIVED(pushed_count, "rows that sleep and are pushed"),
    DERIVED(listed, "1: they are listed"),
    DERIVED(bodies, "changes of the bodies, then"),
    DERIVED(found, "bodies that fall asleep or wake in this step"),
};

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = list},
                                    {SCREE_PHASE_DECIDE, .run = wake, .whole = all_will_wake},
                                    {SCREE_PHASE_DECIDE, .run = decide},
                                    {SCREE_PHASE_DECIDE, .run = change_found, .whole = some_are_found}};

static bool told(const scree_config *config, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && scree_some_may_sleep(config->stages, config->stage_count);
}

const scree_module scree_module_sleep = {
    .name = "sleep",
    .meaning = "bodies that are quiet are left out of the steps",
    .state_size = sizeof(scree_sleep),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
    .begin = begin,
    .begins_whole = begins_whole,
    .derive = derive,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .work = work,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, tell),
    .told = told,
};
