/// Prescribed bodies in a step: driven components move as they are told, forces are applied, and what it takes is
/// measured.
///
/// Motion. With t(n) the time of step n and h(n) the step that follows, a driven component has in it the velocity
///     v(n+1/2) = P(X) V(t(n) + h(n)/2) + f(t(n) + h(n)/2) G (X - o),    x(n+1) = x(n) + h(n) v(n+1/2),
/// V, f schedules, P the profile (profile.c), X the place of the body when it came to be driven: constant and linear
/// schedules are followed without error, others to second order in the step. Behind the first half of every integrator
/// rows hold v(n+1/2) and x(n+1); both are set there, so that no rounding is left. In a periodic cell that deforms
/// velocities are relative to its affine field, as everywhere.
///
/// Reaction. When all other forces F(n) are known, the force R(n) = m (v(n+1/2) - v(n-1/2)) / k - F(n), k the kick to
/// come, is added to the sums: the kick leads to v(n+1/2) but for its rounding, and accelerations, kinetic energies,
/// and forces that are measured are those of a body that moves like this. Torques likewise with J.
///
/// Work. R and applied forces are kept with the half steps before and behind them, as all forces (measure/energy.c).
/// What is left between the velocity u that the kick made with the acceleration a and the prescribed one v, by rounding
/// or where a prescription has just begun, is a shock with the work 1/2 m (v - u)(v + u - h a): T(n) is m/2 (u - h a) u
/// to the step that begins, and the work of F(n) in it is counted with v.
///
/// Until a force. Where a load has one, the force of all others (gravity, too) against the velocity of its bodies is
/// summed with R(n); at the first step at which it reaches that of the load the velocity ends: from the next step on
/// the bodies are free in its direction, and the force of the load acts on them.
///
/// Forces are sums in integers, work is a sum in integers: neither the order of rows nor that of loads shows. Cost: two
/// passes over 16 bytes a body, which list the bodies concerned, and some 50 ns for each of these.
#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/vectors.h"
#include "base/wrapping.h"
#include "comm/comm.h"
#include "integrate/integrate.h"
#include "load/prescribed.h"
#include "search/moved.h"
#include "state/deformation.h"

#include <string.h>

/// What a load says at one time.
typedef struct order {
    const scree_prescribed_config *own; ///< NULL: it does not act
    double motion[SCREE_COMPONENTS];    ///< m/s, rad/s, without the linear part; NAN: free
    double factor;
    double push[SCREE_COMPONENTS]; ///< N, N m, on each body; 0 where it says nothing
} order;

/// Beyond this sums would leave the integers; the bound of the step sees to it that nothing comes near.
#define MOST (INT64_C(1) << 60)

static int64_t *sum_of(scree_state *state, size_t row, int component)
{
    scree_sum_row *sum = &state->sum[row];
    switch (component) {
    case 0:
        return &sum->fx;
    case 1:
        return &sum->fy;
    case 2:
        return &sum->fz;
    case 3:
        return &state->torque[row].x;
    case 4:
        return &state->torque[row].y;
    default:
        return state->dimension == 3 ? &state->torque[row].z : &sum->torque;
    }
}

static double *velocity_of(scree_state *state, size_t row, int component)
{
    scree_row *body = &state->row[row];
    switch (component) {
    case 0:
        return &body->vx;
    case 1:
        return &body->vy;
    case 2:
        return &body->vz;
    case 3:
        return &state->turn[row].wx;
    case 4:
        return &state->turn[row].wy;
    default:
        return state->dimension == 3 ? &state->turn[row].wz : &body->spin;
    }
}

/// m, or J.
static double inertia_of(const scree_state *state, size_t row, int component)
{
    return component < 3 ? scree_body_mass(state, row) : scree_body_inertia(state, row);
}

static double quantum_of(const scree_state *state, int component)
{
    return component < 3 ? state->force_quantum : state->torque_quantum;
}

