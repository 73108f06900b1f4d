/// The periodic cell in motion.
///
/// Equations. With H the lattice vectors as columns and L the velocity gradient, H' = L H, and bodies follow the affine
/// field with a velocity c of their own:
///     x' = c + L x,     m c' = F - m L c
/// (SLLOD: Evans and Morriss 1984). This is the one motion that does not know where the cell has its faces: with x also
/// x + H s obeys it, with the same c, for any L that changes as it likes. Driving bodies through their ghosts alone
/// (Lees and Edwards 1972) gives the same in steady flow, but every change of L enters at the faces and runs through
/// the sample as a wave, so that the result depends on where they are. With K the energy of c and of the spins,
///     K' + stored' + dissipated = V sigma : L,     V sigma = - sum over contacts f (x) b - sum over bodies m c (x) c,
/// b the branch to the ghost that the contact is with: the cell works on its sample with the whole stress, contacts and
/// motion, and with nothing else. For a rotation, L antisymmetric, that is nothing but round-off.
///
/// Scheme. Between two kicks by the forces of a scheme (integrate/), c- before the drift, h = dt / 2, all at midpoints:
///     c = (c- + c+) / 2,   c+ - c- = - dt L c      =>   c = (1 + h L)^-1 c-,   c+ = (1 - h L) c
///     v = c + L (x(n) + x(n+1)) / 2,   x(n+1) = x(n) + dt v   =>   x(n+1) = (1 - h L)^-1 [(1 + h L) x(n) + dt c]
///     H(n+1) = (1 - h L)^-1 (1 + h L) H(n)
/// Second order; a body and its ghost move alike to round-off, and so do remapped lattices. v is the very displacement
/// over dt, so contacts see what they see elsewhere (contact/kinematics.h), and the discrete energy of measure/energy.c
/// obeys, when f(n) is the contact force at n and W(n) the sum of f (x) b,
///     dE = - dt L : [sum m c (x) c + (W(n) + W(n+1)) / 2] + dt^2 / 4 sum (f(n+1) - f(n)) . L^2 b,
/// of which the last term (zero in shear, (L dt)^2 of the rest else) is left out of the ledger.
///
/// Rows hold c+ or c(n), whatever the scheme keeps, between two steps, and v while contacts are evaluated.
///
/// Lattice. When a lattice vector leans over another by more than half of it, whole multiples of the other are taken
/// away: the same lattice, so nothing changes but which ghost of a body is called the body. Bodies are put back into
/// the cell together when one of them is a mean diameter outside. Both depend on the state alone. The reference
/// position of a body that is put back by H s goes back by H_0 s, H_0 the reference lattice: that of the ghost which is
/// now in the cell. So x - F X, F = H H_0^-1, is right across faces.
///
/// Servo. A component of L under stress is a degree of freedom with inertia and dashpot,
///     I dL/dt = sigma_wanted - sigma - Z (L - L_mean),     I = 5 rho d^2,   Z = 5 rho a d,   dL_mean/dt = (L - L_mean)
///     / T,
/// rho the mass per volume, d the mean diameter, a the speed of waves, T = 20 d / a. The cell has no faces that waves
/// could be reflected from, so it need not wait for them as a plate does (boundary/plates.c): the sample answers at
/// once, with sigma' = rho a^2 L, and the stress comes to what is wanted within some 12 d / a, the time that a wave
/// needs past twelve grains, without overshoot (all roots of the linear response are real). The dashpot resists changes
/// of L, not a lasting rate: a sample that dilates or contracts steadily keeps its stress. Far below the wanted stress,
/// where nothing would limit the rate of a loose sample, it resists the rate itself, with a tenth of Z. It is taken
/// implicitly. In a fast flow stresses change within the time of the servo: dilatancy that grows by psi in a strain
/// gamma leaves an error of (I + Z T) psi L_xy^2 / gamma, some 100 psi I^2 / gamma of the stress at the inertial number
/// I = L_xy d sqrt(rho / p). So the times of the servo, and with them the square root of its inertia, shrink like
/// SLOW_FLOW / I (a barostat with the mass of Andersen 1980 that follows the flow; all roots stay real), down to what
/// the step resolves. Periodic-shear of 250 discs: mean stress 0.9996 of the wanted, rms 4 %, largest 1.11 at I = 0.28;
/// 0.76, 37 % and 5.5 before. sigma is the whole stress at n. a from the Hertz stiffness at the mean contact force, as
/// there; the gain of the case divides Z.
///
/// Cost: two passes over the bodies a step in a deforming cell, one in a cell at rest. Limits: a cell that is not
/// periodic in all directions does not deform.
#include "boundary/periodic.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/matrix.h"
#include "base/wide_sum.h"
#include "comm/comm.h"
#include "search/moved.h"
#include "search/neighbours.h"
#include "state/periodic.h"

