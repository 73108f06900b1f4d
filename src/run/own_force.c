/// Own forces: what functions of the program that uses the library put on bodies.
///
/// Method. The functions are called in the phase of the loads, behind contacts and pressure and before whatever looks
/// at the whole sum. What they give is rounded to the quanta of the step (base/fixed.h), whose size follows from the
/// declared bounds too, and added up for each body as integers, so neither the order of the functions nor that of their
/// calls shows. The sums are state: half of their work over the next step is still to come.
///
/// Work. Trapezoidal as for all forces (measure/energy.c): half with the velocity that brought the bodies here, half
/// with the one that the next kick makes. The second half is taken right behind the kick, before a periodic cell that
/// deforms puts its affine field into the rows; velocities are relative to it in both halves.
///
/// Limits. A force that depends on velocities sees those of the middle of the step. At the first step of a run there is
/// no force from before, as with all loads. Cost: the functions', 48 bytes a body and one pass over the bodies twice.
#include "run/own_force.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/wrapping.h"
#include "comm/comm.h"
#include "state/fields.h"

#include <stdlib.h>

typedef scree_own_loads own;

/// Sums stay below it, so that forces of contacts fit on top.
#define MOST (INT64_C(1) << 60)

struct scree_loads {
    scree_state *state;
    scree_work *work;
    const scree_own_force *force; ///< whose function is called
    scree_status status;
    scree_error *error;
};

static const scree_group group = {
    .row = "body", .symbol = "n", .count_offset = offsetof(own, count), .capacity_offset = offsetof(own, capacity)};