static bool is_free(const scree_owners owner)
{
    static const scree_owners none = {0};
    return memcmp(owner, none, sizeof none) == 0;
}

static bool drives(const scree_state *state, size_t row, int component)
{
    return state->held[row] >> component & 1;
}

/// Lists the rows that the passes go through: bodies may have been sorted since.
static void list_rows(scree_state *state)
{
    scree_prescribed *all = scree_prescribed_of(state);
    all->listed = 0;
    for (size_t row = 0; row < state->count; row++)
        if (!is_free(all->owner[row]) || !is_free(all->by[row])) all->row[all->listed++] = (uint32_t)row;
}

// ---- what is said now --------------------------------------------------------------------------------------------

/// Bodies of each load that shares its forces among them.
static void count_bodies(const scree_state *state, int64_t count[SCREE_LOADS])
{
    const scree_prescribed *all = scree_prescribed_of(state);
    memset(count, 0, SCREE_LOADS * sizeof *count);
    for (uint64_t k = 0; k < all->listed; k++) {
        const uint32_t row = all->row[k];
        bool counted[SCREE_LOADS + 1] = {true};
        for (int d = 0; d <= SCREE_COMPONENTS; d++) {
            int load = all->owner[row][d];
            if (!counted[load]) count[load - 1]++;
            counted[load] = true;
        }
    }
    scree_comm_add(state, count, SCREE_LOADS);
}

/// Forces at the present time, velocities at `middle` [s].
static void read_orders(const scree_context *c, double middle, order list[SCREE_LOADS])
{
    const scree_prescribed *all = scree_prescribed_of(c->state);
    int64_t bodies[SCREE_LOADS];
    bool counted = false;
    double now = scree_state_time(c->state);
    for (int64_t k = 0; k < SCREE_LOADS; k++) {
        list[k] = (order){0};
        if (k >= c->model->load_count || !all->acts[k]) continue;
        const scree_prescribed_config *own = list[k].own = scree_prescribed_config_of(c->model->loads, k);
        const bool shared = own->per == SCREE_PER_SELECTION || own->until_force > 0;
        if (shared && !counted) count_bodies(c->state, bodies);
        counted = counted || shared;
        double share = own->per == SCREE_PER_SELECTION ? 1 / fmax(1, (double)bodies[k]) : 1;
        list[k].factor = scree_schedule_at(&own->factor, middle - all->begun[k]);
        for (int d = 0; d < SCREE_COMPONENTS; d++) {
            double motion = scree_schedule_at(&own->motion[d], middle - all->begun[k]);
            double push = scree_schedule_at(&own->push[d], now - all->begun[k]);
            list[k].motion[d] = isnan(motion) ? 0 : motion;
            list[k].push[d] = isnan(push) ? 0 : share * push;
            if (d < 3 && all->given[k][d] != 0) list[k].push[d] = all->given[k][d] / fmax(1, (double)bodies[k]);
        }
    }
}

/// The middle of the step that comes, when the present one has been taken.
static double next_middle(const scree_context *c)
{
    return scree_state_time(c->state) + c->work->next_kick - 0.5 * c->state->step_size;
}

/// Velocity of a driven component.
static double wanted(const scree_state *state, size_t row, int component, const order *said)
{
    const scree_prescribed *all = scree_prescribed_of(state);
    double linear = 0;
    for (int j = 0; j < state->dimension && component < 3; j++) {
        double gradient = said->own->gradient[3 * component + j];
        if (!isnan(gradient)) linear += gradient * (all->reference[row][j] - said->own->origin[j]);
    }
    double motion = said->motion[component];
    if (motion != 0 && !scree_load_profile_is_uniform(&said->own->profile))
        motion *= scree_load_profile_at(&said->own->profile, all->reference[row], said->own->origin);
    return motion + (linear != 0 ? said->factor * linear : 0);
}

// ---- work --------------------------------------------------------------------------------------------------------