#include <math.h>
#include <string.h>

#define CREEP_GRAINS     5.0  // grains that a wave passes in the creep time of the servo
#define MEAN_GRAINS      20.0 // the same in the time of the running mean
#define LEAST_RESISTANCE 0.1
#define SLOW_FLOW        0.005 // inertial number up to which the times of the servo are these
#define QUICKEST         0.05  // share of them that is never gone below
#define STEP_SHARE       1.5   // nor this times the step over the time in which a wave passes a grain
#define CHECKED          16    // steps between two looks for bodies that have left the cell
#define LEAN_LIMIT       0.51  // of a lattice vector over another: a little above half, where two lattices are as good

static bool deforms(const scree_periodic_cell *cell)
{
    return scree_matrix_contract(cell->gradient, cell->gradient) > 0;
}

// ---- the imposed velocity gradient
// ---------------------------------------------------------------------------------------------------

static double density(const scree_model *model, const scree_state *state)
{
    scree_integer_sum mass = {0};
    while (scree_comm_sum_next(state, &mass, 1))
        for (size_t row = 0; row < state->count; row++) scree_integer_sum_add(&mass, state->row[row].mass);
    return scree_integer_sum_total(&mass) / (scree_periodic_extent(state) * model->thickness);
}

/// Speed of longitudinal waves [m/s], see the head of plates.c.
static double wave_speed(const scree_model *model, const scree_state *state, double pressure)
{
    double diameter = 2 * model->mean_radius, depth = state->dimension == 2 ? model->thickness : diameter;
    double k = scree_model_stiffness(model, pressure, diameter, depth);
    return sqrt(k / depth / density(model, state));
}

static void widths(const scree_state *state, double width[3])
{
    double inverse[9];
    scree_matrix_invert(scree_cell(state)->lattice, inverse);
    scree_periodic_widths(inverse, width);
}

/// Geometric mean of the widths.
static double mean_width(const scree_state *state)
{
    double width[3];
    widths(state, width);
    return state->dimension == 2 ? sqrt(width[0] * width[1]) : cbrt(width[0] * width[1] * width[2]);
}

double scree_periodic_wave_time(const scree_model *model, const scree_state *state, double pressure)
{
    double width[3], longest = 0;
    widths(state, width);
    for (int k = 0; k < state->dimension; k++) longest = fmax(longest, width[k]);
    return longest / wave_speed(model, state, pressure);
}

void scree_periodic_fit(const scree_model *model, scree_state *state, double pressure)
{
    scree_periodic_cell *cell = scree_cell(state);
    double diameter = 2 * model->mean_radius;
    cell->inertia = CREEP_GRAINS * density(model, state) * diameter * diameter;
    cell->damping = wave_speed(model, state, pressure) / diameter / model->servo.gain;
    cell->limit = fmin(model->servo.velocity, model->servo.travel / state->step_size) / mean_width(state);
}

/// Share of its times that the servo takes beside a flow: 1 in a slow one.
static double quickness(const scree_periodic_cell *cell, double dt, const scree_periodic_demand *wanted)
{
    double rate = 0, stress = 0, least = fmax(QUICKEST, STEP_SHARE * dt * cell->damping);
    for (int k = 0; k < 9; k++) {
        if (isnan(wanted->stress[k])) rate = fmax(rate, fabs(wanted->rate[k]));
        if (k % 4 == 0 && !isnan(wanted->stress[k])) stress = fmax(stress, fabs(wanted->stress[k]));
    }
    double inertial = rate * sqrt(cell->inertia / CREEP_GRAINS / stress);
    return inertial > SLOW_FLOW ? fmin(1, fmax(least, SLOW_FLOW / inertial)) : 1;
}

