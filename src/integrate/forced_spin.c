/// Prescribed spin. The torques of the contacts at n are taken out of the sum of the body and kept, so that the
/// integrator turns it by nothing but what is prescribed, w(n+1/2). The torque that this needs does on the contacts the
/// work
///     - 1/2 (T(n) + T(n+1)) . w(n+1/2) dt
/// by the trapezoidal rule of all forces (measure/energy.c). The rotation of the body itself is part of what is
/// prescribed: its energy is not in the balance while it is forced. Cost: none without such a body.
#include "integrate/forced_spin.h"

#include "base/fixed.h"
#include "comm/parts.h"
#include "state/body.h"

static double rotation_energy(const scree_state *state, size_t row)
{
    scree_vector velocity, spin;
    scree_body_motion(state, row, velocity, spin);
    return 0.5 * scree_body_inertia(state, row) * (spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2]);
}

void scree_forced_spin_begin(scree_state *state, uint32_t id)
{
    scree_forced_spin_end(state);
    state->ledger.forced -= rotation_energy(state, state->row_of_id[id]);
    *scree_forced(state) = (scree_forced_spin){.active = 1, .id = id};
    scree_forced_spin_settle(state);
}

void scree_forced_spin_end(scree_state *state)
{
    if (!scree_forced(state)->active) return;
    state->ledger.forced += rotation_energy(state, state->row_of_id[scree_forced(state)->id]);
    *scree_forced(state) = (scree_forced_spin){0};
}

void scree_forced_spin_set(scree_state *state, const scree_vector spin)
{
    const uint32_t row = scree_state_row_of(state, (size_t)scree_forced(state)->id);
    for (int i = 0; i < 3; i++) scree_forced(state)->spin[i] = spin[i];
    if (row == SCREE_NO_ROW) return;
    if (state->dimension == 2) {
        state->row[row].spin = spin[2];
        return;
    }
    state->turn[row].wx = spin[0];
    state->turn[row].wy = spin[1];
    state->turn[row].wz = spin[2];
}

/// Moves a sum of torques into *torque [N m].
static double take(int64_t *sum, double quantum)
{
    double torque = scree_fixed_to(*sum, quantum);
    *sum = 0;
    return torque;
}

/// Moves the torque of the contacts out of the sums of a body.
static void take_torque(scree_state *state, uint32_t row, scree_vector torque)
{
    if (state->dimension == 2) {
        torque[2] = take(&state->sum[row].torque, state->torque_quantum);
        return;
    }
    torque[0] = take(&state->torque[row].x, state->torque_quantum);
    torque[1] = take(&state->torque[row].y, state->torque_quantum);
    torque[2] = take(&state->torque[row].z, state->torque_quantum);
}

void scree_forced_spin_settle(scree_state *state)
{
    scree_forced_spin *forced = scree_forced(state);
    if (!forced->active) return;
    const uint32_t id = (uint32_t)forced->id, row = scree_state_row_of(state, id);
    scree_vector torque = {0};
    if (row != SCREE_NO_ROW) take_torque(state, row, torque);
    scree_parts_tell(state, &id, 1, torque, 3);
    double work = 0;
    for (int i = 0; i < 3; i++) {
        work -= 0.5 * (torque[i] + forced->torque[i]) * forced->spin[i] * state->step_size;
        forced->torque[i] = torque[i];
    }
    state->ledger.forced += work;
    state->ledger.turnover += fabs(work);
}

typedef scree_forced_spin own;

#define ONE(member, type, components, unit, meaning, ...)                                                              \
    SCREE_FIELD_ONE(forced_spin, own, member, "forced/" #member, type, components, unit, meaning, __VA_ARGS__)
static const scree_field fields[] = {
    ONE(id, SCREE_FIELD_INT64, 1, "1", "body whose spin is prescribed"),
    ONE(active, SCREE_FIELD_INT64, 1, "1", "0: there is none", SCREE_RANGE(0, 1)),
    ONE(spin, SCREE_FIELD_DOUBLE, 3, "rad/s", "its spin"),
    ONE(torque, SCREE_FIELD_DOUBLE, 3, "N m", "torque of its contacts on it"),
};

/// While there is one, it is a body that is here.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    (void)model;
    const scree_forced_spin *forced = scree_forced(state);
    if (!forced->active ||
        (forced->id >= 0 && (state->part || scree_state_row_of(state, (size_t)forced->id) != SCREE_NO_ROW)))
        return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "dataset 'forced/id': %lld (accepted: the id of a body that is here)",
                           (long long)forced->id);
}

/// A body that is taken out turns as it does.
static void forget(scree_state *state, uint32_t id)
{
    if (scree_forced(state)->id == id) scree_forced_spin_end(state);
}

static bool in_use(const scree_context *c)
{
    return scree_forced(c->state)->active != 0;
}

static bool turns(const scree_state *state, size_t row)
{
    return scree_forced(state)->active && scree_forced(state)->id == state->id[row];
}

static scree_status settle(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_forced_spin_settle(c->state);
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_LOADS, .run = settle}};

/// Where it ends its row is looked for among all.
static bool begins_whole(const scree_context *c)
{
    return scree_forced(c->state)->active != 0;
}

const scree_module scree_module_forced_spin = {
    .name = "forced_spin",
    .meaning = "a body whose spin is prescribed",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .forget = forget,
    .passes = passes,
    .pass_count = 1,
    .in_use = in_use,
    .begins_whole = begins_whole,
    .turns = turns,
    .spreads = true,
};