/// Adds the totals of the loads to their work.
static void keep_work(scree_state *state, const scree_integer_sum sum[SCREE_LOADS], double factor)
{
    scree_prescribed *all = scree_prescribed_of(state);
    for (int k = 0; k < SCREE_LOADS; k++) {
        double work = factor * scree_integer_sum_total(&sum[k]);
        all->work[k] += work;
        state->ledger.turnover += fabs(work);
    }
}

/// From the centre to where a force on the surface acts [m]; without a direction the force points at the centre.
static void find_arm(const scree_state *state, size_t row, const order *said, double arm[3])
{
    const double *direction = said->own->direction, length = scree_length(direction), *push = said->push;
    const double radius = scree_body_bounding_radius(state, row), size = scree_length(push);
    for (int k = 0; k < 3; k++)
        arm[k] = length > 0 ? radius * direction[k] / length : size > 0 ? -radius * push[k] / size : 0;
}

/// Work [J] of a force on the surface of a body as its strain changes from step to step.
static double surface_work(const scree_state *state, size_t row)
{
    const double *stretch = scree_stretch_row(state, row), *spread = scree_prescribed_of(state)->exerted[row].spread;
    static const int plane[] = {0, 1, -1, -1, -1, 2}, space[] = {0, 1, 2, 4, 5, 6};
    const int *place = state->dimension == 3 ? space : plane;
    const size_t change = scree_stretch_size(state->dimension) / 2;
    double work = 0;
    for (int k = 0; k < 6 && stretch; k++)
        if (place[k] >= 0) work += (k < 3 ? 1 : 2) * spread[k] * stretch[change + (size_t)place[k]];
    return work / scree_body_bounding_radius(state, row);
}

/// Power of what is exerted on a body [W], with the velocities that the rows hold.
static void add_power(scree_state *state, size_t row, scree_integer_sum power[SCREE_LOADS])
{
    const scree_prescribed *all = scree_prescribed_of(state);
    const scree_exerted *exerted = &all->exerted[row];
    const int lever = all->by[row][SCREE_LEVER];
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        if (!scree_component_exists(state->dimension, d)) continue;
        double velocity = *velocity_of(state, row, d), quantum = quantum_of(state, d);
        int load = all->by[row][d];
        if (load) scree_integer_sum_add(&power[load - 1], scree_fixed_to(exerted->quanta[d], quantum) * velocity);
        if (lever && d >= 3)
            scree_integer_sum_add(&power[lever - 1], scree_fixed_to(exerted->lever[d - 3], quantum) * velocity);
    }
}

/// Half of the work over what the strains of a step do to surfaces: with the forces at its begin when the change is
/// known, before they are renewed, and with those at its end.
static void take_half_surface_work(scree_state *state)
{
    const scree_prescribed *all = scree_prescribed_of(state);
    scree_integer_sum sum[SCREE_LOADS] = {0};
    if (!state->stretch) return;
    while (scree_comm_sum_next(state, sum, SCREE_LOADS))
        for (uint64_t k = 0; k < all->listed; k++) {
            const int lever = all->by[all->row[k]][SCREE_LEVER];
            if (lever) scree_integer_sum_add(&sum[lever - 1], surface_work(state, all->row[k]));
        }
    keep_work(state, sum, 0.5);
}

static void take_half_work(scree_state *state)
{
    const scree_prescribed *all = scree_prescribed_of(state);
    scree_integer_sum power[SCREE_LOADS] = {0};
    while (scree_comm_sum_next(state, power, SCREE_LOADS))
        for (uint64_t k = 0; k < all->listed; k++) add_power(state, all->row[k], power);
    keep_work(state, power, 0.5 * state->step_size);
}

// ---- before and behind the first half ----------------------------------------------------------------------------

/// Velocities that have ended with a force drive their bodies no more.
static void release_ended(scree_state *state, size_t row)
{
    const scree_prescribed *all = scree_prescribed_of(state);
    for (int d = 0; d < 3; d++)
        if (drives(state, row, d) && all->given[all->owner[row][d] - 1][d] != 0)
            state->held[row] &= (uint8_t) ~(1U << d);
}