/// One step of the servo of a component, whose times are this share of their own.
static void hold_stress(const scree_periodic_cell *cell, double dt, double share, double wanted, double stress,
                        double *rate, double *drift)
{
    double reached = fmin(1, fabs(stress / wanted));
    double resistance = dt * (cell->damping / share) * fmax(LEAST_RESISTANCE, reached);
    double pull = dt / (cell->inertia * (share * share)) * (wanted - stress);
    double next = (*rate + pull + resistance * reached * *drift) / (1 + resistance);
    *rate = fmax(-cell->limit, fmin(cell->limit, next));
    *drift += dt * (cell->damping / share) / MEAN_GRAINS * (*rate - *drift);
}

void scree_periodic_control(const scree_model *model, scree_state *state, const scree_periodic_demand *wanted,
                            double rise)
{
    scree_periodic_cell *cell = scree_cell(state);
    double stress[9];
    scree_periodic_stress(model, state, stress);
    const double share = quickness(cell, state->step_size, wanted);
    for (int k = 0; k < 9; k++) {
        if (isnan(wanted->stress[k]))
            cell->gradient[k] = cell->drift[k] = wanted->rate[k] * rise;
        else
            hold_stress(cell, state->step_size, share, wanted->stress[k], stress[k], &cell->gradient[k],
                        &cell->drift[k]);
    }
}

// ---- the motion --------------------------------------------------------------------------------------------------

/// Matrices of a step.
typedef struct step_maps {
    double slow[9];     ///< (1 + h L)^-1
    double forward[9];  ///< (1 - h L)^-1
    double map[9];      ///< (1 - h L)^-1 (1 + h L)
    double gradient[9]; ///< L
} step_maps;

static step_maps maps_of(const scree_state *state)
{
    step_maps maps;
    double plus[9], minus[9], half = 0.5 * state->step_size;
    scree_matrix_unit_plus(half, scree_cell(state)->gradient, plus);
    scree_matrix_unit_plus(-half, scree_cell(state)->gradient, minus);
    scree_matrix_invert(plus, maps.slow);
    scree_matrix_invert(minus, maps.forward);
    scree_matrix_multiply(maps.forward, plus, maps.map);
    memcpy(maps.gradient, scree_cell(state)->gradient, sizeof maps.gradient);
    return maps;
}

// Loops over all bodies are made once for each dimension, a constant there.
#define PERIODIC_INLINE static inline __attribute__((always_inline))

PERIODIC_INLINE void place_of(int dimension, const scree_row *row, scree_vector position)
{
    position[0] = row->x;
    position[1] = row->y;
    position[2] = dimension == 3 ? row->z : 0;
}

PERIODIC_INLINE void velocity_of(int dimension, const scree_row *row, scree_vector velocity)
{
    velocity[0] = row->vx;
    velocity[1] = row->vy;
    velocity[2] = dimension == 3 ? row->vz : 0;
}

PERIODIC_INLINE void set_place(int dimension, scree_row *row, const scree_vector position)
{
    row->x = position[0];
    row->y = position[1];
    if (dimension == 3) row->z = position[2];
}

PERIODIC_INLINE void set_velocity(int dimension, scree_row *row, const scree_vector velocity)
{
    row->vx = velocity[0];
    row->vy = velocity[1];
    if (dimension == 3) row->vz = velocity[2];
}

/// From a row after `first`, at x(n) + dt c- with the velocity c-, to x(n+1) and v; `relative` becomes c+.
PERIODIC_INLINE void move_body(int dimension, const step_maps *maps, double dt, scree_row *row, scree_vector relative)
{
    scree_vector before, position, middle, affine, sum, velocity;
    velocity_of(dimension, row, before);
    place_of(dimension, row, position);
    scree_matrix_apply_in(dimension, maps->slow, before, middle);
    for (int k = 0; k < dimension; k++) {
        relative[k] = 2 * middle[k] - before[k];
        position[k] -= dt * before[k];
    }
    scree_matrix_apply_in(dimension, maps->gradient, position, affine);
    for (int k = 0; k < dimension; k++) sum[k] = position[k] + 0.5 * dt * affine[k] + dt * middle[k];
    scree_matrix_apply_in(dimension, maps->forward, sum, position);
    scree_matrix_apply_in(dimension, maps->gradient, position, affine);
    for (int k = 0; k < dimension; k++) sum[k] = middle[k] + affine[k];
    scree_matrix_apply_in(dimension, maps->slow, sum, velocity);
    set_place(dimension, row, position);
    set_velocity(dimension, row, velocity);
}