static const scree_field fields[] = {
    SCREE_FIELD_ONE(own_force, own, registered, "own_force/registered", SCREE_FIELD_INT64, 1, "1",
                    "number of functions of a program that add forces", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    SCREE_FIELD_GROUP(own_force, own, group, force, int64_t[3], "own_force/force", SCREE_FIELD_INT64, 3, "1",
                      "their forces on each body, by id, in units of scalars/force_quantum",
                      SCREE_RANGE(-0x1p61, 0x1p61)),
    SCREE_FIELD_GROUP(own_force, own, group, torque, int64_t[3], "own_force/torque", SCREE_FIELD_INT64, 3, "1",
                      "their torques on each body, by id, in units of scalars/torque_quantum",
                      SCREE_RANGE(-0x1p61, 0x1p61)),
};

void scree_own_force_list_destroy(scree_own_force_list *list)
{
    for (size_t k = 0; k < list->count; k++) free((char *)(uintptr_t)list->force[k].name);
    scree_release(&list->force);
    list->count = list->capacity = 0;
}

// ---- the sums ----------------------------------------------------------------------------------------------------

static void stop(scree_loads *loads, uint32_t id, const char *what, double value, double bound)
{
    if (loads->status) return;
    loads->work->flags |= SCREE_FLAG_FORCE_RANGE;
    loads->work->flagged_id = id;
    loads->status = scree_error_set(
        loads->error, SCREE_ERROR_GUARD,
        "step %llu: own force '%s' puts a %s of %.4g on particle %u; the bound that it declared is %.4g",
        (unsigned long long)loads->state->step, loads->force->name, what, value, id, bound);
}

/// Adds a vector to the sum of a body. Errors: longer than its bound, or too many of them.
static void add(scree_loads *loads, uint32_t id, const char *what, const double value[3], double bound, double quantum,
                int64_t sum[3])
{
    double length = scree_length(value);
    if (!(length <= bound)) {
        stop(loads, id, what, length, bound);
        return;
    }
    for (int k = 0; k < 3; k++) sum[k] += scree_fixed_from(value[k], 1 / quantum);
    for (int k = 0; k < 3; k++)
        if (sum[k] > MOST || sum[k] < -MOST) stop(loads, id, what, scree_fixed_to(sum[k], quantum), bound);
}

void scree_loads_add(scree_loads *loads, uint32_t id, const double force[3], const double torque[3])
{
    own *sums = scree_own_loads_of(loads->state);
    if (loads->status) return;
    if (id >= sums->count || scree_state_row_of(loads->state, id) == SCREE_NO_ROW) {
        loads->status = scree_error_set(loads->error, SCREE_ERROR_INPUT, "own force '%s': there is no body %u",
                                        loads->force->name, id);
        return;
    }
    if (force)
        add(loads, id, "force", force, loads->force->largest_force, loads->state->force_quantum, sums->force[id]);
    if (torque)
        add(loads, id, "torque", torque, loads->force->largest_torque, loads->state->torque_quantum, sums->torque[id]);
}

void scree_loads_add_many(scree_loads *loads, size_t count, const uint32_t *id, const double *force,
                          const double *torque)
{
    for (size_t k = 0; k < count; k++)
        scree_loads_add(loads, id[k], force ? &force[3 * k] : NULL, torque ? &torque[3 * k] : NULL);
}

/// Calls the functions; their forces are in the sums of the module.
static scree_status call(const scree_context *c, scree_error *error)
{
    scree_own_force_list *list = &c->simulation->forces;
    scree_loads loads = {.state = c->state, .work = c->work, .error = error};
    for (size_t k = 0; k < list->count && !loads.status; k++) {
        loads.force = &list->force[k];
        list->called = true;
        int answer = loads.force->function(loads.force->user, c->simulation, &loads);
        list->called = false;
        if (answer != 0 && !loads.status)
            loads.status = scree_error_set(error, SCREE_ERROR_INPUT, "step %llu: own force '%s' has failed (%d)",
                                           (unsigned long long)c->state->step, loads.force->name, answer);
    }
    return loads.status;
}

/// On top of the sums of contacts and other loads.
static void add_to_bodies(scree_state *state)
{
    const own *sums = scree_own_loads_of(state);
    for (size_t row = 0; row < state->count; row++) {
        const int64_t *force = sums->force[state->id[row]], *torque = sums->torque[state->id[row]];
        scree_sum_row *sum = &state->sum[row];
        scree_wrapping_add(&sum->fx, force[0]);
        scree_wrapping_add(&sum->fy, force[1]);
        if (state->dimension == 2) {
            scree_wrapping_add(&sum->torque, torque[2]);
            continue;
        }
        scree_wrapping_add(&sum->fz, force[2]);
        scree_wrapping_add(&state->torque[row].x, torque[0]);
        scree_wrapping_add(&state->torque[row].y, torque[1]);
        scree_wrapping_add(&state->torque[row].z, torque[2]);
    }
}

/// 1/2 (F . v + T . w) dt with what the rows hold now.
static void take_half_work(scree_state *state)
{
    const own *sums = scree_own_loads_of(state);
    const size_t planar = state->dimension == 2 ? 2 : 3;
    scree_integer_sum power = {0};
    while (scree_comm_sum_next(state, &power, 1))
        for (size_t row = 0; row < state->count; row++) {
            // A body that has been added since had none.
            if (state->id[row] >= sums->count) continue;
            const int64_t *force = sums->force[state->id[row]], *torque = sums->torque[state->id[row]];
            scree_vector velocity, spin;
            scree_body_motion(state, row, velocity, spin);
            double sum = 0;
            for (size_t k = 0; k < planar; k++) sum += scree_fixed_to(force[k], state->force_quantum) * velocity[k];
            for (size_t k = 0; k < 3; k++) sum += scree_fixed_to(torque[k], state->torque_quantum) * spin[k];
            scree_integer_sum_add(&power, sum);
        }
    double work = 0.5 * state->step_size * scree_integer_sum_total(&power);
    state->ledger.outside += work;
    state->ledger.turnover += fabs(work);
}

// ---- the module --------------------------------------------------------------------------------------------------

static bool in_use(const scree_context *c)
{
    return (c->simulation && c->simulation->forces.count > 0) || scree_own_loads_of(c->state)->count > 0;
}

static scree_status kicked(const scree_context *c, scree_error *error)
{
    (void)error;
    if (scree_own_loads_of(c->state)->count > 0) take_half_work(c->state);
    return SCREE_OK;
}

static scree_status load(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    own *sums = scree_own_loads_of(state);
    sums->registered = (int64_t)c->simulation->forces.count;
    sums->count = 0;
    if (sums->registered == 0) return SCREE_OK;
    scree_status status = scree_group_reserve(state, &scree_module_own_force, &group, state->id_count, error);
    if (status) return status;
    sums->count = state->id_count;
    memset(sums->force, 0, sums->count * sizeof *sums->force);
    memset(sums->torque, 0, sums->count * sizeof *sums->torque);
    if ((status = call(c, error))) return status;
    add_to_bodies(state);
    take_half_work(state);
    return SCREE_OK;
}

/// Torques are counted in quanta of the largest radius times those of forces (contact/bounds.c).
static double bound(const scree_context *c)
{
    double largest = 0;
    for (size_t k = 0; c->simulation && k < c->simulation->forces.count; k++) {
        const scree_own_force *force = &c->simulation->forces.force[k];
        largest = fmax(largest, force->largest_force);
        largest = fmax(largest, force->largest_torque / scree_model_largest_radius(c->model));
    }
    return largest;
}

static const scree_pass passes[] = {{SCREE_PHASE_FIRST_HALF, .run = kicked}, {SCREE_PHASE_LOADS, .run = load}};

const scree_module scree_module_own_force = {
    .name = "own_force",
    .meaning = "forces of a program that uses the library",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .bound = bound,
};