scree_status scree_prescribed_depart(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const scree_prescribed *all = scree_prescribed_of(state);
    (void)error;
    list_rows(state);
    for (uint64_t listed = 0; listed < all->listed; listed++) {
        const uint32_t row = all->row[listed];
        scree_departure *departure = &all->departure[row];
        scree_vector force, torque;
        if (state->held[row]) release_ended(state, row);
        if (!state->held[row]) continue;
        scree_body_force(c->model, state, row, force, torque);
        scree_body_position(state, row, departure->position);
        if (state->dimension == 2) departure->angle = scree_body_angle(state, row);
        for (int k = 0; k < 3; k++) {
            departure->acceleration[k] = force[k] / scree_body_mass(state, row);
            departure->acceleration[3 + k] = torque[k] / scree_body_inertia(state, row);
        }
    }
    return SCREE_OK;
}

/// Work of the shock between the velocity that the kick has made and the prescribed one, twice.
static void add_shocks(scree_state *state, size_t row, const order *list, scree_integer_sum shock[SCREE_LOADS])
{
    const scree_prescribed *all = scree_prescribed_of(state);
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        if (!drives(state, row, d)) continue;
        int load = all->owner[row][d] - 1;
        double made = *velocity_of(state, row, d), told = wanted(state, row, d, &list[load]);
        double before = made - state->step_size * all->departure[row].acceleration[d];
        scree_integer_sum_add(&shock[load], inertia_of(state, row, d) * (told - made) * (told + before));
    }
}

/// Velocity v(n+1/2) and position n + 1 as they are prescribed; returns |v| + R |w| of the body.
static double move_body(scree_state *state, size_t row, const order *list)
{
    const scree_prescribed *all = scree_prescribed_of(state);
    const scree_departure *from = &all->departure[row];
    double *const position[] = {&state->row[row].x, &state->row[row].y, &state->row[row].z};
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        if (!drives(state, row, d)) continue;
        double velocity = *velocity_of(state, row, d) = wanted(state, row, d, &list[all->owner[row][d] - 1]);
        if (d < 3)
            *position[d] = from->position[d] + state->step_size * velocity;
        else if (state->dimension == 2)
            state->angle[row] = from->angle + state->step_size * velocity;
    }
    scree_vector velocity, spin;
    scree_body_motion(state, row, velocity, spin);
    return scree_length(velocity) + scree_body_bounding_radius(state, row) * scree_length(spin);
}

scree_status scree_prescribed_move(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const scree_prescribed *all = scree_prescribed_of(state);
    scree_integer_sum shock[SCREE_LOADS] = {0};
    order list[SCREE_LOADS];
    double fastest = 0;
    (void)error;
    read_orders(c, scree_state_time(state) + 0.5 * state->step_size, list);
    while (scree_comm_sum_next(state, shock, SCREE_LOADS))
        for (uint64_t k = 0; k < all->listed; k++)
            if (state->held[all->row[k]]) add_shocks(state, all->row[k], list, shock);
    keep_work(state, shock, 0.5);
    for (uint64_t k = 0; k < all->listed; k++)
        if (state->held[all->row[k]]) fastest = fmax(fastest, move_body(state, all->row[k], list));
    scree_moved_drive(state, c->work, fastest);
    take_half_work(state);
    return SCREE_OK;
}

// ---- forces ------------------------------------------------------------------------------------------------------

/// Adds to a sum, and remembers it.
static void exert(const scree_context *c, size_t row, int component, double quanta, int64_t *exerted)
{
    if (!(fabs(quanta) < (double)MOST)) {
        c->work->flags |= SCREE_FLAG_FORCE_RANGE;
        c->work->flagged_id = c->state->id[row];
        quanta = 0;
    }
    *exerted = llrint(quanta);
    scree_wrapping_add(sum_of(c->state, row, component), *exerted);
}