/// What the members of the thread pool share.
typedef struct bodies_task {
    scree_state *state;
    const scree_work *work;
    const step_maps *maps;
    const double *inverse; ///< of the lattice
    double quantum;        ///< J, of the sums
    scree_wide_sum sum[SCREE_THREAD_POOL_MOST];
    double largest[SCREE_THREAD_POOL_MOST]; ///< m
} bodies_task;

/// The maps are copied, so that the compiler knows that rows do not overlap them.
PERIODIC_INLINE void move_rows(int dimension, const bodies_task *task, size_t begin, size_t end)
{
    const step_maps maps = *task->maps;
    const double dt = task->state->step_size;
    scree_row *row = task->state->row;
    scree_vector *relative = task->work->relative;
    for (size_t k = begin; k < end; k++) move_body(dimension, &maps, dt, &row[k], relative[k]);
}

static void move_share(void *argument, int index, int count)
{
    const bodies_task *task = argument;
    size_t begin = scree_thread_pool_begin(task->state->count, index, count);
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    if (task->state->dimension == 3)
        move_rows(3, task, begin, end);
    else
        move_rows(2, task, begin, end);
}

/// A task whose sums, which the shares fill, are not cleared: they are large.
static void begin_task(bodies_task *task, scree_state *state, const scree_work *work)
{
    task->state = state;
    task->work = work;
    task->maps = NULL;
    task->inverse = NULL;
    task->quantum = 0;
}

static void run_shares(scree_work *work, scree_thread_pool_task *share, bodies_task *task)
{
    scree_thread_pool_run(&work->pool, scree_work_shares(work), share, task);
}

static void move_lattice(scree_state *state, const step_maps *maps)
{
    scree_periodic_cell *cell = scree_cell(state);
    double before[9];
    memcpy(before, cell->lattice, sizeof before);
    scree_matrix_multiply(maps->map, before, cell->lattice);
    for (int k = 0; k < 9; k++) cell->strain[k] += cell->gradient[k] * state->step_size;
}

static scree_status reserve_relative(scree_work *work, size_t count, scree_error *error)
{
    if (count <= work->relative_capacity) return SCREE_OK;
    scree_release(&work->relative);
    work->relative_capacity = 0;
    scree_status status = scree_allocate(&work->relative, count, sizeof *work->relative, error);
    if (!status) work->relative_capacity = count;
    return status;
}

// ---- energy of the motion ----------------------------------------------------------------------------------------

static double mass_bound(const scree_model *model)
{
    double heaviest = 0;
    for (int k = 0; k < model->material_count; k++)
        heaviest = fmax(heaviest, scree_model_mass(model, k, model->radius_max));
    return heaviest;
}

PERIODIC_INLINE void sum_motion(int dimension, bodies_task *task, size_t begin, size_t end, scree_wide_sum *sum)
{
    const double inverse = 1 / task->quantum;
    const scree_row *row = task->state->row;
    double slow[9];
    memcpy(slow, task->maps->slow, sizeof slow);
    for (size_t k = begin; k < end; k++) {
        scree_vector before, c;
        velocity_of(dimension, &row[k], before);
        scree_matrix_apply_in(dimension, slow, before, c);
        for (int i = 0; i < dimension; i++)
            for (int j = 0; j < dimension; j++)
                sum->value[3 * i + j] += scree_fixed_from(row[k].mass * c[i] * c[j], inverse);
    }
}

static void kinematics_share(void *argument, int index, int count)
{
    bodies_task *task = argument;
    scree_wide_sum sum = {{0}};
    size_t begin = scree_thread_pool_begin(task->state->count, index, count);
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    if (task->state->dimension == 3)
        sum_motion(3, task, begin, end, &sum);
    else
        sum_motion(2, task, begin, end, &sum);
    task->sum[index] = sum;
}

/// sum m c (x) c over the bodies that are here, from rows that hold c- [quanta].
static void sum_motions(scree_state *state, scree_work *work, const step_maps *maps, double quantum,
                        scree_wide_sum *sum)
{
    bodies_task task;
    begin_task(&task, state, work);
    task.maps = maps;
    task.quantum = quantum;
    run_shares(work, kinematics_share, &task);
    *sum = (scree_wide_sum){{0}};
    for (int p = 0; p < scree_work_shares(work); p++)
        for (int k = 0; k < 9; k++) sum->value[k] += task.sum[p].value[k];
}

