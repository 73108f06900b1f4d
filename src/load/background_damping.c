/// Background damping: a force against the velocity of a body, as large as a share of the resultant of all other forces
/// on it, weight included, and a torque likewise (Madan 2019, eqs. 2.7 and 2.8; Cundall 1987). It does not depend on
/// the speed, so it damps fast and slow motions alike and vanishes in equilibrium. For static solutions, not for flow:
/// a body that falls freely is held back as well.
///     vector:      F_d = - a |F| v / |v|                    (2.7; frame-indifferent)
///     components:  F_d,i = - a |F_i| sign(v_i)              (Cundall's; damps each component by itself)
/// v is v(n - 1/2), as rows hold it: the force is explicit, and dissipates for a < 1 whenever |v| exceeds what the step
/// changes; near rest it may turn about within a step, by no more than a share of the kick itself.
///
/// Work. F_d(n) does 1/2 F_d . v(n-1/2) h(n) in the step before, which is accumulated at once, and 1/2 F_d . v(n+1/2)
/// h(n+1) in the one after, which is known, too, since nothing is added behind this phase: it waits until the next step
/// has begun. Work is a sum in integers (base/fixed.h). Cost: one pass over the bodies, some 5 ns each. Limit: no stage
/// with a boundary that imposes velocities, which would be braked as well.
#include "base/checksum.h"
#include "base/fixed.h"
#include "base/wrapping.h"
#include "case/check.h"
#include "comm/guessed_sum.h"
#include "load/load.h"
#include "module/key_rows.h"

#include <math.h>

typedef enum damped { DAMPED_VECTOR, DAMPED_COMPONENTS } damped;

typedef struct config {
    double translation; ///< 1, share of the resultant force
    double rotation;    ///< 1, of the resultant torque
    int direction;      ///< damped
    char *from, *until; ///< names of the first and the last stage in which it acts; NULL: of the case
} config;

/// State of the module.
typedef struct damping {
    double work;       ///< J, on the bodies
    double pending;    ///< J, of the forces at n in the half step that comes
    double largest[2]; ///< W, magnitudes of the powers that were summed last: what the next ones are guessed from
} damping;

static damping *own_state(const scree_state *state)
{
    return state->own[SCREE_SLOT_background_damping];
}

static const config *first_config(const scree_model *model)
{
    return scree_load_next(model, &scree_module_background_damping, NULL);
}

/// The damping of a force (or torque) with the velocity (or spin) v, in quanta that are added to its sums.
static void oppose(const config *c, double share, const double force[3], const double v[3], double quantum,
                   int64_t quanta[3])
{
    double speed = scree_length(v), size = scree_length(force);
    for (int i = 0; i < 3; i++) {
        double against = c->direction == DAMPED_COMPONENTS ? fabs(force[i]) * ((v[i] > 0) - (v[i] < 0))
                         : speed > 0                       ? size * (v[i] / speed)
                                                           : 0;
        quanta[i] = llrint(-share * against / quantum);
    }
}

/// What a step knows of one body.
typedef struct turn {
    double force[3], torque[3]; ///< N, N m, resultants without the damping
    scree_vector velocity, spin;
    int64_t push[3], twist[3]; ///< quanta of the damping
} turn;

static turn plan_body(const scree_context *c, const config *own, size_t row)
{
    const scree_state *state = c->state;
    const scree_sum_row *sum = &state->sum[row];
    const bool in_3d = state->dimension == 3;
    const int64_t force[3] = {sum->fx, sum->fy, in_3d ? sum->fz : 0};
    turn t = {.torque = {0}};
    scree_body_motion(state, row, t.velocity, t.spin);
    for (int i = 0; i < 3; i++)
        t.force[i] = scree_fixed_to(force[i], state->force_quantum) + state->row[row].mass * c->model->gravity[i];
    if (in_3d) {
        const int64_t torque[3] = {state->torque[row].x, state->torque[row].y, state->torque[row].z};
        for (int i = 0; i < 3; i++) t.torque[i] = scree_fixed_to(torque[i], state->torque_quantum);
    } else {
        t.force[2] = 0;
        t.torque[2] = scree_fixed_to(sum->torque, state->torque_quantum);
    }
    // What is prescribed is not damped: whoever prescribes it would have to push against the damping.
    scree_body_leave_free(state, row, t.force, t.torque);
    scree_body_leave_free(state, row, t.velocity, t.spin);
    oppose(own, own->translation, t.force, t.velocity, state->force_quantum, t.push);
    oppose(own, own->rotation, t.torque, t.spin, state->torque_quantum, t.twist);
    return t;
}

static void apply(scree_state *state, size_t row, const turn *t)
{
    scree_sum_row *sum = &state->sum[row];
    scree_wrapping_add(&sum->fx, t->push[0]);
    scree_wrapping_add(&sum->fy, t->push[1]);
    if (state->dimension == 2) {
        scree_wrapping_add(&sum->torque, t->twist[2]);
        return;
    }
    scree_wrapping_add(&sum->fz, t->push[2]);
    scree_wrapping_add(&state->torque[row].x, t->twist[0]);
    scree_wrapping_add(&state->torque[row].y, t->twist[1]);
    scree_wrapping_add(&state->torque[row].z, t->twist[2]);
}