/// Of the force what strains of the body work against.
static void spread_force(const double arm[3], const double force[3], double spread[6])
{
    static const int i[] = {0, 1, 2, 1, 0, 0}, j[] = {0, 1, 2, 2, 2, 1};
    for (int k = 0; k < 6; k++) spread[k] = 0.5 * (arm[i[k]] * force[j[k]] + arm[j[k]] * force[i[k]]);
}

static void push_body(const scree_context *c, size_t row, const order *list)
{
    scree_state *state = c->state;
    scree_prescribed *all = scree_prescribed_of(state);
    scree_exerted *exerted = &all->exerted[row];
    int lever = all->owner[row][SCREE_LEVER];
    for (int d = 0; d < SCREE_COMPONENTS; d++)
        if (all->owner[row][d] && !drives(state, row, d))
            exert(c, row, d, list[all->owner[row][d] - 1].push[d] / quantum_of(state, d), &exerted->quanta[d]);
    double torque[3], arm[3];
    if (!lever) return;
    find_arm(state, row, &list[lever - 1], arm);
    scree_cross(arm, list[lever - 1].push, torque);
    if (state->stretch) spread_force(arm, list[lever - 1].push, exerted->spread);
    for (int k = 0; k < 3; k++)
        if (scree_component_exists(state->dimension, 3 + k))
            exert(c, row, 3 + k, torque[k] / state->torque_quantum, &exerted->lever[k]);
}

scree_status scree_prescribed_attack(const scree_context *c, scree_error *error)
{
    const scree_prescribed *all = scree_prescribed_of(c->state);
    order list[SCREE_LOADS];
    (void)error;
    if (!c->state->stretch) return SCREE_OK;
    read_orders(c, scree_state_time(c->state), list);
    for (int load = 0; load < c->model->load_count; load++)
        if (list[load].own && list[load].own->attack == SCREE_ATTACK_SURFACE) scree_deformation_await_attack(c->state);
    for (uint64_t k = 0; k < all->listed; k++) {
        const uint32_t row = all->row[k];
        const int lever = all->owner[row][SCREE_LEVER];
        double arm[3];
        if (!lever) continue;
        find_arm(c->state, row, &list[lever - 1], arm);
        scree_deformation_attack(c->state, row, arm, list[lever - 1].push);
    }
    return SCREE_OK;
}

scree_status scree_prescribed_push(const scree_context *c, scree_error *error)
{
    scree_prescribed *all = scree_prescribed_of(c->state);
    order list[SCREE_LOADS];
    (void)error;
    take_half_surface_work(c->state);
    read_orders(c, next_middle(c), list);
    for (uint64_t k = 0; k < all->listed; k++) {
        const uint32_t row = all->row[k];
        memset(&all->exerted[row], 0, sizeof all->exerted[row]);
        memcpy(all->by[row], all->owner[row], sizeof all->by[row]);
        if (!is_free(all->owner[row])) push_body(c, row, list);
    }
    return SCREE_OK;
}

/// Reactions of the driven components of a body.
static void hold_body(const scree_context *c, size_t row, const order *list)
{
    scree_state *state = c->state;
    scree_prescribed *all = scree_prescribed_of(state);
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        if (!drives(state, row, d)) continue;
        double change = wanted(state, row, d, &list[all->owner[row][d] - 1]) - *velocity_of(state, row, d);
        double acceleration = change / c->work->next_kick - (d < 3 ? c->model->gravity[d] : 0);
        double whole = inertia_of(state, row, d) * acceleration / quantum_of(state, d);
        int64_t others = *sum_of(state, row, d);
        exert(c, row, d, whole, &all->exerted[row].quanta[d]);
        scree_wrapping_subtract(&all->exerted[row].quanta[d], others);
        scree_wrapping_subtract(sum_of(state, row, d), others);
    }
}