static double motion_quantum(const scree_model *model, const scree_state *state)
{
    return scree_fixed_quantum(4 * (mass_bound(model) * state->largest_speed * state->largest_speed));
}

/// The sum over all bodies, rounded to integers so that it does not depend on the order of rows. The quantum follows
/// from the largest speed of all processes: so that both go in one message the sum is made with that of the last step,
/// and once more where it turns out to be another.
static void measure_motion(const scree_model *model, scree_state *state, scree_work *work, const step_maps *maps)
{
    scree_wide_sum sum;
    const double quantum = state->part ? work->motion_quantum : motion_quantum(model, state);
    sum_motions(state, work, maps, quantum, &sum);
    scree_reduction_add_wide(&work->moved.together, sum.value, 9);
    scree_moved_join(state, work, scree_neighbours_are_due(state, work));
    const double due = motion_quantum(model, state);
    if (state->part) work->motion_quantum = due;
    if (due == quantum) {
        scree_wide_total(&sum, 1, quantum, scree_cell(state)->motion);
        return;
    }
    sum_motions(state, work, maps, due, &sum);
    scree_comm_wide_total(state, &sum, 1, due, scree_cell(state)->motion);
}

/// Work of the cell on the bodies for a part of its stress times volume, sum over dt.
static void add_work(scree_state *state, const double tensor[9], double factor)
{
    double work = -factor * state->step_size * scree_matrix_contract(tensor, scree_cell(state)->gradient);
    state->ledger.periodic += work;
    state->ledger.turnover += fabs(work);
}

// ---- lattice and faces -------------------------------------------------------------------------------------------

static void column(const double m[9], int k, scree_vector v)
{
    for (int i = 0; i < 3; i++) v[i] = m[3 * i + k];
}

/// Takes multiples of lattice vector `other` from lattice vector `k` when it leans too far; true when it did.
static bool straighten(scree_periodic_cell *cell, int k, int other)
{
    scree_vector a, b;
    column(cell->lattice, k, a);
    column(cell->lattice, other, b);
    double lean = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    if (!(fabs(lean) > LEAN_LIMIT)) return false;
    double multiple = rint(lean);
    for (int i = 0; i < 3; i++) {
        cell->lattice[3 * i + k] -= multiple * cell->lattice[3 * i + other];
        cell->reference[3 * i + k] -= multiple * cell->reference[3 * i + other];
    }
    return true;
}

/// Every step of a reduction makes a vector shorter, so it ends; a few are enough for what a step can do.
static bool straighten_all(scree_state *state)
{
    bool changed = false;
    for (int k = 0; k < state->dimension; k++)
        for (int other = 0; other < state->dimension; other++)
            if (k != other && straighten(scree_cell(state), k, other)) changed = true;
    return changed;
}

static void outside_share(void *argument, int index, int count)
{
    bodies_task *task = argument;
    const scree_state *state = task->state;
    double width[3], largest = 0;
    scree_periodic_widths(task->inverse, width);
    size_t end = scree_thread_pool_begin(state->count, index + 1, count);
    for (size_t row = scree_thread_pool_begin(state->count, index, count); row < end; row++) {
        scree_vector position, f;
        scree_body_position(state, row, position);
        scree_matrix_apply(task->inverse, position, f);
        for (int k = 0; k < state->dimension; k++) {
            double outside = fmax(-f[k], f[k] - 1) * width[k];
            if (scree_periodic_repeats(scree_cell(state), k) && outside > largest) largest = outside;
        }
    }
    task->largest[index] = largest;
}

/// Largest distance [m] of a body from the cell it should be in.
static double farthest_outside(scree_state *state, scree_work *work, const double inverse[9])
{
    bodies_task task;
    double largest = 0;
    begin_task(&task, state, work);
    task.inverse = inverse;
    run_shares(work, outside_share, &task);
    for (int k = 0; k < scree_work_shares(work); k++) largest = fmax(largest, task.largest[k]);
    scree_comm_maximum(state, &largest, 1);
    return largest;
}

/// Whole lattice vectors by which a body must be put back; false: by none.
static bool find_shift(const scree_state *state, const double inverse[9], size_t row, scree_vector shift)
{
    scree_vector position, f;
    scree_body_position(state, row, position);
    scree_matrix_apply(inverse, position, f);
    bool moved = false;
    for (int k = 0; k < 3; k++) {
        shift[k] = k < state->dimension && scree_periodic_repeats(scree_cell(state), k) ? -floor(f[k]) : 0;
        moved = moved || shift[k] != 0;
    }
    return moved && isfinite(f[0] + f[1] + f[2]);
}