/// Power [W] of the damping at v(n - 1/2) and at v(n + 1/2), to which the next kick leads.
static void add_power(const scree_context *c, size_t row, const turn *t, scree_guessed_sum power[2])
{
    const scree_state *state = c->state;
    double kick = c->work->next_kick, mass = state->row[row].mass, inertia = scree_body_inertia(state, row);
    double before = 0, after = 0;
    for (int i = 0; i < 3; i++) {
        double push = scree_fixed_to(t->push[i], state->force_quantum);
        double twist = scree_fixed_to(t->twist[i], state->torque_quantum);
        before += push * t->velocity[i] + twist * t->spin[i];
        after += push * (t->velocity[i] + kick * (t->force[i] + push) / mass) +
                 twist * (t->spin[i] + kick * (t->torque[i] + twist) / inertia);
    }
    scree_guessed_sum_add(&power[0], before);
    scree_guessed_sum_add(&power[1], after);
}

static void accumulate(scree_state *state, double work)
{
    own_state(state)->work += work;
    state->ledger.turnover += fabs(work);
}

static scree_status follow(const scree_context *c, scree_error *error)
{
    (void)error;
    accumulate(c->state, own_state(c->state)->pending);
    own_state(c->state)->pending = 0;
    return SCREE_OK;
}

/// All powers are known before the forces are applied.
static scree_status damp(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const config *own = first_config(c->model);
    scree_guessed_sum power[2] = {0};
    (void)error;
    if (!scree_load_acts(c->model, state, own->from, own->until)) return SCREE_OK;
    while (scree_guessed_sum_next(state, power, 2, own_state(state)->largest))
        for (size_t row = 0; row < state->count; row++) {
            const turn t = plan_body(c, own, row);
            add_power(c, row, &t, power);
        }
    for (size_t row = 0; row < state->count; row++) {
        const turn t = plan_body(c, own, row);
        apply(state, row, &t);
    }
    double now = state->step_size, next = 2 * c->work->next_kick - now;
    accumulate(state, 0.5 * now * scree_guessed_sum_total(&power[0]));
    own_state(state)->pending = 0.5 * next * scree_guessed_sum_total(&power[1]);
    return SCREE_OK;
}

static bool in_use(const scree_context *c)
{
    return first_config(c->model) != NULL;
}

static double work(const scree_state *state)
{
    return own_state(state)->work;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    return first_config(model) ? scree_checksum_number(c, own_state(state)->work) : c;
}

/// A boundary that imposes velocities finds its forces from the sums before the damping, which then brakes its bodies.
static void check_boundaries(scree_reader *reader, const scree_config *whole, const config *own, const char *path)
{
    int64_t range[2];
    scree_load_stages(whole->stages, whole->stage_count, own->from, own->until, range);
    for (int64_t i = range[0] < 0 ? 0 : range[0]; i <= range[1]; i++) {
        const scree_boundary *boundary = scree_config_held_by(whole, i);
        if (!boundary || !boundary->equal_steps) continue;
        scree_rule_refuse(reader, path, NULL,
                          "the boundary of stages.%lld imposes velocities, which background_damping would brake: give "
                          "the stage plates or a pressure on its sides, or leave the damping out",
                          (long long)i);
        return;
    }
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    int64_t first = -1;
    for (int64_t i = 0; i < whole->load_count; i++) {
        char path[32];
        if (whole->loads[i].kind != SCREE_SLOT_background_damping) continue;
        (void)snprintf(path, sizeof path, "loads.%lld.load", (long long)i);
        if (first >= 0)
            scree_rule_refuse(reader, path, NULL, "loads.%lld damps the same bodies: give one background_damping",
                              (long long)first);
        else
            check_boundaries(reader, whole, whole->loads[i].own, path);
        first = first < 0 ? i : first;
        const config *own = whole->loads[i].own;
        scree_load_check_stages(reader, whole, i, own->from, own->until);
    }
}

static const scree_choice directions[] = {
    {"vector", DAMPED_VECTOR,
     "against the velocity, by a share of the magnitude of the force (Madan 2019, 2.7 and 2.8)"},
    {"components", DAMPED_COMPONENTS, "each component by a share of that of the force (Cundall 1987)"},
    {0},
};
static const scree_key keys[] = {
    NUMBER(config, translation, "1", .standard = "0.2", FROM("0"), BELOW("1"),
           .meaning = "Share of the resultant force on a body that acts against its velocity."),
    NUMBER(config, rotation, "1", .standard = "0.2", FROM("0"), BELOW("1"),
           .meaning = "Share of the resultant torque on it that acts against its spin."),
    CHOICE(config, direction, directions, .standard = "vector", .meaning = "What it acts against."),
    KEY(config, from, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the first stage in which it acts; auto: the first one."),
    KEY(config, until, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the last stage in which it acts; auto: the last one."),
};

static const scree_field fields[] = {
    SCREE_FIELD_ONE(background_damping, damping, work, "background_damping/work", SCREE_FIELD_DOUBLE, 1, "J",
                    "work of the background damping on the bodies"),
    SCREE_FIELD_ONE(background_damping, damping, pending, "background_damping/pending", SCREE_FIELD_DOUBLE, 1, "J",
                    "its work in the first half of the step that comes"),
    SCREE_FIELD_ONE(background_damping, damping, largest, "background_damping/largest", SCREE_FIELD_DOUBLE, 2, "W",
                    "magnitudes of the powers that were summed last", .role = SCREE_FIELD_DERIVED),
};

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = follow}, {SCREE_PHASE_RESULTANTS, .run = damp}};

static const scree_result columns[] = {
    {"work_background_damping", "J", "work of the background damping on the bodies"}};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    *value = own_state(c->state)->work;
    return SCREE_OK;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return scree_load_told(whole, &scree_module_background_damping, index);
}

const scree_module scree_module_background_damping = {
    .name = "background_damping",
    .meaning = "Slows every body by a share of the resultant force and torque on it, whatever its speed (non-viscous).",
    .choice_of = CHOICE_OF(IS("loads")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = rules,
    .state_size = sizeof(damping),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .work = work,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .told = told,
    .spreads = true,
};