/// Adds the forces of all others on a body against the velocity of the load that drives it [N].
static void add_resistance(const scree_context *c, size_t row, const order *list, scree_integer_sum sum[SCREE_LOADS])
{
    scree_state *state = c->state;
    const scree_prescribed *all = scree_prescribed_of(state);
    for (int d = 0; d < state->dimension; d++) {
        if (!drives(state, row, d)) continue;
        const int load = all->owner[row][d] - 1;
        const double speed = scree_length(list[load].motion);
        int64_t others = *sum_of(state, row, d);
        if (!(list[load].own->until_force > 0) || !(speed > 0)) continue;
        scree_wrapping_subtract(&others, all->exerted[row].quanta[d]);
        const double force =
            scree_fixed_to(others, quantum_of(state, d)) + inertia_of(state, row, d) * c->model->gravity[d];
        scree_integer_sum_add(&sum[load], -force * list[load].motion[d] / speed);
    }
}

/// Ends velocities that meet the force with which they end.
static void find_ended(const scree_context *c, const order *list)
{
    scree_prescribed *all = scree_prescribed_of(c->state);
    scree_integer_sum sum[SCREE_LOADS] = {0};
    bool waits = false;
    for (int k = 0; k < SCREE_LOADS; k++)
        waits = waits || (list[k].own && list[k].own->until_force > 0 && scree_length(all->given[k]) == 0);
    if (!waits) return;
    while (scree_comm_sum_next(c->state, sum, SCREE_LOADS))
        for (uint64_t k = 0; k < all->listed; k++)
            if (c->state->held[all->row[k]]) add_resistance(c, all->row[k], list, sum);
    for (int k = 0; k < SCREE_LOADS; k++) {
        if (!list[k].own || !(list[k].own->until_force > 0) || scree_length(all->given[k]) > 0) continue;
        const double speed = scree_length(list[k].motion), limit = list[k].own->until_force;
        if (!(speed > 0) || scree_integer_sum_total(&sum[k]) < limit) continue;
        for (int d = 0; d < 3; d++) all->given[k][d] = limit * list[k].motion[d] / speed;
    }
}

scree_status scree_prescribed_hold(const scree_context *c, scree_error *error)
{
    const scree_prescribed *all = scree_prescribed_of(c->state);
    order list[SCREE_LOADS];
    (void)error;
    read_orders(c, next_middle(c), list);
    for (uint64_t k = 0; k < all->listed; k++)
        if (c->state->held[all->row[k]]) hold_body(c, all->row[k], list);
    find_ended(c, list);
    take_half_work(c->state);
    take_half_surface_work(c->state);
    return SCREE_OK;
}

/// Torques are counted in quanta of the largest radius times those of forces (contact/bounds.c).
static double bound_of_body(const scree_context *c, size_t row, const order *list)
{
    scree_state *state = c->state;
    const scree_prescribed *all = scree_prescribed_of(state);
    double largest = 0, radius = scree_model_largest_radius(c->model);
    for (int d = 0; d < SCREE_COMPONENTS; d++) {
        if (!all->owner[row][d]) continue;
        const order *said = &list[all->owner[row][d] - 1];
        double force = fabs(said->push[d]);
        if (drives(state, row, d)) {
            double change = fabs(wanted(state, row, d, said) - *velocity_of(state, row, d));
            force =
                inertia_of(state, row, d) * (change / c->work->next_kick + (d < 3 ? fabs(c->model->gravity[d]) : 0));
        }
        largest = fmax(largest, d < 3 ? force : force / radius);
    }
    return largest;
}

double scree_prescribed_bound(const scree_context *c)
{
    const scree_prescribed *all = scree_prescribed_of(c->state);
    order list[SCREE_LOADS];
    double largest = 0;
    if (!all->owner) return 0;
    list_rows(c->state);
    read_orders(c, next_middle(c), list);
    for (uint64_t k = 0; k < all->listed; k++) largest = fmax(largest, bound_of_body(c, all->row[k], list));
    return largest;
}