/// Energy of gravity that all bodies together change by when they are put back: no work.
static double change_of_gravity(const scree_model *model, const scree_state *state, const double inverse[9])
{
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t row = 0; row < state->count; row++) {
            scree_vector shift, by;
            if (!find_shift(state, inverse, row, shift)) continue;
            scree_matrix_apply(scree_cell(state)->lattice, shift, by);
            scree_integer_sum_add(&sum, state->row[row].mass * scree_dot(model->gravity, by));
        }
    return scree_integer_sum_total(&sum);
}

/// Puts one body back by whole lattice vectors, with its reference position.
static void put_back(scree_state *state, const double inverse[9], const double velocity[9], size_t row)
{
    scree_vector position, speed, shift, by, reference, faster;
    if (!find_shift(state, inverse, row, shift)) return;
    scree_body_position(state, row, position);
    velocity_of(state->dimension, &state->row[row], speed);
    scree_matrix_apply(scree_cell(state)->lattice, shift, by);
    scree_matrix_apply(scree_cell(state)->reference, shift, reference);
    scree_matrix_apply(velocity, shift, faster);
    for (int k = 0; k < 3; k++) {
        position[k] += by[k];
        speed[k] += faster[k];
        state->reference[row][k] += reference[k];
    }
    set_place(state->dimension, &state->row[row], position);
    set_velocity(state->dimension, &state->row[row], speed);
}

/// Looked at in every CHECKED-th step, since bodies go much less than a radius between; the number of force evaluations
/// is part of the state.
static void put_all_back(const scree_model *model, scree_state *state, scree_work *work)
{
    double inverse[9], velocity[9];
    if (state->evaluations % CHECKED != 0) return;
    bool straightened = deforms(scree_cell(state)) && straighten_all(state);
    scree_matrix_invert(scree_cell(state)->lattice, inverse);
    if (!straightened && farthest_outside(state, work, inverse) <= 2 * model->mean_radius) return;
    scree_periodic_lattice_velocity(state, velocity);
    state->ledger.gravity += change_of_gravity(model, state, inverse);
    for (size_t row = 0; row < state->count; row++) put_back(state, inverse, velocity, row);
    scree_neighbours_invalidate(work);
}

// ---- a step ------------------------------------------------------------------------------------------------------

/// The affine field brings neighbours nearer than their own motion says, and makes contacts faster.
static void allow_for_gradient(const scree_model *model, scree_state *state, scree_work *work, const step_maps *maps)
{
    double change[9];
    for (int k = 0; k < 9; k++) change[k] = maps->map[k] - (k % 4 == 0);
    work->budget -= 1.25 * scree_matrix_norm(change) * (model->radius_max + 1.5 * work->skin);
    state->largest_speed += 2 * model->radius_max * scree_matrix_norm(scree_cell(state)->gradient);
}

scree_status scree_periodic_move(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    if (!scree_cell(state)->directions) return SCREE_OK;
    if (scree_periodic_is_whole(state)) {
        step_maps maps = maps_of(state);
        measure_motion(model, state, work, &maps);
        if (deforms(scree_cell(state))) {
            scree_status status = reserve_relative(work, state->count, error);
            if (status) return status;
            add_work(state, scree_cell(state)->motion, 1);
            add_work(state, scree_cell(state)->virial, 0.5);
            move_lattice(state, &maps);
            bodies_task task;
            begin_task(&task, state, work);
            task.maps = &maps;
            run_shares(work, move_share, &task);
            allow_for_gradient(model, state, work, &maps);
        }
    }
    put_all_back(model, state, work);
    return SCREE_OK;
}

static void settle_share(void *argument, int index, int count)
{
    const bodies_task *task = argument;
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    for (size_t row = scree_thread_pool_begin(task->state->count, index, count); row < end; row++)
        set_velocity(task->state->dimension, &task->state->row[row], task->work->relative[row]);
}

void scree_periodic_settle(scree_state *state, scree_work *work)
{
    if (!scree_periodic_is_whole(state) || !deforms(scree_cell(state))) return;
    bodies_task task;
    begin_task(&task, state, work);
    run_shares(work, settle_share, &task);
    add_work(state, scree_cell(state)->virial, 0.5);
}
